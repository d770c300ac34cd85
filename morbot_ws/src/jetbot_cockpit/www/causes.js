// What a robot does and why: for pupils where its own status is for a person at its terminal, in the page's language.

/** @import { RobotState } from "./messages.js" */
/** @import { World } from "./world.js" */
/** @typedef {Pick<RobotState, "status" | "state" | "cause" | "template" | "arguments" | "remarks">} Status */

import { t } from "./language.js";

const STOPS = ["emergency_stop", "own_emergency_stop", "board", "guard"]; // causes: it has heard of a stop, or cannot
const WAITS = t("it waits for a new command");
const CAUSES = { // codes of the controller's state
  own_emergency_stop: t("by your teacher"),
  no_master: t("the computer of the robots does not answer. Tell your teacher."),
  suspended: t("it is paused at its computer. Tell your teacher."),
  own_emergency_stop_released: WAITS, no_master_released: WAITS, suspended_released: WAITS, old_command: WAITS,
  not_finite: t("the command was not a number"),
  no_command: t("no more commands came"),
  board: t("its motor board cannot be reached. Tell your teacher."),
  guard: t("its safety program does not run. Tell your teacher."),
};

// Returns what a person needs to know about the robot now: a sentence, and how urgent it is.
/** @param {World} world @param {string} id */
export function summarize(world, id) {
  const { state, warning, answers } = world.state(id);
  const robot = world.robot(id)?.label ?? t("The robot");
  const as = (level, text) => ({ text, level });
  if (!answers) return world.isAway(id) ? as("away", describeAway(world, id)) : as("warning", silent(world, robot));
  if (world.emergency && world.unconfirmed.includes(id)) {
    return as("warning", t("{robot} has not confirmed the stop. Use its own switch.", { robot }));
  }
  const status = (world.teacher ? inWords : forPupils)(world.state(id));
  const stop = stopOf(world, id, status);
  if (stop) return as("stopped", stop);
  if (world.isTaken(id)) {
    return as("stopped", t("Your teacher has taken {robot}. Wait until a teacher presses Go on.", { robot }));
  }
  const level = warning ? "warning" : state === "driving" ? "driving" : "waiting";
  return as(level, status || t("waiting for its status"));
}

// Returns which emergency stop holds the robot, or "".
/** @param {World} world */
function stopOf(world, id, status) {
  const { cause, stopped } = world.state(id);
  if (world.emergency && world.mustWait) return t("Your teacher stopped all robots.");
  if (!world.emergency && !stopped) return "";
  return STOPS.includes(cause) ? status : t("stopped: emergency stop");
}

/** @param {World} world */
function silent(world, robot) {
  return world.teacher ? t("{robot} does not answer. Restart it, or resume it with fg.", { robot })
    : t("{robot} does not answer. Tell your teacher.", { robot });
}

// Returns why a robot is out of reach, and that it does not drive on.
/** @param {World} world */
function describeAway(world, id) {
  const { template, arguments: values } = world.state(id);
  const why = template ? t(template, values) : t("{robot} is out of reach.", { robot: world.robot(id)?.label });
  return `${why} ${t("Driven from here, it stops by itself within 0.3 s.")}`;
}

// Returns the status of a robot in words for pupils.
/** @param {Status} robot */
export function forPupils(robot) {
  return Object.hasOwn(CAUSES, robot.cause) ? t("stopped: {cause}", { cause: CAUSES[robot.cause] }) : inWords(robot);
}

// Returns the status of a robot as its controller words it; in English if that does not send it as data.
/** @param {Status} robot */
export function inWords({ status, state, template, arguments: values, remarks }) {
  const does = template ? t("stopped: {cause}", { cause: t(template, values) }) : state === "driving" && t("driving");
  if (!does || !remarks) return status;
  return [does, ...remarks.map((remark) => t(remark.template, remark.arguments))].join(", ");
}
