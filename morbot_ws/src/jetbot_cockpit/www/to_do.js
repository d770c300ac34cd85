// What a teacher does about the robots of a class, in one line for each kind of trouble: the most urgent first.

/** @import { World } from "./world.js" */

import { warningsOf } from "./health.js";
import { t } from "./language.js";

const BY_CODE = { // of a robot's health
  battery: t("Charge before the lesson: {robots}"),
  input: t("Weak supply: {robots}"),
  undervoltage: t("Weak supply: {robots}"),
  temperature: t("Too hot: {robots}"),
  throttled: t("Slowed down: {robots}"),
  disk: t("Disk almost full: {robots}"),
  wifi: t("Weak Wi-Fi: {robots}"),
  power_save: t("Wi-Fi saves power: {robots}"),
};
const OTHER_VERSION = t("Other version: {robots}");

// Returns the lines.
/** @param {World} world @returns {string[]} */
export function toDo(world) {
  const named = new Map([...new Set(Object.values(BY_CODE)), OTHER_VERSION].map((line) => [line, new Set()]));
  for (const { id, label } of world.robots) {
    for (const { code } of warningsOf(world.state(id))) named.get(BY_CODE[code])?.add(label);
  }
  for (const label of otherVersions(world.robots)) named.get(OTHER_VERSION)?.add(label);
  return [...named].filter(([, robots]) => robots.size)
    .map(([line, robots]) => t(line, { robots: [...robots].join(", ") }));
}

// Returns the names of the robots on which something else runs than on most.
function otherVersions(robots) {
  const known = robots.filter(({ version }) => version);
  const count = (version) => known.filter((each) => each.version === version).length;
  const [usual] = known.map(({ version }) => version).sort((one, other) => count(other) - count(one));
  return known.filter(({ version }) => version !== usual).map(({ label }) => label);
}
