// What the curves show: each strip has an axis, and its series have a name, a colour and a dash.

import { number, t } from "../language.js";
import { shortened } from "./short.js";

const LONG = 8; // characters of a printed value
const HOLD = 2.5; // s for which a value holds that the robot repeats each second
export const DASHES = [[], [7, 4], [2, 3]];
export const COLORS = 4; // --curve-0 to --curve-3

/** @typedef {{ name: string, topic: string, column: number, style: number, hold: number }} Series */
/** @typedef {{ id: string, title: string, unit: string, places: number | null, range: number[] | null,
 * series: Series[] }} Strip */

const series = (topic, column, name = "", style = 0) => ({ topic, column, name, style, hold: HOLD });

/** @type {Strip[]} */
export const STRIPS = [
  { id: "wheels", title: t("Wheels"), unit: t("power"), places: 2, range: [-1, 1],
    series: [series("wheels", 3, t("left")), series("wheels", 4, t("right"), 1)] },
  { id: "speed", title: t("Speed"), unit: "m/s", places: 2, range: null, series: [series("odom", 4)] },
  { id: "heading", title: t("Heading"), unit: "°", places: 0, range: null, series: [series("odom", 6)] },
  { id: "eyes", title: t("Eyes"), unit: "", places: 2, range: [0, 1],
    series: [series("line", 1, t("left")), series("line", 2, t("middle"), 1), series("line", 3, t("right"), 2)] },
  { id: "battery", title: t("Battery"), unit: "V", places: 2, range: null, series: [series("battery", 1)] },
];

/** @type {Omit<Strip, "series">} */
export const PRINTED = { id: "printed", title: t("Printed"), unit: "", places: null, range: null };

// Returns the strip of what the programs of these drives have printed.
export function printedStrip(drives) {
  const names = [...new Set(drives.flatMap(({ prints }) => [...prints.keys()]))];
  return { ...PRINTED, series: names.map((name, style) => ({ topic: "", name, column: 1, style, hold: Infinity })) };
}

/** @param {any} drive @param {Series} series @returns {any} */
export function trackOf(drive, { topic, name }) {
  return topic ? drive.tracks[topic] : drive.prints.get(name);
}

// Returns the value of a series at a moment of a drive, until which no newer one came; null: there is none.
/** @param {Series} series @param {number} time */
export function valueAt(drive, series, time) {
  const track = trackOf(drive, series);
  const index = track ? track.until(drive.start + time) - 1 : -1;
  if (index < 0 || drive.start + time - track.at(index) > series.hold) return null;
  const value = track.at(index, series.column);
  return Number.isNaN(value) ? null : value;
}

// Returns a value as it is read, "–" if there is none. places: after the decimal mark; null: four digits in all
export function digits(value, places) {
  if (value === null) return "–";
  const text = places === null ? shortened(String(Number(value.toPrecision(4))), LONG) : value.toFixed(places);
  return number((Number(text) === 0 ? text.replace("-", "") : text).replaceAll("-", "−"));
}

// Returns the values at a moment as a screen reader says them.
export function describe(drive, strips, moment) {
  const said = strips.map(({ title, unit, places, series }) => {
    const values = series.map((each) => `${each.name} ${digits(valueAt(drive, each, moment), places)}`.trim());
    return `${title}: ${values.join(", ")} ${unit}`.trim();
  });
  return [t("{seconds} s", { seconds: moment.toFixed(1) }), ...said].join("; ");
}
