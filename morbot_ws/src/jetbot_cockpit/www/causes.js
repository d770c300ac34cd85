// Why a robot is stopped: for pupils where its own status is for a person at its terminal, in the page's language.

/** @import { RobotState } from "./messages.js" */
/** @typedef {Pick<RobotState, "status" | "state" | "cause" | "template" | "arguments" | "remarks">} Status */

import { t } from "./language.js";

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
