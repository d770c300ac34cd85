// Why a program has ended stays on the page: it says what was, on a page without a pad.

import assert from "node:assert/strict";
import { test } from "node:test";

import { ending } from "#www/program/endings.js";

const GIVEN = { robot: "red", driver: "Bob", seconds: "0.3" };
const ENDINGS = { // of all refusals of a command: notices.py
  own_robot_only: "With your code, you can drive only red.",
  interrupted: "The cockpit was interrupted, so the robot stopped. Run it again.",
  no_command: "No command came for 0.3 s, so the robot stopped. Run it again.",
  let_go: "The robot was stopped meanwhile. Run it again.",
  taken: "Your teacher took red.",
  driven: "Bob was driving red, and one person drives it at a time.",
  no_master: "The computer of the robots did not answer. Tell your teacher.",
  ended: "red stopped running.",
  all_stopped: "All robots were stopped by an emergency stop.",
  no_answer: "red did not answer.",
  stopped: "red was stopped by an emergency stop.",
};

for (const [code, sentence] of Object.entries(ENDINGS)) {
  test(`a program that ends by ${code} says: ${sentence}`, () => {
    const template = "With your code, you can drive only {robot}."; // of which a page has its translation
    assert.equal(ending({ code, arguments: GIVEN, text: "in English", template }), sentence);
  });
}
