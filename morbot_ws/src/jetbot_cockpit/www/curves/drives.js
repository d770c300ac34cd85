// The drives that a page keeps: the newest, the three before it, and the best by the judge's score. It takes what the
// cockpit sends, and decides where a drive begins and ends: with a program's run, else with the robot's motion.

import { Drive } from "./drive.js";

const EARLIER = 3;
const TAIL = 1; // s for which the end of a program's drive is recorded: the robot brakes
const REST = 2; // s without motion until a drive without a program is over
const JUMP = 1; // s by which the robot's clock is set back, not only late
const WINDOW = 50; // messages by which the robot's clock is known

export class Drives {
  current = new Drive(0, -Infinity);
  /** @type {Drive[]} */
  earlier = []; // the newest first
  /** @type {Drive | null} */
  best = null;
  /** @type {number | null} */
  number = null; // of the newest row of the cockpit
  running = false; // whether the page's program runs
  movedAt = -Infinity; // when the robot moved last
  resting = true; // whether the robot has rested since the last drive
  /** @type {number[]} */
  offsets = []; // s from this page's clock to the robot's; each is too small by the time that its message took

  // Takes what the robot has reported.
  take(message, receivedAt = performance.now()) {
    this.offsets = [...this.offsets, message.now - receivedAt / 1000].slice(-WINDOW);
    if (message.after !== this.number) this.interrupt();
    this.number = message.number;
    for (const row of message.wheels) this.watch(row);
    for (const topic of Object.keys(this.current.tracks)) for (const row of message[topic]) this.add(topic, row);
    if (!this.running && this.isOpen && message.now - this.movedAt > REST) this.current.end = message.now;
  }

  // Returns when this was on the robot's clock, in s. at: as performance.now() counts
  time(at = performance.now()) {
    return this.offsets.length ? Math.max(...this.offsets) + at / 1000 : NaN;
  }

  interrupt() {
    this.current.interrupt();
  }

  add(topic, row) {
    const { current } = this;
    const track = current.tracks[topic];
    if (track.count && track.at(track.count - 1) - row[0] > JUMP) this.begin(row[0]);
    this.current.add(topic, row);
  }

  // Looks whether the robot moves: x, z, left, right.
  watch([stamp, , , left, right]) {
    const moves = left !== 0 || right !== 0;
    if (moves && this.resting && !this.running && !this.isOpen) this.begin(stamp);
    if (moves) this.movedAt = stamp;
    this.resting = !moves;
  }

  // Whether a drive has begun that is not over.
  get isOpen() {
    return this.current.number > 0 && this.current.end === Infinity;
  }

  begin(start) {
    const { current } = this;
    if (current.number) {
      this.earlier = [current, ...this.earlier].slice(0, EARLIER);
      if (isBetter(current, this.best)) this.best = current;
    }
    this.current = new Drive(current.number + 1, Number.isNaN(start) ? -Infinity : start);
    this.resting = false;
  }

  // The page's program begins, and ends: at, as performance.now() counts.
  run(at) {
    this.running = true;
    this.begin(this.time(at));
  }

  ended(at = performance.now()) {
    this.running = false;
    this.current.end = this.time(at) + TAIL;
  }

  print(name, value, at = performance.now()) {
    this.current.print(name, value, this.time(at));
  }

  // All that are kept, the newest first, each once.
  get kept() {
    return [...new Set([this.current, ...this.earlier, ...(this.best ? [this.best] : [])])];
  }
}

// Whether a drive has a score, and no earlier one at this task has one as high.
/** @param {Drive} drive @param {Drive | null} best */
function isBetter({ score, task }, best) {
  return score !== null && !(best && best.task === task && Number(best.score) >= score);
}
