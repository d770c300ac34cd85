// What the map shows in words and numbers: the chosen robot's speeds, in the legend, and for a screen reader its place.

/** @import { World } from "./world.js" */

import { calmly, element, setText, signed } from "./dom.js";
import { t } from "./language.js";
import { describePlace } from "./place.js";

export class MapText {
  // lost(): whether there is no connection
  /** @param {World} world */
  constructor(canvas, world, lost) {
    this.describe = calmly((text) => canvas.setAttribute("aria-label", text));
    this.world = world;
    this.lost = lost;
  }

  show() {
    this.showSpeeds();
    const { pose, ...place } = this.world.placeOf(this.world.chosen);
    this.describe(`${t("Map from above.")} ${describePlace({ pose: this.lost() ? null : pose, ...place })}`);
  }

  showSpeeds() {
    const { command, speed, pose } = this.world.state(this.world.chosen);
    setText(element("commanded"), command ? `x ${signed(command[0])}, z ${signed(command[1])}` : "–");
    const unknown = this.world.robot(this.world.chosen) && !pose ? t("no odometry: not on the map") : "–";
    setText(element("actual"), speed ? `${signed(speed[0])} m/s, ${signed(speed[1])} rad/s` : unknown);
  }
}
