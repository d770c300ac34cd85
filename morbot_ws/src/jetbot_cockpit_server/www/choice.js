// The list from which a person chooses the robot.

import { create, element } from "./dom.js";

const REMEMBERED = "robot";

export class Choice {
  // changed(id): another robot was chosen
  constructor(world, changed) {
    Object.assign(this, { world, changed, id: null });
    element("robot").addEventListener("change", (event) => this.choose(event.target.value));
  }

  choose(id) {
    if (id === this.id || !this.allowed().some((robot) => robot.id === id)) return this.list();
    this.id = id;
    remember(id);
    this.list();
    this.changed(id);
  }

  // A pupil who belongs to a robot drives that one only.
  allowed() {
    const own = this.world.me.robot;
    return own ? this.world.robots.filter((robot) => robot.id === own) : this.world.robots;
  }

  // Follows the robots that there are; one that is gone stays chosen, so that it can come back.
  list() {
    const robots = this.allowed();
    const gone = this.id !== null && !this.world.robot(this.id);
    const options = robots.map(({ id, label }) => new Option(label, id, false, id === this.id));
    if (gone) options.unshift(new Option(`${this.id.slice(1) || "robot"} (gone)`, this.id, true, true));
    if (!options.length) options.push(create("option", "", "no robot"));
    element("robot").replaceChildren(...options);
    element("robot").disabled = robots.length + gone < 2;
  }

  // Chooses the robot of this page's person: their own, the one before a reload, or the first.
  begin() {
    const robots = this.allowed();
    const wrong = this.world.me.robot && this.id !== this.world.me.robot;
    if (this.id !== null && !wrong) return this.list();
    const before = robots.find((robot) => robot.id === remembered()) ?? robots[0];
    if (before) this.choose(before.id);
    else this.list();
  }
}

function remember(id) {
  try {
    sessionStorage.setItem(REMEMBERED, id);
  } catch { /* the browser stores nothing: the first robot is chosen after a reload */ }
}

function remembered() {
  try {
    return sessionStorage.getItem(REMEMBERED);
  } catch {
    return null;
  }
}
