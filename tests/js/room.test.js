// A program that is built can always be kept and opened again: what would be too much is undone, in a sentence.

import assert from "node:assert/strict";
import { test } from "node:test";

import { limits } from "#www/limits.js";
import { problemOf } from "#www/program/check.js";
import { Room } from "#www/program/room.js";

Object.assign(limits, { program: 64 * 1024 });

const text = (...blocks) => JSON.stringify({ blocks: { blocks } });
const nested = (depth) => (depth ? { type: "logic_negate", inputs: { BOOL: { block: nested(depth - 1) } } }
  : { type: "logic_boolean" });
const long = (size) => ({ type: "text", fields: { TEXT: "x".repeat(size) } });
const many = (count) => Array.from({ length: count }, () => ({ type: "text" }));

// Returns what a person reads of each change to what was opened.
function build(opened, ...changed) {
  const room = new Room();
  assert.equal(room.change(opened, false), "");
  return changed.map((program) => room.change(program, true));
}

for (const [what, least, more, sentence] of [
  ["deep", text(nested(60)), text(nested(61)), "This program nests more than 60 blocks in each other"],
  ["large", text(long(65000)), text(long(65536)), "This program has more than 64 kB"],
  ["long", text(...many(2000)), text(...many(2001)), "This program has more than 2000 blocks"],
]) {
  test(`a change that makes the program too ${what} is undone`, () => {
    assert.equal(problemOf(least), "");
    assert.deepEqual(build(text(), least, more), ["", `With the last change: ${sentence}. It was undone.`]);
  });
}

test("what was opened from a file that is too large to be kept can be changed", () => {
  assert.deepEqual(build(text(long(70000)), text(long(70001)), text(long(9)), text(long(8))), ["", "", ""]);
});

test("once such a program is small enough, it stays so", () => {
  assert.match(build(text(long(70000)), text(long(9)), text(long(70000))).at(-1), /undone/);
});
