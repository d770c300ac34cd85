// What is shown of the chosen robot: who drives it, why it does not move, and what a teacher can do with it.

import { element, setClass, setText } from "./dom.js";
import { showTask } from "./task.js";
import { showView } from "./views.js";
import { showWheels } from "./wheels.js";
import { describeDriver, summarize } from "./world.js";

// problem: why there is no connection, or ""
export function showPanel(world, id, problem) {
  const robot = world.robot(id);
  const state = world.state(id);
  const { text, level } = problem ? { text: problem, level: "warning" } : currentStatus(world, id);
  setText(element("sentence"), text);
  element("status").dataset.level = level;
  setText(element("driver"), robot && !problem ? describeDriver(world, id) : "");
  if (robot) document.documentElement.style.setProperty("--robot", robot.color);
  setClass(document.body, "offline", problem);
  showWheels(robot, state);
  showTask(robot && state.task);
  showTeachersTools(world, robot, state);
}

function currentStatus(world, id) {
  if (world.robot(id)) return summarize(world, id);
  const own = world.me.robot ?? id;
  const missing = own ? `${own.slice(1) || "The robot"} is not running.` : "No robot is running: start one.";
  return { text: `${missing} This page shows it as soon as it runs.`, level: "waiting" };
}

function showTeachersTools(world, robot, { driver }) {
  const several = world.robots.length > 1;
  const fleet = world.teacher && several;
  element("fit").hidden = !several && !world.scenes.get(robot?.id)?.length;
  element("fleet").hidden = element("show-fleet").hidden = !fleet;
  element("show-codes").hidden = !world.me.codes;
  element("take").hidden = !(world.teacher && driver && driver.id !== world.me.id);
  element("reset").hidden = !(world.teacher && robot?.simulated);
  setClass(document.body, "several", fleet);
  if (!fleet && document.body.dataset.view === "fleet") showView("drive");
}

export function showRoundTrip(milliseconds) {
  const text = `${Math.max(1, Math.round(milliseconds))} ms`;
  setText(element("link"), text);
  element("link").dataset.quality = milliseconds < 60 ? "good" : milliseconds < 200 ? "fair" : "poor";
  element("link").setAttribute("aria-label", `Connection: ${text} to the cockpit and back`);
}
