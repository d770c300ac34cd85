// The emergency stop and its release, and who has not confirmed it.

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

// What does not confirm a stop soon is named for as long as it does not: the cockpit, or robots.
export class Stops {
  pressed = false; // here, and the cockpit has not confirmed it
  engaged = false;
  late = false; // there was time to confirm it
  timer = 0;
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
    this.pressed = true;
    this.#expect();
  }

  // Robots confirm a stop one after the other; who was named already stays named.
  #expect() {
    this.late = !element("unconfirmed").hidden;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.late = true;
      this.show();
    }, CONFIRM_TIMEOUT);
  }

  // The connection is back: a stop that was not sent is sent first.
  resend() {
    if (performance.now() - this.unsentAt < RESEND_FOR) this.stop();
  }

  // A state has arrived: it confirms the stop, even if somebody releases it at once.
  update() {
    const { emergency } = this.world;
    if (emergency && !this.engaged && !this.pressed) this.#expect(); // somebody else's stop
    if (emergency) this.pressed = false;
    this.engaged = emergency;
  }

  release() {
    this.pressed = false;
    const sent = this.send({ type: "release", robot: this.stoppedAlone() });
    if (!sent) this.notice.show(NOT_RELEASED, this.lost);
  }

  // Returns the chosen robot if it alone is stopped, else null: all robots.
  stoppedAlone() {
    const { chosen, emergency } = this.world;
    return !emergency && this.world.state(chosen).stopped ? chosen : null;
  }

  // Returns who has not confirmed the stop: a sentence, or "".
  get problem() {
    const { emergency, unconfirmed } = this.world;
    const missing = emergency ? unconfirmed.length : this.pressed;
    return this.late && missing ? describeMissing(this.world) : "";
  }

  show() {
    const { problem } = this;
    setText(element("unconfirmed"), problem);
    element("unconfirmed").hidden = !problem;
    this.showRelease();
  }

  showRelease() {
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

/** @param {World} world */
function describeMissing({ robots, emergency, unconfirmed }) {
  if (!emergency || robots.length < 2) return NOT_CONFIRMED;
  const named = new Map(robots.map(({ id, label }) => [id, label]));
  const missing = unconfirmed.map((id) => named.get(id) ?? id.slice(1));
  const all = new Set([...named.keys(), ...unconfirmed]).size;
  return t("Stopped: {stopped} of {all}. Not confirmed: {robots}. Use their own switches.",
    { stopped: all - missing.length, all, robots: missing.join(", ") });
}
