// The emergency stop and its release. A stop that the cockpit does not confirm is reported.

import { element, setClass, setText } from "./dom.js";
import { onPress } from "./press.js";

const RESEND_FOR = 60000; // ms
const CONFIRM_TIMEOUT = 1000; // ms
const MAX_NAME = 16; // characters that fit on the button
const NOT_CONNECTED = "No connection: this stop reached no robot. Use the robot's own switch."
  + " It is sent as soon as the connection is back.";
const NOT_CONFIRMED = "The stop is not confirmed yet. Press again, or use the robot's own switch.";

export class Stops {
  // chosen(): id; send(message) returns whether it was sent; report(sentence, over): until over()
  // returns true; stopped(): a stop was sent
  constructor(world, { chosen, send, report, stopped }) {
    Object.assign(this, { world, chosen, send, report, stopped, unconfirmed: null, unsentAt: -Infinity });
    onPress(element("stop"), () => this.stop());
    onPress(element("release"), () => this.release(), () => false);
  }

  stop() {
    const sent = this.send({ type: "stop", robot: null });
    this.unsentAt = sent ? -Infinity : performance.now();
    if (!sent) return this.report(NOT_CONNECTED);
    this.stopped();
    clearTimeout(this.unconfirmed);
    this.unconfirmed = setTimeout(() => this.report(NOT_CONFIRMED, () => this.world.emergency), CONFIRM_TIMEOUT);
  }

  // The connection is back: a stop that was not sent is sent first.
  resend() {
    if (performance.now() - this.unsentAt < RESEND_FOR) this.stop();
  }

  // A state has arrived: it confirms the stop, even if somebody releases it at once.
  update() {
    if (this.world.emergency) clearTimeout(this.unconfirmed);
  }

  release() {
    clearTimeout(this.unconfirmed);
    const sent = this.send({ type: "release", robot: this.stoppedAlone() });
    if (!sent) this.report("No connection: nothing was released.");
  }

  // Returns the chosen robot if it alone is stopped, else null: all robots.
  stoppedAlone() {
    return !this.world.emergency && this.world.state(this.chosen()).stopped ? this.chosen() : null;
  }

  shortName(id) {
    const label = this.world.robot(id)?.label ?? "";
    return label && label.length <= MAX_NAME ? label : "it";
  }

  show() {
    const alone = this.stoppedAlone();
    setText(element("release"), alone ? `Release ${this.shortName(alone)}` : "Release");
    setClass(element("release"), "needed", alone || this.world.emergency);
    setClass(document.body, "emergency", this.world.emergency);
  }
}
