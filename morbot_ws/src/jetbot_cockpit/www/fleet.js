// The teacher's list: every robot with its status, and a button for each thing that can be done with it.

import { button, create, element, setClass, setText } from "./dom.js";
import { describeDriver, summarize } from "./world.js";

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
    element("fleet-list").replaceChildren(...[...this.rows.values()].map(({ item }) => item));
    setClass(element("reset-all"), "absent", !this.world.robots.some((robot) => robot.simulated));
  }

  row({ id, label, color, simulated }) {
    const item = create("li");
    item.dataset.robot = id;
    item.style.setProperty("--robot", color);
    const name = create("span", "label", label);
    const [driver, status] = [create("span", "who"), create("span", "why")];
    const pick = button("", () => this.choose(id), "choose");
    pick.append(create("span", "swatch"), name, driver, status);
    const take = button("Take", () => this.take(id), "take-one");
    const reset = button("Put back", () => this.send({ type: "reset", robot: id }), "reset-one");
    const stop = button("Stop", () => this.toggleStop(id), "stop-one");
    setClass(reset, "absent", !simulated);
    item.append(pick, take, reset, stop);
    return { item, pick, driver, status, take, stop, label };
  }

  take(id) {
    this.choose(id);
    this.send({ type: "take", robot: id });
  }

  toggleStop(id) {
    this.send({ type: this.world.state(id).stopped ? "release" : "stop", robot: id });
  }

  show() {
    for (const [id, row] of this.rows) this.showRow(id, row);
    const counts = this.world.robots.map(({ id }) => summarize(this.world, id).level);
    const driving = counts.filter((level) => level === "driving").length;
    setText(element("fleet-summary"), `${counts.length} robots, ${driving} driving`);
  }

  showRow(id, { item, pick, driver, status, take, stop, label }) {
    const { text, level } = summarize(this.world, id);
    const { driver: someone, stopped } = this.world.state(id);
    setText(driver, someone ? describeDriver(this.world, id) : "");
    setText(status, text);
    if (status.title !== text) status.title = text;
    if (item.dataset.level !== level) item.dataset.level = level;
    pick.setAttribute("aria-pressed", id === this.chosen());
    take.disabled = Boolean(someone && someone.id === this.world.me.id);
    setText(stop, stopped ? "Release" : "Stop");
    setLabels({ take, stop }, label, stopped);
  }
}

function setLabels({ take, stop }, label, stopped) {
  take.setAttribute("aria-label", `Take ${label}`);
  stop.setAttribute("aria-label", `${stopped ? "Release" : "Stop"} ${label}`);
}
