// A program from elsewhere is opened without what this page does not know, or refused in a sentence.

import assert from "node:assert/strict";
import { test } from "node:test";

import { EMPTY, parseProgram, problemOf, withPython, writeProgram } from "#www/program/check.js";

const START = { type: "robot_start" };
const opened = (...blocks) => parseProgram(JSON.stringify({ blocks: { blocks } })).blocks.blocks;
const problem = (...blocks) => problemOf(JSON.stringify({ blocks: { blocks } }));

test("what is no program is refused", () => {
  for (const text of ["", "{}", "[]", "null", "7", '{"blocks": {"blocks": 5}}', '{"blocks": {"blocks": [null]}}',
    '{"blocks": {"blocks": []}, "variables": [{"name": 5, "id": "x"}]}']) {
    assert.equal(problemOf(text), "This file is no program of this page.", text);
  }
});

test("a block that the page does not know is named", () => {
  assert.equal(problem({ type: "robot_fly" }), "This page does not know the block robot_fly.");
  assert.equal(problem({ type: "constructor" }), "This page does not know the block constructor.");
  assert.ok(problem({ type: "x".repeat(1000) }).length < 100);
});

for (const [what, block, kept] of [
  ["keys that the page does not know are left out", { icons: { comment: {} }, data: "x", disabledReasons: ["x"] }, {}],
  ["a state that is XML is left out", { extraState: "<mutation elseif='1000000'/>" }, {}],
  ["a block far away is brought near", { x: 1e300, y: "far" }, { x: 1e5, y: 0 }],
]) {
  test(what, () => assert.deepEqual(opened({ ...START, ...block }), [{ ...START, ...kept }]));
}

test("ends of lines and control characters in texts and names are left out", () => {
  const [{ fields }] = opened({ type: "text", fields: { TEXT: "a\r\nimport os\u202e\0" } });
  assert.equal(fields.TEXT, "aimport os");
  const { variables } = parseProgram('{"blocks": {"blocks": []}, "variables": [{"name": "a\\nb", "id": "x"}]}');
  assert.equal(variables[0].name, "ab");
});

test("very deep nesting, also in what a block holds, is refused like any other", () => {
  const deep = (before, after) => before.repeat(9000) + after.repeat(9000);
  const inputs = deep('{"type": "text", "inputs": {"A": {"block": ', "}}}").replace("}", "{}}");
  assert.match(problemOf(`{"blocks": {"blocks": [${inputs}]}}`), /^This program nests more than 60 blocks/);
  const fields = deep('{"a": ', "}").replace("}", "1}");
  assert.equal(problemOf(`{"blocks": {"blocks": [{"type": "robot_start", "fields": ${fields}}]}}`),
    "This file is no program of this page.");
});

test("two thousand variables are opened, more are refused", () => {
  const named = (count) => JSON.stringify({ blocks: { blocks: [START] }, variables: Array.from({ length: count },
    (_, id) => ({ name: `x${id}`, id: `${id}` })) });
  assert.equal(problemOf(named(2000)), "");
  assert.equal(problemOf(named(2001)), "This program has more than 2000 variables.");
});

test("variables and functions of one name, also with other capitals, are refused", () => {
  const variables = ["x", "X"].map((name) => ({ name, id: name.repeat(2) }));
  assert.equal(problemOf(JSON.stringify({ blocks: { blocks: [START] }, variables })),
    "Two variables of this program have the same name.");
  const blocks = ["side", "Side "].map((NAME) => ({ type: "procedures_defnoreturn", fields: { NAME } }));
  assert.equal(problemOf(JSON.stringify({ blocks: { blocks } })), "Two functions of this program have the same name.");
});

test("a block with very many branches, parts or parameters is refused", () => {
  for (const extraState of [{ elseIfCount: 51 }, { itemCount: 1e9 }, { params: Array(51).fill({}) }]) {
    assert.equal(problem({ type: "controls_if", extraState }), "This program has a block with more than 50 parts.");
  }
});

test("a file that is too large is refused before it is read", () => {
  assert.equal(problemOf("[".repeat(512 * 1024 + 1)), "This file is too large: a program has 512 kB at most.");
});

const reopened = (python) => parseProgram(withPython(python)).python;

test("a program that is a text is opened as it was, with its blocks as a copy", () => {
  const program = { ...JSON.parse(EMPTY), python: "if x:\n\tprint('ä 👩‍🏫', 1)\n\n\n" };
  assert.deepEqual(parseProgram(writeProgram(program)), program);
  assert.equal(reopened(""), "");
  assert.ok(!("python" in parseProgram(EMPTY)));
});

test("what could hide in a text, or reverse it, is left out, and its lines stay", () => {
  assert.equal(reopened("a\r\nb\rc\u2028\u202ed\0\x1b[1m\ud800e\n"), "a\nb\ncd[1me\n");
});

test("a text that is none is refused", () => {
  for (const python of [7, null, ["print(1)"], { length: 3 }]) {
    assert.equal(problemOf(withPython(python)), "This file is no program of this page.");
  }
});
