// The teacher's list: every robot with its status, and a button that stops it.

import { button, create, element, setText } from "./dom.js";
import { onPress } from "./press.js";
import { nameDriver, summarize } from "./world.js";

export class Fleet {
  // chosen(): id; choose(id); send(message)
  constructor(world, chosen, choose, send) {
    Object.assign(this, { world, chosen, choose, send, rows: new Map() });
    element("reset-all").addEventListener("click", () => send({ type: "reset", robot: null }));
  }

  // Makes a row for each robot; call it when the list of robots has changed.
  list() {
    this.rows.clear();
    for (const robot of this.world.robots) this.rows.set(robot.id, this.row(robot));
    const missing = [...this.world.missing.values()].map((robot) => this.missingRow(robot));
    element("fleet-list").replaceChildren(...missing, ...[...this.rows.values()].map(({ item }) => item));
    element("reset-all").hidden = !this.world.robots.some((robot) => robot.simulated);
  }

  row({ id, label, color }) {
    const item = create("li");
    item.dataset.robot = id;
    item.style.setProperty("--robot", color);
    const name = create("span", "label", label);
    const [driver, status] = [create("span", "who"), create("span", "why")];
    const pick = button("", () => this.choose(id), "choose");
    pick.append(create("span", "swatch"), name, driver, status);
    const stop = button("Stop", null, "stop-one");
    onPress(stop, () => this.toggleStop(id), () => !this.world.state(id).stopped);
    item.append(pick, stop);
    return { item, pick, driver, status, stop, label };
  }

  missingRow({ label }) {
    const item = create("li", "missing");
    item.append(create("span", "label", label), create("span", "why", "not running any more"));
    return item;
  }

  toggleStop(id) {
    this.send({ type: this.world.state(id).stopped ? "release" : "stop", robot: id });
  }

  show() {
    if (element("fleet").hidden) return;
    for (const [id, row] of this.rows) this.showRow(id, row);
    const counts = this.world.robots.map(({ id }) => summarize(this.world, id).level);
    const driving = counts.filter((level) => level === "driving").length;
    setText(element("fleet-summary"), `${counts.length} robots, ${driving} driving`);
  }

  showRow(id, { item, pick, driver, status, stop, label }) {
    const { text, level } = summarize(this.world, id);
    const { stopped } = this.world.state(id);
    setText(driver, nameDriver(this.world, id));
    setText(status, text);
    if (status.title !== text) status.title = text;
    if (item.dataset.level !== level) item.dataset.level = level;
    pick.setAttribute("aria-pressed", id === this.chosen());
    stop.dataset.action = stopped ? "release" : "stop";
    setText(stop, stopped ? "Release" : "Stop");
    stop.setAttribute("aria-label", `${stopped ? "Release" : "Stop"} ${label}`);
  }
}
