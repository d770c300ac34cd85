// The programs to begin with.

import assert from "node:assert/strict";
import { test } from "node:test";

import { problemOf } from "#www/program/check.js";

import "./blockly.js";
import { interpret } from "./programs.js";

const { EMPTY, EXAMPLES } = await import("#www/program/examples.js");
const SENSES = { here: { X: 0.97 }, line: [0.3, 0, 1], wheels: [0, 0] };

for (const [name, example] of Object.entries({ EMPTY, ...EXAMPLES })) {
  test(`${name} is opened, and runs`, () => {
    assert.equal(problemOf(example), "");
    const { error, commands } = interpret(JSON.parse(example), SENSES);
    assert.equal(error, "");
    assert.ok(commands.length || example === EMPTY);
  });
}
