// What both pages show of the chosen robot and of the connection: how it is, and why it does not move.

/** @import { World } from "./world.js" */

import { visible } from "./colors.js";
import { element, setClass, setText } from "./dom.js";
import { t } from "./language.js";

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

export function showRoundTrip(milliseconds) {
  const text = `${Math.max(1, Math.round(milliseconds))} ms`;
  setText(element("link"), text);
  element("link").dataset.quality = milliseconds < 60 ? "good" : milliseconds < 200 ? "fair" : "poor";
  element("link").setAttribute("aria-label", t("Connection: {time} to the cockpit and back", { time: text }));
}
