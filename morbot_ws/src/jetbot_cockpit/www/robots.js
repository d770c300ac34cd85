// The list of robots from which a person chooses one.

/** @import { World } from "./world.js" */

import { element } from "./dom.js";
import { t } from "./language.js";
import { titleOf } from "./world.js";

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
