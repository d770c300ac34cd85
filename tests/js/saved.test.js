// A program that is saved and opened again is the same, to the byte.

import assert from "node:assert/strict";
import { test } from "node:test";

import { reopen, save } from "./blockly.js";
import { randomProgram } from "./random_programs.js";

const { TOOLBOX } = await import("#www/program/blocks.js");
const { writeProgram } = await import("#www/program/check.js");
const { EXAMPLES } = await import("#www/program/examples.js");
const { TYPES } = await import("#www/program/semantics.js");
const { Blockly } = globalThis;

const COUNT = Number(process.env.PROGRAMS ?? 100); // random programs

const program = (blocks, variables = []) => ({ blocks: { languageVersion: 0, blocks }, variables });
const PARAMETERS = [{ name: "n", id: "n" }, { name: "m", id: "m" }];
const FUNCTIONS = [
  { type: "procedures_defnoreturn", x: 9, y: -7, fields: { NAME: "side" } },
  { type: "procedures_defreturn", x: 300, y: 5, fields: { NAME: "area" }, extraState: { params: PARAMETERS } },
  { type: "procedures_defreturn", fields: { NAME: "now" }, extraState: { hasStatements: false } },
];
const VARIABLES = [...PARAMETERS, { name: "طول\u200cها", id: "ط" }];

function unchanged(text) {
  assert.equal(reopen(text), text);
}

// All blocks of the toolbox as they lie there, also those of variables and functions.
function shelf() {
  const workspace = Object.assign(new Blockly.Workspace(), { registerButtonCallback() {} });
  Blockly.serialization.workspaces.load(program(FUNCTIONS, VARIABLES), workspace);
  const dynamic = { VARIABLE: Blockly.Variables.flyoutCategory, PROCEDURE: Blockly.Procedures.flyoutCategory };
  const contents = TOOLBOX.contents.flatMap((/** @type {any} */ { contents: own, custom }) => (
    own ?? dynamic[custom](workspace, false)));
  return contents.filter(({ kind }) => kind === "block");
}

test("each block of the toolbox as it lies there", () => {
  const blocks = shelf();
  assert.deepEqual(new Set(["robot_start", ...blocks.map(({ type }) => type)]), TYPES, "the toolbox has all blocks");
  for (const block of blocks) unchanged(save(program([...FUNCTIONS, block], VARIABLES)));
});

test("each example", () => {
  for (const example of Object.values(EXAMPLES)) unchanged(reopen(example));
});

test("a block whose inputs lie below each other", () => {
  const text = save(program([{ type: "controls_for", inline: false, x: 1, y: 2 }]));
  assert.ok(text.includes('"inline":false'), text);
  unchanged(text);
});

test("names and texts in all scripts, and emoji of several characters", () => {
  for (const words of ["👩‍👩‍👧‍👦 🏴󠁧󠁢󠁥󠁮󠁧󠁿 👍🏽 ❤️", "می‌خواهم", "שלום\u200f", "क्‍ष", "前　進", "10 km", "\ue000",
    "x".repeat(300)]) {
    const text = save(program([
      { type: "procedures_defnoreturn", x: 0, y: 0, fields: { NAME: words } },
      { type: "text", x: 0, y: 50, fields: { TEXT: words } }], [{ name: words, id: "x" }]));
    assert.equal(text.split(words).length, 4, text);
    unchanged(text);
  }
});

test("what the page itself says of a block is not saved", () => {
  const said = { deletable: false, disabledReasons: ["ORPHANED_BLOCK"] };
  assert.equal(save(program([{ type: "robot_stop", x: 1, y: 2, id: "a", ...said }])),
    save(program([{ type: "robot_stop", x: 1, y: 2 }])));
});

test(`${COUNT} random programs, with all blocks, choices and shapes`, () => {
  const texts = Array.from({ length: COUNT }, (_, index) => writeProgram(randomProgram(index + 1)));
  texts.forEach(unchanged);
  for (const type of TYPES) assert.ok(texts.some((text) => text.includes(`"type":"${type}"`)), type);
});

test("a call of a function that is called as Blockly calls each at first", () => {
  const [side, unnamed] = ["side", "unnamed"].map((NAME) => ({ ...FUNCTIONS[0], fields: { NAME } }));
  const call = { type: "procedures_callnoreturn", extraState: { name: "unnamed" } };
  const calling = { ...side, inputs: { STACK: { block: call } } };
  for (const blocks of [[call, side, unnamed], [unnamed, calling], [calling, unnamed]]) {
    const opened = reopen(JSON.stringify(program(blocks)));
    assert.equal(opened.match(/"extraState":{"name":"unnamed"}/g)?.length, 1, opened);
    unchanged(opened);
  }
});
