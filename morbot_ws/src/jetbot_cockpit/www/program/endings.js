// Why a program has ended, by the codes of what the cockpit refuses. It stays on the page, so it says what was.

/** @import { Said } from "../messages.js" */

const ENDINGS = {
  interrupted: () => "The cockpit was interrupted, so the robot stopped. Run it again.",
  no_command: ({ seconds }) => `No command came for ${seconds} s, so the robot stopped. Run it again.`,
  let_go: () => "The robot was stopped meanwhile. Run it again.",
  taken: ({ robot }) => `Your teacher took ${robot}.`,
  driven: ({ driver, robot }) => `${driver} was driving ${robot}, and one person drives it at a time.`,
  no_master: () => "The computer of the robots did not answer. Tell your teacher.",
  ended: ({ robot }) => `${robot} stopped running.`,
  all_stopped: () => "All robots were stopped by an emergency stop.",
  no_answer: ({ robot }) => `${robot} did not answer.`,
  stopped: ({ robot }) => `${robot} was stopped by an emergency stop.`,
};

// Returns the sentence.
/** @param {Said} said */
export function ending({ code, arguments: given, text }) {
  return ENDINGS[code]?.(given) ?? text;
}
