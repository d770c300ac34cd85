// The blocks that a person finds in the toolbox.

import assert from "node:assert/strict";
import { test } from "node:test";

import { problemOf } from "#www/program/check.js";

import { write } from "./blockly.js";

const { TOOLBOX } = await import("#www/program/blocks.js");
const { Blockly } = globalThis;
const BLOCKS = TOOLBOX.contents.flatMap(({ contents }) => contents ?? []);
const alone = (block) => ({ blocks: { languageVersion: 0, blocks: [block] } });

for (const { kind: _, ...block } of BLOCKS) {
  test(`${block.type} can be opened again, and becomes Python`, () => {
    assert.equal(problemOf(JSON.stringify(alone(block))), "");
    const { outputConnection } = Blockly.serialization.blocks.append(block, new Blockly.Workspace());
    const statement = outputConnection ? { type: "robot_print", inputs: { VALUE: { block } } } : block;
    const empty = write(alone({ type: "robot_start" })).text;
    assert.ok(write(alone({ type: "robot_start", next: { block: statement } })).text.length > empty.length);
  });
}

test("a text that is pasted is as it is kept, and as its Python has it", () => {
  const block = Blockly.serialization.blocks.append({ type: "text" }, new Blockly.Workspace());
  block.setFieldValue("one\ttwo\u202e", "TEXT");
  assert.equal(block.getFieldValue("TEXT"), "onetwo");
});

test("a screen reader names each field of the robot's blocks by what it is for", () => {
  const fields = BLOCKS.filter(({ type }) => type.startsWith("robot_")).flatMap(({ kind: _, ...block }) => {
    const shown = Blockly.serialization.blocks.append(block, new Blockly.Workspace());
    return shown.getDescendants(true).flatMap((each) => [...each.getFields()]);
  });
  const names = fields.filter(({ EDITABLE }) => EDITABLE).map((field) => field.getAriaTypeName());
  assert.deepEqual(new Set(names), new Set(["x in power", "z in power", "left wheel in power", "right wheel in power",
    "seconds", "side", "place", "eye", "wheel", "value to print", "name of the curve"]));
});
