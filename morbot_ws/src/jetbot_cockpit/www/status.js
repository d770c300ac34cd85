// What both pages show of the chosen robot and of the connection: how it is, and why it does not move.

/** @import { World } from "./world.js" */

import { visible } from "./colors.js";
import { element, setClass, setText } from "./dom.js";
import { t } from "./language.js";
import { describePlace } from "./place.js";

const PLACE_INTERVAL = 1000; // ms: a screen reader that reads the map is not interrupted more often

let placeShownAt = -Infinity;

// Shows the chosen robot's status, and its colour. problem: why there is no connection, or ""
/** @param {World} world */
export function showStatus(world, problem) {
  const robot = world.robot(world.chosen);
  const { text, level } = problem ? { text: problem, level: "warning" } : world.status;
  setText(element("sentence"), text);
  element("status").dataset.level = level;
  if (robot) document.documentElement.style.setProperty("--robot", visible(robot.color));
  setClass(document.body, "offline", problem);
}

// Shows where the chosen robot is, as the map's text.
/** @param {World} world */
export function showPlace(world, problem) {
  if (performance.now() - placeShownAt < PLACE_INTERVAL) return;
  placeShownAt = performance.now();
  const { pose, ...place } = world.placeOf(world.chosen);
  const text = `${t("Map from above.")} ${describePlace({ pose: problem ? null : pose, ...place })}`;
  const map = element("map");
  if (map.getAttribute("aria-label") !== text) map.setAttribute("aria-label", text);
}

export function showRoundTrip(milliseconds) {
  const text = `${Math.max(1, Math.round(milliseconds))} ms`;
  setText(element("link"), text);
  element("link").dataset.quality = milliseconds < 60 ? "good" : milliseconds < 200 ? "fair" : "poor";
  element("link").setAttribute("aria-label", `Connection: ${text} to the cockpit and back`);
}
