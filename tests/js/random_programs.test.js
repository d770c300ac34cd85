// Random programs are what a person may build; tests/unit/differential.py runs them.

import assert from "node:assert/strict";
import { test } from "node:test";

import { problemOf } from "#www/program/check.js";

import "./blockly.js";
import { randomProgram } from "./random_programs.js";
import { smallerPrograms } from "./smaller_programs.js";

const { TOOLBOX } = await import("#www/program/blocks.js");
const PROGRAMS = Array.from({ length: 200 }, (_, seed) => randomProgram(seed));

test("a seed makes always the same program, and another one another", () => {
  assert.deepEqual(randomProgram(7), PROGRAMS[7]);
  assert.equal(new Set(PROGRAMS.map((program) => JSON.stringify(program))).size, PROGRAMS.length);
});

test("random programs use all blocks of the toolbox, and can be opened", () => {
  const text = JSON.stringify(PROGRAMS);
  for (const { type } of TOOLBOX.contents.flatMap(({ contents }) => contents ?? [])) {
    assert.ok(text.includes(`"type":"${type}"`), type);
  }
  for (const program of PROGRAMS) assert.equal(problemOf(JSON.stringify(program)), "");
});

test("a program that is made smaller has less in it, down to its start", () => {
  let program = PROGRAMS[1];
  for (let smaller = [program]; smaller.length; smaller = smallerPrograms(program)) {
    assert.ok(smaller.every((each) => JSON.stringify(each).length <= JSON.stringify(program).length));
    [program] = smaller;
  }
  const [{ next, ...start }, ...others] = program.blocks.blocks;
  assert.deepEqual([start.type, next?.block, others], ["robot_start", undefined, []]);
});
