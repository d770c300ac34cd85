// Why a robot is stopped, for pupils: where its own status is for a person at its terminal.

const WAITS = "it waits for a new command";
const CAUSES = { // codes of the controller's state
  own_emergency_stop: "by your teacher",
  no_master: "the computer of the robots does not answer. Tell your teacher.",
  suspended: "it is paused at its computer. Tell your teacher.",
  own_emergency_stop_released: WAITS, no_master_released: WAITS, suspended_released: WAITS, old_command: WAITS,
  not_finite: "the command was not a number",
  no_command: "no more commands came",
  board: "its motor board cannot be reached. Tell your teacher.",
  guard: "its safety program does not run. Tell your teacher.",
};

// Returns the status of a robot in words for pupils.
export function forPupils({ status, cause }) {
  return Object.hasOwn(CAUSES, cause) ? `stopped: ${CAUSES[cause]}` : status;
}
