// The blocks that a person finds in the toolbox.

import assert from "node:assert/strict";
import { test } from "node:test";

import { problemOf } from "#www/program/check.js";
import { TYPES } from "#www/program/interpreter.js";

import { write } from "./blockly.js";

const { TOOLBOX } = await import("#www/program/blocks.js");
const { Blockly } = globalThis;
const BLOCKS = TOOLBOX.contents.flatMap(({ contents }) => contents ?? []);
const alone = (block) => ({ blocks: { languageVersion: 0, blocks: [block] } });

for (const { kind, ...block } of BLOCKS) {
  test(`${block.type} can be opened again, run, and written in Python`, () => {
    assert.equal(problemOf(JSON.stringify(alone(block))), "");
    assert.ok(TYPES.has(block.type));
    const workspace = new Blockly.Workspace();
    const { outputConnection } = Blockly.serialization.blocks.append(block, workspace);
    const start = outputConnection ? { type: "robot_print", inputs: { VALUE: { block } } } : block;
    assert.equal(typeof write(alone({ type: "robot_start", next: { block: start } })).text, "string");
  });
}
