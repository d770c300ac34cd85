// One drive: what the robot reported and what its program printed from its beginning on.

import { Track } from "./track.js";

const MAX_NAMES = 8; // of printed values
const MAX_NAME = 40; // characters
const DEGREES = 180 / Math.PI;

// The numbers of each row, as the cockpit sends them; after those of odom, the page adds the heading.
export const COLUMNS = {
  odom: ["x (m)", "y (m)", "yaw (rad)", "speed (m/s)", "turn rate (rad/s)"],
  wheels: ["command x", "command z", "left wheel (power)", "right wheel (power)"],
  line: ["left eye", "middle eye", "right eye"],
  battery: ["battery (V)"],
};

export class Drive {
  end = Infinity; // when it ends, as the robot's clock counts
  /** @type {number | null} */
  score = null; // of the judge
  task = ""; // for which it is
  /** @type {number | null} */
  yaw = null; // rad, the last one
  turned = 0; // degrees, since the start
  /** @type {Record<string, Track>} */
  tracks = Object.fromEntries(Object.entries(COLUMNS).map(([topic, names]) =>
    [topic, new Track(1 + names.length + Number(topic === "odom"))]));
  /** @type {Map<string, Track>} */
  prints = new Map();

  // number: of the drive, from 1 on; 0: what is before the first one; start: in s, as the robot's clock counts,
  // -Infinity: with its first row
  /** @param {number} number @param {number} start */
  constructor(number, start) {
    this.number = number;
    this.start = start;
  }

  // Takes a row of a topic: its time, and its values.
  /** @param {string} topic @param {number[]} row */
  add(topic, row) {
    if (this.start === -Infinity) [this.start] = row;
    if (row[0] < this.start || row[0] > this.end) return;
    this.tracks[topic].add(topic === "odom" ? [...row, this.heading(row[3])] : row);
  }

  // Returns the heading in degrees as seen from the start, without a jump where it is 180.
  heading(yaw) {
    const turn = yaw - (this.yaw ?? yaw);
    this.turned += Math.atan2(Math.sin(turn), Math.cos(turn)) * DEGREES;
    this.yaw = yaw;
    return this.turned;
  }

  /** @param {string} name @param {number} value @param {number} time */
  print(name, value, time) {
    if (!(time <= this.end) || !Number.isFinite(value)) return; // the time is NaN until the robot's clock is known
    const key = name.slice(0, MAX_NAME);
    if (!this.prints.has(key) && this.prints.size < MAX_NAMES) this.prints.set(key, new Track(2));
    this.prints.get(key)?.add([time, value]);
  }

  interrupt() {
    for (const track of Object.values(this.tracks)) track.interrupt();
  }

  get all() {
    return [...Object.values(this.tracks), ...this.prints.values()];
  }

  // How long it has lasted, in s.
  get length() {
    return Math.max(0, ...this.all.filter(({ count }) => count).map((track) => track.at(track.count - 1) - this.start));
  }
}
