// The teacher's sheet: which tasks are on, the best scores, and all programs, to look at or as one zip.

import { create, element, setText } from "../dom.js";
import { ask } from "./ask.js";
import { zip } from "./zip.js";

const FILE_MODE = 0o644;

export class Overview {
  scores = [];

  // send(message); look(row): shows a program; download(name, content, type); world
  constructor({ send, look, download, world }) {
    Object.assign(this, { send, look, download, world });
    element("overview-button").addEventListener("click", () => this.toggle());
    element("close-overview").addEventListener("click", () => this.toggle(false));
    element("zip").addEventListener("click", () => this.downloadAll());
  }

  // Messages of the cockpit
  hello() {
    element("overview-button").hidden = !this.world.teacher;
    if (!this.world.teacher) this.toggle(false);
  }

  show({ tasks, scores }) {
    if (tasks) element("task-switches").replaceChildren(...tasks.map((task) => this.toSwitch(task)));
    this.scores = scores ?? this.scores;
    if (!element("overview").hidden) this.showScores();
  }

  toSwitch({ name, title, on }) {
    const [label, box] = [create("label", "", title), create("input")];
    Object.assign(box, { type: "checkbox", checked: on });
    box.addEventListener("change", () => this.send({ type: "offer", task: name, on: box.checked }));
    label.prepend(box);
    return label;
  }

  // Shows a row for each robot, a column for each task in which there is a score.
  showScores() {
    const titles = [...new Set(this.scores.map(({ task }) => task))];
    const best = (robot, title) => this.scores.find((each) => each.task === title && each.robot === robot);
    const cell = (robot, title) => best(robot, title)?.score.toFixed(1) ?? "–";
    const rows = this.world.robots.map(({ label }) => row("td", [label, ...titles.map((title) => cell(label, title))]));
    element("score-table").replaceChildren(row("th", ["Robot", ...titles]), ...rows);
  }

  async toggle(on = element("overview").hidden) {
    element("overview").hidden = !on;
    element("overview-button").setAttribute("aria-pressed", on);
    if (!on) return;
    this.show({});
    const rows = await this.rows();
    element("all-programs").replaceChildren(...rows.map((each) => this.item(each)));
    setText(element("overview-problem"), rows.length ? "" : "No robot has a program yet.");
  }

  async rows() {
    try {
      const { programs } = await ask({ do: "list", robot: null });
      return programs.filter(({ deleted }) => !deleted).sort((one, other) => one.robot.localeCompare(other.robot));
    } catch {
      return [];
    }
  }

  item(program) {
    const [item, look] = [create("li"), create("button", "name", `${label(program.robot)}: ${program.name}`)];
    look.addEventListener("click", () => {
      this.toggle(false);
      this.look(program);
    });
    item.append(look);
    return item;
  }

  async downloadAll() {
    const files = [];
    for (const [index, { robot, id, name }] of (await this.rows()).entries()) {
      const { program } = await ask({ do: "open", robot, id });
      const plain = name.replace(/[^A-Za-z0-9]+/g, "_");
      files.push({ name: `${label(robot)}/${index + 1}_${plain}.json`, text: program, mode: FILE_MODE });
    }
    this.download("programs.zip", zip(files), "application/zip");
  }
}

function row(kind, texts) {
  const made = create("tr");
  made.append(...texts.map((text) => create(kind, "", text)));
  return made;
}

function label(robot) {
  return robot.replace(/^\//, "").replace(/[^A-Za-z0-9_]/g, "_") || "robot";
}
