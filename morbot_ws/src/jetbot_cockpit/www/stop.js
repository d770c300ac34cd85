// The emergency stop and its release. A stop that no robot confirms is reported.

import { element, setClass, setText } from "./dom.js";

const CONFIRM_TIMEOUT = 1000; // ms
const NOT_CONNECTED = "No connection: this stop reached no robot. Use the robot's own switch.";
const NOT_CONFIRMED = "The stop is not confirmed yet. Press again, or use the robot's own switch.";

export class Stops {
  // chosen(): id; send(message) returns whether it was sent; report(sentence); stopped(): a stop was sent
  constructor(world, { chosen, send, report, stopped }) {
    Object.assign(this, { world, chosen, send, report, stopped });
    element("stop").addEventListener("click", () => this.stop());
    element("release").addEventListener("click", () => this.release());
  }

  stop() {
    if (!this.send({ type: "stop", robot: null })) return this.report(NOT_CONNECTED);
    this.stopped();
    setTimeout(() => this.world.emergency || this.report(NOT_CONFIRMED), CONFIRM_TIMEOUT);
  }

  release() {
    const sent = this.send({ type: "release", robot: this.stoppedAlone() });
    if (!sent) this.report("No connection: nothing was released.");
  }

  // Returns the chosen robot if it alone is stopped, else null: all robots.
  stoppedAlone() {
    return !this.world.emergency && this.world.state(this.chosen()).stopped ? this.chosen() : null;
  }

  show() {
    const alone = this.stoppedAlone();
    setText(element("release"), alone ? `Release ${this.world.robot(alone)?.label ?? "it"}` : "Release");
    setClass(element("release"), "needed", alone || this.world.emergency);
    setClass(document.body, "emergency", this.world.emergency);
  }
}
