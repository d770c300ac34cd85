// The teacher's sheet: which tasks are on, the best scores, and all programs, to look at or as one text.

/** @import { Send } from "../link.js" */
/** @import { Score, Task } from "../messages.js" */
/** @import { World } from "../world.js" */

import { create, download, element, setText } from "../dom.js";
import { number, t } from "../language.js";
import { showSwitches } from "../switches.js";
import { titleOf } from "../world.js";
import { archive } from "./archive.js";
import { ask } from "./ask.js";
import { plain } from "./names.js";
import { Sheet } from "./sheet.js";

export class Overview {
  scores = [];

  // send(message); look(row): shows a program; world
  /** @param {{ send: Send, look: any, world: World }} page */
  constructor({ send, look, world }) {
    this.send = send;
    this.look = look;
    this.world = world;
    this.sheet = new Sheet("overview", "overview-button", () => this.open());
    element("download-all").addEventListener("click", () => this.act(() => this.downloadAll()));
  }

  // Messages of the cockpit
  hello() {
    element("overview-button").hidden = !this.world.teacher;
    if (!this.world.teacher) this.sheet.toggle(false);
  }

  /** @param {{ tasks?: Task[], scores?: Score[] }} news */
  show({ tasks, scores }) {
    if (tasks) showSwitches(element("task-switches"), tasks, this.send);
    this.scores = scores ?? this.scores;
    if (this.sheet.isOpen) this.showScores();
  }

  // Shows a row for each robot, a column for each task in which there is a score.
  showScores() {
    const titles = [...new Set(this.scores.map(({ task }) => task))];
    const best = (robot, title) => this.scores.find((each) => each.task === title && each.robot === robot);
    const cell = (robot, title) => number(best(robot, title)?.score.toFixed(1) ?? "–");
    const rows = this.world.robots.map((robot) => row("td", titleOf(robot),
      titles.map((title) => cell(robot.label, title))));
    element("score-table").replaceChildren(row("th", t("Robot"), titles.map((title) => t(title))), ...rows);
  }

  open() {
    this.showScores();
    element("all-programs").replaceChildren();
    void this.act(async () => {
      const rows = await allPrograms();
      element("all-programs").replaceChildren(...rows.map((each) => this.item(each)));
      return this.lacking() || (rows.length ? "" : t("No robot has a program yet."));
    });
  }

  // Returns whose programs are missing because the robot is out of reach, or "".
  lacking() {
    const robots = this.world.robots.filter(({ id }) => this.world.isAway(id)).map(({ label }) => label).join(", ");
    return robots && t("Out of reach, so their programs are missing here: {robots}", { robots });
  }

  // Says what the action returns, or why the cockpit refuses it.
  async act(action) {
    const text = await action().catch(({ message }) => message);
    setText(element("overview-problem"), text ?? "");
  }

  item(program) {
    const [item, look] = [create("li"), create("button", "name", `${this.owner(program.robot)}: ${program.name}`)];
    look.addEventListener("click", () => this.act(async () => {
      await this.look(program);
      this.sheet.toggle(false);
    }));
    item.append(look);
    return item;
  }

  // Returns what a robot is called, with its pupil; it may not run now.
  owner(id) {
    return titleOf(this.world.robot(id) ?? { label: id.slice(1) || t("robot") });
  }

  async downloadAll() {
    const files = [];
    for (const [index, { robot, id, name }] of (await allPrograms()).entries()) {
      const { program } = await ask({ do: "open", robot, id });
      const path = `${plain(this.owner(robot))}/${index + 1}_${plain(name)}`;
      const { python } = JSON.parse(program);
      files.push({ name: `${path}.json`, text: program });
      if (typeof python === "string") files.push({ name: `${path}.py`, text: python });
    }
    const lacking = this.lacking();
    if (lacking) files.push({ name: "missing.txt", text: lacking });
    download("programs.txt", archive("programs", files), "text/plain");
    return lacking;
  }
}

async function allPrograms() {
  const { programs } = await ask({ do: "list", robot: null });
  return programs.filter(({ deleted }) => !deleted).sort((one, other) => one.robot.localeCompare(other.robot));
}

function row(kind, heading, texts) {
  const made = create("tr");
  made.append(create("th", "", heading), ...texts.map((text) => create(kind, "", text)));
  return made;
}
