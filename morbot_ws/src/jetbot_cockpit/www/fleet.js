// The teacher's list: every robot with its status, and a button that stops it.

/** @import { Send } from "./link.js" */
/** @import { World } from "./world.js" */

import { visible } from "./colors.js";
import { create, element, onPress, onSurePress, setClass, setText } from "./dom.js";
import { batteryOf, warningsOf } from "./health.js";
import { t } from "./language.js";
import { toDo } from "./to_do.js";
import { titleOf } from "./world.js";

const MANY_STALLS = 2; // per minute: one alone may be a tablet that was switched off

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

  // Makes a row for each robot; call it when the list of robots has changed. The keyboard's focus stays at its robot.
  list() {
    const focused = /** @type {any} */ (document.activeElement);
    const { robot } = focused.closest("#fleet-list li")?.dataset ?? {};
    this.rows = this.world.robots.map((each) => this.row(each));
    element("fleet-list").replaceChildren(...this.world.missing.map(missingRow), ...this.rows.map(({ item }) => item));
    this.rows.find(({ id }) => id === robot)?.[focused.dataset.action ? "stop" : "pick"].focus();
    element("reset-all").hidden = !this.world.robots.some(({ simulated }) => simulated);
  }

  row(robot) {
    const { id, label, color } = robot;
    const item = create("li");
    item.dataset.robot = id;
    const [driver, facts, status] = ["who", "facts", "why"].map((name) => create("span", name));
    const stalls = create("span", "stalls", t("network stalls"));
    const [pick, words] = [create("button", "choose"), create("span", "words")];
    words.append(create("span", "label", titleOf(robot)), driver, facts, status, stalls);
    pick.append(create("span", "swatch"), words);
    pick.addEventListener("click", () => this.choose(id));
    const stop = create("button", "stop-one");
    stop.dataset.next = "robot"; // not the button of another robot
    onPress(stop, () => this.toggleStop(id), () => !this.world.state(id).stopped);
    item.append(pick, stop);
    return { id, item, pick, driver, facts, status, stalls, stop, label, color };
  }

  toggleStop(id) {
    this.send({ type: this.world.state(id).stopped ? "release" : "stop", robot: id });
  }

  show() {
    if (element("fleet").hidden) return;
    for (const row of this.rows) this.showRow(row);
    const driving = this.rows.filter(({ item }) => item.dataset.level === "driving").length;
    element("all-go-on").hidden = !this.rows.some(({ id }) => this.world.nameWaiting(id));
    setClass(document.body, "hub", this.world.robots.some(({ address }) => address));
    setClass(document.body, "unplaced", !this.world.placed.length);
    const lines = toDo(this.world).join("\n");
    setText(element("to-do"), lines);
    element("to-do").hidden = !lines;
    setText(element("fleet-summary"), t("{all} robots, {driving} driving", { all: this.rows.length, driving }));
  }

  showRow({ id, item, pick, driver, facts, status, stalls, stop, label, color }) {
    const { text, level } = this.world.summarize(id);
    const { stopped, stalls: count } = this.world.state(id);
    setText(driver, this.world.nameDriver(id) || this.world.nameWaiting(id));
    setText(status, text);
    setText(facts, describeFacts(this.world.state(id)));
    facts.dataset.health = warningsOf(this.world.state(id)).length ? "warning" : "ok";
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

// Returns the charge of the battery and the time to the robot and back, as far as they are known.
function describeFacts(state) {
  const [percent, { link }] = [batteryOf(state), state];
  return [percent && t("battery {percent}", { percent }), link && `${Math.round(link)} ms`].filter(Boolean).join(", ");
}

function missingRow({ label }) {
  const item = create("li", "missing");
  item.append(create("span", "label", label), create("span", "why", t("not running any more")));
  return item;
}
