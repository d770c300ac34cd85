// A test as steps: a number is the ms that pass; any other step acts on the stage that they share, or looks at it.

import assert from "node:assert/strict";

// stage: what the steps share, with its clock
export async function play(stage, steps) {
  for (const step of steps) await (typeof step === "number" ? stage.clock.pass(step) : step(stage));
}

// Returns a function that makes a step: what is seen is so. views: what there is to see, beside the stage's fields
export const sight = (views) => (expected) => (stage) => {
  const seen = Object.keys(expected).map((key) => [key, Object.hasOwn(views, key) ? views[key](stage) : stage[key]]);
  assert.deepEqual(Object.fromEntries(seen), expected);
};
