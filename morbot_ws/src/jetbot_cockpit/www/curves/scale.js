// The vertical axis of a strip, and round numbers on any axis.

import { trackOf } from "./series.js";
import { shortened } from "./short.js";

const STEPS = [1, 2, 5, 10];
const LONG = 6; // characters of a number beside an axis
const FLAT = 0.1; // of an axis whose values are all the same, at least

// Returns the axis of a strip: its range, whether there are values, and where a value is in the box.
export function scaleOf({ range, series }, drives, { shown }, { top, bottom }) {
  const found = drives.flatMap(([, drive, until]) => series.map((each) => bounds(trackOf(drive, each), each.column,
    drive.start + shown[0], Math.min(drive.start + shown[1], until))));
  const [least, most] = [Math.min(...found.map(([low]) => low)), Math.max(...found.map(([, high]) => high))];
  const known = least <= most;
  const [low, high] = widened(range ?? (known ? [least, most] : [0, 1]), known ? [least, most] : null);
  return { known, low, high, y: (value) => bottom - (value - low) / (high - low) * (bottom - top) };
}

// Returns a range that all values fit into: none is hidden because it is not to be expected.
function widened([low, high], values) {
  const [least, most] = values ? [Math.min(low, values[0]), Math.max(high, values[1])] : [low, high];
  const missing = Math.max(0, Math.max(FLAT, Math.abs(most) * FLAT / 2) - (most - least)) / 2;
  return [least - missing, most + missing];
}

// Returns the least and the largest value of a column between two times; Infinity and -Infinity: there is none.
function bounds(track, column, from, to) {
  let [low, high] = [Infinity, -Infinity];
  if (!track) return [low, high];
  for (let index = Math.max(0, track.until(from) - 1); index < track.until(to); index += 1) {
    const value = track.at(index, column);
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

// Returns round numbers in a range, about so many at most.
export function ticks(low, high, most) {
  const rough = (high - low) / Math.max(1, most);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = (STEPS.find((each) => each * power >= rough * 0.999) ?? 10) * power;
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, index) => (first + index) * step);
}

// Returns one of these round numbers as it is written beside the others.
/** @param {number} value @param {number[]} ticks */
export function axis(value, [first, second = first + 1]) {
  const places = Math.min(9, Math.max(0, -Math.floor(Math.log10(Math.abs(second - first)) + 1e-9)));
  const text = value.toFixed(places);
  return (Number(text) === 0 ? (0).toFixed(places) : shortened(text, LONG)).replaceAll("-", "−");
}
