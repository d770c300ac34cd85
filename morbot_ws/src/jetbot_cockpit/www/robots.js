// Which robots there are: the list from which a person chooses one, and the teacher's, which stops each.

/** @import { Send } from "./link.js" */
/** @import { World } from "./world.js" */

import { visible } from "./colors.js";
import { create, element, onPress, onSurePress, setText } from "./dom.js";
import { t } from "./language.js";
import { titleOf } from "./world.js";

const MANY_STALLS = 2; // per minute: one alone may be a tablet that was switched off

export class Choice {
  // changed(): another robot was chosen
  /** @param {World} world */
  constructor(world, changed) {
    this.world = world;
    this.changed = changed;
    element("robot").addEventListener("change", (event) => this.choose(event.target.value));
  }

  choose(id) {
    const changes = id !== this.world.chosen && this.world.allowed.some((robot) => robot.id === id);
    if (changes) {
      this.world.chosen = id;
      history.replaceState({ robot: id }, ""); // for a reload
    }
    this.list();
    if (changes) this.changed();
  }

  // Chooses the robot of this page's person: their own, the one before a reload, or the first.
  begin() {
    const { allowed, me, chosen } = this.world;
    if (chosen !== null && (!me.robot || chosen === me.robot)) return this.list();
    const first = allowed.find(({ id }) => id === history.state?.robot) ?? allowed[0];
    this.choose(first?.id);
  }

  // Shows the robots that there are; one that is gone stays chosen, so that it can come back.
  list() {
    const { allowed, chosen } = this.world;
    const gone = chosen !== null && !this.world.robot(chosen);
    const options = allowed.map((robot) => new Option(titleOf(robot), robot.id, false, robot.id === chosen));
    if (gone) options.unshift(new Option(goneTitle(chosen.slice(1)), chosen, true, true));
    if (!options.length) options.push(new Option(t("no robot"), ""));
    element("robot").replaceChildren(...options);
    element("robot").disabled = options.length < 2;
  }
}

function goneTitle(robot) {
  return robot ? t("{robot} (gone)", { robot }) : t("robot (gone)");
}

// The teacher's list: every robot with its status, and a button that stops it.
export class Fleet {
  // choose(id); send(message)
  /** @param {World} world @param {Send} send */
  constructor(world, choose, send) {
    this.world = world;
    this.choose = choose;
    this.send = send;
    this.rows = [];
    onSurePress(element("reset-all"), t("End all programs?"), () => send({ type: "reset", robot: null }));
    element("all-go-on").addEventListener("click", () => send({ type: "go_on", robot: null }));
  }

  // Makes a row for each robot; call it when the list of robots has changed.
  list() {
    this.rows = this.world.robots.map((robot) => this.row(robot));
    element("fleet-list").replaceChildren(...this.world.missing.map(missingRow), ...this.rows.map(({ item }) => item));
    element("reset-all").hidden = !this.world.robots.some(({ simulated }) => simulated);
  }

  row(robot) {
    const { id, label, color } = robot;
    const item = create("li");
    item.dataset.robot = id;
    const [driver, status] = [create("span", "who"), create("span", "why")];
    const stalls = create("span", "stalls", t("network stalls"));
    const [pick, words] = [create("button", "choose"), create("span", "words")];
    words.append(create("span", "label", titleOf(robot)), driver, status, stalls);
    pick.append(create("span", "swatch"), words);
    pick.addEventListener("click", () => this.choose(id));
    const stop = create("button", "stop-one");
    onPress(stop, () => this.toggleStop(id), () => !this.world.state(id).stopped);
    item.append(pick, stop);
    return { id, item, pick, driver, status, stalls, stop, label, color };
  }

  toggleStop(id) {
    this.send({ type: this.world.state(id).stopped ? "release" : "stop", robot: id });
  }

  show() {
    if (element("fleet").hidden) return;
    for (const row of this.rows) this.showRow(row);
    const driving = this.rows.filter(({ item }) => item.dataset.level === "driving").length;
    element("all-go-on").hidden = !this.rows.some(({ id }) => this.world.nameWaiting(id));
    setText(element("fleet-summary"), t("{all} robots, {driving} driving", { all: this.rows.length, driving }));
  }

  showRow({ id, item, pick, driver, status, stalls, stop, label, color }) {
    const { text, level } = this.world.summarize(id);
    const { stopped, stalls: count } = this.world.state(id);
    setText(driver, this.world.nameDriver(id) || this.world.nameWaiting(id));
    setText(status, text);
    stalls.hidden = count < MANY_STALLS;
    item.dataset.level = level;
    item.style.setProperty("--robot", visible(color));
    pick.setAttribute("aria-pressed", id === this.world.chosen);
    stop.dataset.action = stopped ? "release" : "stop";
    setText(stop, stopped ? t("Release") : t("Stop"));
    const named = stopped ? t("Release {robot}", { robot: label }) : t("Stop {robot}", { robot: label });
    stop.setAttribute("aria-label", named);
  }
}

function missingRow({ label }) {
  const item = create("li", "missing");
  item.append(create("span", "label", label), create("span", "why", t("not running any more")));
  return item;
}
