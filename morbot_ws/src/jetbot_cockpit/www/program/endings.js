// Why a program has ended, by the codes of what the cockpit refuses. It stays on the page, so it says what was.

import { said, t } from "../language.js";

/** @import { Said } from "../messages.js" */

const ENDINGS = {
  interrupted: () => t("The cockpit was interrupted, so the robot stopped. Run it again."),
  no_command: (given) => t("No command came for {seconds} s, so the robot stopped. Run it again.", given),
  let_go: () => t("The robot was stopped meanwhile. Run it again."),
  taken: (given) => t("Your teacher took {robot}.", given),
  driven: (given) => t("{driver} was driving {robot}, and one person drives it at a time.", given),
  no_master: () => t("The computer of the robots did not answer. Tell your teacher."),
  ended: (given) => t("{robot} stopped running.", given),
  all_stopped: () => t("All robots were stopped by an emergency stop."),
  no_answer: (given) => t("{robot} did not answer.", given),
  stopped: (given) => t("{robot} was stopped by an emergency stop.", given),
};

// Returns the sentence; of another code, what the cockpit says.
/** @param {Pick<Said, "code" | "arguments"> & Partial<Said>} message */
export function ending(message) {
  return ENDINGS[message.code]?.(message.arguments) ?? said({ text: "", ...message });
}
