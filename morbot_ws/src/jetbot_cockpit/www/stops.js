// The emergency stop and its release.

/** @import { Send } from "./link.js" */
/** @import { Notice } from "./notice.js" */
/** @import { World } from "./world.js" */

import { element, onPress, setClass, setText } from "./dom.js";
import { t } from "./language.js";

const RESEND_FOR = 60000; // ms
const CONFIRM_TIMEOUT = 1000; // ms
const MAX_NAME = 16; // characters that fit on the button
const NOT_CONNECTED = t("No connection: this stop reached no robot. Use the robot's own switch."
  + " It is sent if the connection is back within a minute.");
const NOT_RELEASED = t("No connection: nothing was released.");
const NOT_CONFIRMED = t("The stop is not confirmed yet. Press again, or use the robot's own switch.");

// A stop that the cockpit does not confirm is reported.
export class Stops {
  unconfirmed = 0; // the timer of a stop that is not confirmed yet
  unsentAt = -Infinity;

  // send(message) returns whether it was sent; lost(): whether there is no connection; stopped(): a stop was sent
  /** @param {World} world
   * @param {{ send: Send, lost: () => boolean, notice: Notice, stopped: () => void }} page */
  constructor(world, { send, lost, notice, stopped }) {
    this.world = world;
    this.send = send;
    this.lost = lost;
    this.notice = notice;
    this.stopped = stopped;
    onPress(element("stop"), () => this.stop());
    onPress(element("release"), () => this.release(), () => false);
  }

  stop() {
    const sent = this.send({ type: "stop", robot: null });
    this.unsentAt = sent ? -Infinity : performance.now();
    if (!sent) return this.notice.show(NOT_CONNECTED, this.lost);
    this.stopped();
    clearTimeout(this.unconfirmed);
    const missing = () => !this.world.emergency;
    this.unconfirmed = setTimeout(() => this.notice.show(NOT_CONFIRMED, missing), CONFIRM_TIMEOUT);
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
    if (!sent) this.notice.show(NOT_RELEASED, this.lost);
  }

  // Returns the chosen robot if it alone is stopped, else null: all robots.
  stoppedAlone() {
    const { chosen, emergency } = this.world;
    return !emergency && this.world.state(chosen).stopped ? chosen : null;
  }

  show() {
    const alone = this.stoppedAlone();
    const robot = this.world.robot(alone)?.label ?? "";
    const isShort = robot && robot.length <= MAX_NAME;
    const ofOne = isShort ? t("Release {robot}", { robot }) : t("Release it");
    setText(element("release"), alone ? ofOne : t("Release"));
    setClass(element("release"), "needed", alone || this.world.emergency);
    element("release").disabled = this.world.mustWait;
    setClass(document.body, "emergency", this.world.emergency);
  }
}
