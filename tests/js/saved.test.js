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

// This block, and it again with each other choice of its dropdowns.
function choices(block) {
  const workspace = new Blockly.Workspace();
  Blockly.serialization.workspaces.load(program([...FUNCTIONS, block], VARIABLES), workspace);
  const fields = [...workspace.getBlocksByType(block.type)].flatMap((each) => [...each.getFields()]);
  const dropdowns = fields.filter((each) => each instanceof Blockly.FieldDropdown
    && !(each instanceof Blockly.FieldVariable));
  return [block, ...dropdowns.flatMap(({ name, ...field }) => field.menuGenerator_.map(([, value]) => (
    { ...block, fields: { ...block.fields, [name]: value } })))];
}

test("each block of the toolbox, with each of its choices", () => {
  const blocks = shelf();
  assert.deepEqual(new Set(["robot_start", ...blocks.map(({ type }) => type)]), TYPES, "the toolbox has all blocks");
  for (const block of blocks.flatMap(choices)) unchanged(save(program([...FUNCTIONS, block], VARIABLES)));
});

test("each example", () => {
  for (const example of Object.values(EXAMPLES)) unchanged(reopen(example));
});

test("each shape that a person gives a block", () => {
  const states = {
    controls_if: [{ elseIfCount: 2, hasElse: true }, { elseIfCount: 1 }, { hasElse: true }],
    text_join: [{ itemCount: 0 }, { itemCount: 5 }],
    procedures_ifreturn: ['<mutation value="0"></mutation>', '<mutation value="1"></mutation>'],
    procedures_defreturn: [{ params: PARAMETERS, hasStatements: false }],
  };
  for (const [type, each] of Object.entries(states)) {
    for (const extraState of each) {
      const text = save(program([{ type, x: 1, y: 2, extraState }], VARIABLES));
      assert.ok(text.includes(JSON.stringify(extraState)), text);
      unchanged(text);
    }
  }
  const text = save(program([{ type: "controls_for", inline: false, x: 1, y: 2 }]));
  assert.ok(text.includes('"inline":false'), text);
  unchanged(text);
});

test("a return without a value, in a function, is opened without one", () => {
  const text = save(program([{ type: "procedures_defnoreturn", fields: { NAME: "f" }, inputs: { STACK: { block: {
    type: "procedures_ifreturn", extraState: '<mutation value="0"></mutation>' } } } }]));
  assert.match(text, /value=\\"0\\"/);
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

test(`${COUNT} random programs`, () => {
  for (let seed = 1; seed <= COUNT; seed += 1) unchanged(writeProgram(randomProgram(seed)));
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
