// What a program commands: sent when it changes, and 20 times a second while the program runs, as wheels can obey it.

const INTERVAL = 50; // ms between two commands: 20 Hz
export const HOLD = 1000; // ms for which a command counts, as in the controller: a program that only computes stops
const SOON = 15; // ms; a command that changes so soon is not repeated before
const [RATE, BURST] = [26, 6]; // commands a second, and at once: the cockpit takes 40 messages of a page

export class Motion {
  command = [0, 0]; // forward, left: in [-1, 1], as a pad's
  sent = [0, 0]; // the last one
  publishedAt = -Infinity;
  changesAt = -Infinity; // when the program will publish again, as performance.now() counts
  allowance = BURST;
  sentAt = -Infinity;
  timer = 0; // of the repetition, 0 for none

  // send(forward, left)
  constructor(send) {
    this.send = send;
  }

  begin() {
    this.timer ||= setInterval(() => this.repeat(), INTERVAL);
  }

  // Stops, whatever was commanded, and is silent from now on.
  end() {
    clearInterval(this.timer);
    this.timer = 0;
    this.command = this.sent = [0, 0];
    this.send(0, 0);
  }

  // Drives x, z, in the units of this robot's commands. What is not finite stops the robot, as in the controller.
  publish(/** @type {number[]} */ [x, z], { wheel_separation: separation, max_speed: maxSpeed }) {
    const sides = [-1, 1].map((side) => (x + side * z * separation / 2) / maxSpeed);
    const [left, right] = sides.map((power) => (sides.every(Number.isFinite) ? Math.max(-1, Math.min(1, power)) : 0));
    this.publishedAt = performance.now();
    this.set((left + right) / 2, (right - left) / 2);
  }

  // A stop is sent at once; another change waits for the next of the 20 if there were too many.
  set(...command) {
    const changes = String(command) !== String(this.command);
    this.command = command;
    const stops = this.sent.some(Boolean) && !command.some(Boolean);
    if (stops || changes && this.allowed() >= 1) this.sendNow();
  }

  repeat() {
    const now = performance.now();
    if (now - this.publishedAt > HOLD) this.set(0, 0);
    const [since, until] = [now - this.sentAt, this.changesAt - now];
    const soon = until > 0 && until < SOON && since < 2 * INTERVAL;
    if (!soon && since > INTERVAL / 2) this.sendNow();
  }

  sendNow() {
    this.allowance = this.allowed() - 1;
    this.sentAt = performance.now();
    this.sent = this.command;
    this.send(...this.command);
  }

  allowed() {
    return Math.min(BURST, this.allowance + (performance.now() - this.sentAt) * RATE / 1000);
  }
}
