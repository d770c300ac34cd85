// The blocks as Blockly has them, and the toolbox. Blockly is a script of the page, not a module.

import { t } from "../language.js";
import { toText } from "../storage.js";
import "./words.js";
import { DRIVE, ROBOT, SENSE } from "./robot.js";
import { named } from "./spoken.js";

const { Blockly } = globalThis;

const WORKSHOP = { X: t("power"), Z: t("power") };
const SI = { X: "m/s", Z: "rad/s" };
const TEXT = { // Blockly's own has pictures of quotes, which the page's Content-Security-Policy forbids
  type: "text", message0: "“%1”", args0: [{ type: "field_input", name: "TEXT", text: "" }], output: "String",
  colour: "#6a4fb5", tooltip: t("A text."),
};

// Takes a number as a person types it: 0,7 is 0.7, while Blockly drops the comma, and makes it 7.
class NumberField extends named(Blockly.FieldNumber) {
  doClassValidation_(value) {
    return super.doClassValidation_(typeof value === "string" ? value.replaceAll(",", ".") : value);
  }

  widgetCreate_() {
    return Object.assign(super.widgetCreate_(), { inputMode: "decimal" });
  }

  showPromptEditor() {
    super.showPromptEditor();
    /** @type {any} */ (document.querySelector(".blocklyDialogInput")).inputMode = "decimal";
  }
}

// Takes a text as it is kept: a tab that is pasted would be in the page's program, but not in its Python.
class TextField extends named(Blockly.FieldTextInput) {
  doClassValidation_(value) {
    return super.doClassValidation_(typeof value === "string" ? toText(value) : value);
  }
}

// Defines the blocks, once.
export function defineBlocks() {
  Blockly.Extensions.register("units", /** @this {any} */ function label() {
    showUnits(this);
  });
  for (const [name, kind] of Object.entries({ field_number: NumberField, field_input: TextField })) {
    Blockly.fieldRegistry.unregister(name);
    Blockly.fieldRegistry.register(name, kind);
  }
  delete Blockly.Blocks.text;
  Blockly.common.defineBlocksWithJsonArray([...ROBOT, TEXT]);
  for (const type of ["procedures_defnoreturn", "procedures_defreturn"]) {
    const { init } = Blockly.Blocks[type];
    Blockly.Blocks[type].init = /** @this {any} */ function named() {
      init.call(this);
      nameAtFirst(this.getField("NAME"));
    };
  }
  Object.assign(Blockly.Blocks.procedures_ifreturn, { loadExtraState: loadReturn });
  Blockly.libraryBlocks?.loops?.loopTypes.add("robot_loop");
}

// Lets the name that a new function is given rename no calls: before it is "unnamed", as another one may be.
function nameAtFirst(field) {
  const { findLegalName, rename } = Blockly.Procedures;
  field.setValidator((name) => {
    field.setValidator(rename);
    return findLegalName(name.trim(), field.getSourceBlock());
  });
}

// Loads whether a return has a value from Blockly's XML, which is not parsed.
/** @this {any} */
function loadReturn(xml) {
  this.domToMutation({ getAttribute: () => (String(xml).includes('value="0"') ? "0" : "1") });
}

let units = WORKSHOP;

// Writes the units of this robot's commands on all blocks. workshop: as the cockpit describes the robot
export function setUnits(workspace, workshop) {
  units = workshop === false ? SI : WORKSHOP;
  const blocks = workspace.getAllBlocks(false);
  blocks.forEach(showUnits);
  for (const each of blocks) each.recomputeAriaContext();
}

function showUnits(block) {
  for (const name of ["X", "Z"]) block.getField(`UNIT_${name}`)?.setValue(units[name]);
}

const INPUTS = {
  number: (value) => ({ shadow: { type: "math_number", fields: { NUM: value } } }),
  string: (value) => ({ shadow: { type: "text", fields: { TEXT: value } } }),
  object: (input) => input,
};

// Returns the JSON of a block. inputs: numbers, texts, or inputs with blocks in them
export function block(type, inputs = {}, more = {}) {
  const filled = Object.entries(inputs).map(([name, value]) => [name, INPUTS[typeof value](value)]);
  return { kind: "block", type, inputs: Object.fromEntries(filled), ...more };
}

const category = (name, colour, ...blocks) => ({
  kind: "category", name, colour, contents: blocks.map((each) => block(...each)),
});
const dynamic = (name, colour, custom) => ({ kind: "category", name, colour, custom });

export const TOOLBOX = {
  kind: "categoryToolbox",
  contents: [
    category(t("Drive"), "#2f66c4", ...DRIVE.map(({ type, numbers }) => [type, numbers])),
    category(t("Sense"), "#0d7264", ...SENSE.map(({ type }) => [type])),
    category(t("Loops"), "#3c7a1f", ["robot_loop"], ["controls_repeat_ext", { TIMES: 4 }], ["controls_whileUntil"],
      ["controls_for", { FROM: 1, TO: 10, BY: 1 }], ["controls_flow_statements"]),
    category(t("Logic"), "#2a6a8a", ["controls_if"], ["controls_if", {}, { extraState: { hasElse: true } }],
      ["logic_compare"], ["logic_operation"], ["logic_negate"], ["logic_boolean"], ["logic_ternary"]),
    category(t("Maths"), "#4a55b5", ["math_number", {}, { fields: { NUM: 1 } }], ["math_arithmetic", { A: 1, B: 1 }],
      ["math_single", { NUM: 9 }], ["math_trig", { NUM: 45 }], ["math_constant"],
      ["math_number_property", { NUMBER_TO_CHECK: 2 }], ["math_round", { NUM: 3.1 }],
      ["math_modulo", { DIVIDEND: 64, DIVISOR: 10 }], ["math_constrain", { VALUE: 2, LOW: -1, HIGH: 1 }],
      ["math_random_int", { FROM: 1, TO: 6 }], ["math_random_float"]),
    category(t("Print"), "#6a4fb5", ["robot_print", { VALUE: t("hello") }],
      ["robot_plot", { NAME: "x", VALUE: 0 }], ["text"], ["text_join"]),
    dynamic(t("Variables"), "#a03060", "VARIABLE"),
    dynamic(t("Functions"), "#8a4a9a", "PROCEDURE"),
  ],
};
