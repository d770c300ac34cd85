// The programs to begin with.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { EMPTY, parseProgram, problemOf } from "#www/program/check.js";

import "./blockly.js";
import { interpret } from "./programs.js";

const { EXAMPLES, NEW_PYTHON } = await import("#www/program/examples.js");
const PAGE = readFileSync(new URL("../../morbot_ws/src/jetbot_cockpit/www/program.html", import.meta.url), "utf8");
const SENSES = { here: { X: 0.97 }, line: [0.3, 0, 1], wheels: [0, 0] };

for (const [name, example] of Object.entries({ EMPTY, ...EXAMPLES })) {
  test(`${name} is opened, and runs`, () => {
    assert.equal(problemOf(example), "");
    const { error, commands } = interpret(JSON.parse(example), SENSES);
    assert.equal(error, "");
    assert.ok(commands.length || example === EMPTY);
  });
}

test("the page lists the examples, which it loads when one is chosen", () => {
  assert.deepEqual([...PAGE.matchAll(/<option>(.*?)</g)].map(([, name]) => name), Object.keys(EXAMPLES));
});

test("a new program in Python is the workshop's loop, above no blocks", () => {
  const { python, ...blocks } = parseProgram(NEW_PYTHON);
  assert.deepEqual(blocks, JSON.parse(EMPTY));
  assert.match(python, /^#!.*python3\n[^]*while not rospy\.is_shutdown\(\):\n {4}publisher\.publish\(motion\)\n/);
});
