// What both pages show of the chosen robot and of the connection: how it is, and why it does not move.

/** @import { World } from "./world.js" */

import { visible } from "./colors.js";
import { element, setClass, setText } from "./dom.js";
import { t } from "./language.js";

const OWN = ["", "zero"]; // causes: what a person's own hand does

// Shows the chosen robot's status, and its colour. problem: why there is no connection, or ""
/** @param {World} world */
export function showStatus(world, problem) {
  const robot = world.robot(world.chosen);
  const { text, level } = problem ? { text: problem, level: "warning" } : world.status;
  element("status").setAttribute("aria-live", isOwn(world, level) ? "off" : "polite");
  setText(element("sentence"), text);
  element("status").dataset.level = level;
  if (robot) document.documentElement.style.setProperty("--robot", visible(robot.color));
  setClass(document.body, "offline", problem);
}

// Whether the status says only that this person drives, or does not: a screen reader would say that at each press.
function isOwn(world, level) {
  const { cause } = world.state(world.chosen);
  return world.isMine(world.chosen) && ["driving", "waiting"].includes(level) && OWN.includes(cause);
}

export function showRoundTrip(milliseconds) {
  const text = `${Math.max(1, Math.round(milliseconds))} ms`;
  setText(element("link"), text);
  element("link").dataset.quality = milliseconds < 60 ? "good" : milliseconds < 200 ? "fair" : "poor";
  element("link").setAttribute("aria-label", t("Connection: {time} to the cockpit and back", { time: text }));
}
