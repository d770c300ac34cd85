// The programs to begin with; tests/unit/test_python_texts.py runs the examples.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { EMPTY, parseProgram } from "#www/program/check.js";

import "./blockly.js";

const { EXAMPLES, NEW_PYTHON } = await import("#www/program/examples.js");
const PAGE = readFileSync(new URL("../../morbot_ws/src/jetbot_cockpit/www/program.html", import.meta.url), "utf8");

test("the page lists the examples, which it loads when one is chosen", () => {
  assert.deepEqual([...PAGE.matchAll(/<option>(.*?)</g)].map(([, name]) => name), Object.keys(EXAMPLES));
});

test("a new program in Python is the workshop's loop, above no blocks", () => {
  const { python, ...blocks } = parseProgram(NEW_PYTHON);
  assert.deepEqual(blocks, JSON.parse(EMPTY));
  assert.match(python, /^#!.*python3\n[^]*while not rospy\.is_shutdown\(\):\n {4}publisher\.publish\(motion\)\n/);
});
