// What the map shows in words and numbers: the chosen robot's speeds, in the legend, and for a screen reader its place.

/** @import { World } from "./world.js" */

import { element, setText, signed } from "./dom.js";
import { t } from "./language.js";
import { describePlace } from "./place.js";

const INTERVAL = 1000; // ms: a screen reader that reads the place is not interrupted more often

export class MapText {
  describedAt = -Infinity;

  // lost(): whether there is no connection
  /** @param {World} world */
  constructor(canvas, world, lost) {
    this.canvas = canvas;
    this.world = world;
    this.lost = lost;
  }

  show() {
    this.showSpeeds();
    if (performance.now() - this.describedAt >= INTERVAL) this.describe();
  }

  showSpeeds() {
    const { command, speed, pose } = this.world.state(this.world.chosen);
    setText(element("commanded"), command ? `x ${signed(command[0])}, z ${signed(command[1])}` : "–");
    const unknown = this.world.robot(this.world.chosen) && !pose ? t("no odometry: not on the map") : "–";
    setText(element("actual"), speed ? `${signed(speed[0])} m/s, ${signed(speed[1])} rad/s` : unknown);
  }

  describe() {
    this.describedAt = performance.now();
    const { pose, ...place } = this.world.placeOf(this.world.chosen);
    const text = `${t("Map from above.")} ${describePlace({ pose: this.lost() ? null : pose, ...place })}`;
    if (this.canvas.getAttribute("aria-label") !== text) this.canvas.setAttribute("aria-label", text);
  }
}
