// The robot's blocks, and the toolbox. Blockly is a script of the page, not a module.

const { Blockly } = globalThis;

const WORKSHOP = { X: "power", Z: "power" };
const SI = { X: "m/s", Z: "rad/s" };
const HELP = "x is forward, z to the left. In the workshop's units, 1 is full power: left = x − z, right = x + z.";

// Takes a number as a person types it: 0,7 is 0.7, while Blockly drops the comma, and makes it 7.
class NumberField extends Blockly.FieldNumber {
  doClassValidation_(value) {
    return super.doClassValidation_(typeof value === "string" ? value.replaceAll(",", ".") : value);
  }

  widgetCreate_() {
    return Object.assign(super.widgetCreate_(), { inputMode: "decimal" });
  }

  showPromptEditor() {
    super.showPromptEditor();
    document.querySelector(".blocklyDialogInput").inputMode = "decimal";
  }
}

const statement = { previousStatement: null, nextStatement: null };
const number = (name) => ({ type: "input_value", name, check: "Number" });
const unit = (name) => ({ type: "field_label", name: `UNIT_${name}`, text: "" });
const choice = (name, ...options) => ({ type: "field_dropdown", name, options });

const DRIVE = [
  {
    type: "robot_set", message0: "set x %1 %2 z %3 %4", args0: [number("X"), unit("X"), number("Z"), unit("Z")],
    tooltip: `${HELP} The robot obeys while the program waits.`,
  },
  {
    type: "robot_wheels", message0: "set left wheel %1 power right wheel %2 power",
    args0: [number("LEFT"), number("RIGHT")],
    tooltip: "1 is full power forward, −1 backward. The robot obeys while the program waits.",
  },
  {
    type: "robot_drive", message0: "drive straight at x %1 %2 for %3 s",
    args0: [number("X"), unit("X"), number("SECONDS")],
    tooltip: "Drives forward, or backward if x is below 0, for so many seconds.",
  },
  {
    type: "robot_turn", message0: "turn %1 at z %2 %3 for %4 s",
    args0: [choice("SIDE", ["left", "LEFT"], ["right", "RIGHT"]), number("Z"), unit("Z"), number("SECONDS")],
    tooltip: "Turns on the spot for so many seconds.",
  },
  { type: "robot_stop", message0: "stop", tooltip: "Stops the robot at once." },
  {
    type: "robot_wait", message0: "wait %1 s", args0: [number("SECONDS")],
    tooltip: "Repeats what was set, ten times per second, for so many seconds.",
  },
].map((block) => ({ ...block, ...statement, colour: "#2f66c4", extensions: ["units"], inputsInline: true }));

const SENSE = [
  {
    type: "robot_here", message0: "%1 from the start",
    args0: [choice("WHAT", ["x in m", "X"], ["y in m", "Y"], ["heading in degrees", "HEADING"])],
    tooltip: "Where the robot is, seen from where the program started: x ahead, y and heading to the left.",
  },
  {
    type: "robot_eye", message0: "%1 eye, 0 on a line",
    args0: [choice("WHAT", ["left", "LEFT"], ["middle", "MIDDLE"], ["right", "RIGHT"])],
    tooltip: "An eye of the line sensor: 0 on a dark line, 1 beside it.",
  },
  {
    type: "robot_wheel", message0: "%1 wheel in power", args0: [choice("WHAT", ["left", "LEFT"], ["right", "RIGHT"])],
    tooltip: "What the wheel gets: 1 is full power forward.",
  },
  { type: "robot_time", message0: "time in s", tooltip: "Seconds since the program started." },
].map((block) => ({ ...block, output: "Number", colour: "#0d7264" }));

const OTHERS = [
  {
    type: "robot_start", message0: "when the program starts", nextStatement: null, colour: "#7a5200",
    tooltip: "The blocks below run, one after the other. Blocks that hang nowhere do not.",
  },
  {
    type: "robot_loop", message0: "repeat at 10 Hz %1 %2",
    args0: [{ type: "input_dummy" }, { type: "input_statement", name: "DO" }], ...statement,
    colour: "#3c7a1f", tooltip: "Does this ten times per second, and repeats the command each time.",
  },
  {
    type: "robot_print", message0: "print %1", args0: [{ type: "input_value", name: "VALUE" }], ...statement,
    colour: "#6a4fb5", tooltip: "Shows a number or a text.",
  },
  { // Blockly's own has pictures of quotes, which the page's Content-Security-Policy forbids
    type: "text", message0: "“%1”", args0: [{ type: "field_input", name: "TEXT", text: "" }], output: "String",
    colour: "#6a4fb5", tooltip: "A text.",
  },
];

// Defines the blocks, once.
export function defineBlocks() {
  Blockly.Extensions.register("units", function label() {
    showUnits(this);
  });
  Blockly.fieldRegistry.unregister("field_number");
  Blockly.fieldRegistry.register("field_number", NumberField);
  delete Blockly.Blocks.text;
  Blockly.common.defineBlocksWithJsonArray([...DRIVE, ...SENSE, ...OTHERS]);
  Blockly.libraryBlocks?.loops?.loopTypes.add("robot_loop");
}

let units = WORKSHOP;

// Writes the units of this robot's commands on all blocks. workshop: as the cockpit describes the robot
export function setUnits(workspace, workshop) {
  units = workshop === false ? SI : WORKSHOP;
  workspace.getAllBlocks(false).forEach(showUnits);
}

function showUnits(block) {
  for (const name of ["X", "Z"]) block.getField(`UNIT_${name}`)?.setValue(units[name]);
}

const shadow = (type, fields) => ({ shadow: { type, fields } });
const num = (value) => shadow("math_number", { NUM: value });
const block = (type, inputs = {}, more = {}) => ({ kind: "block", type, inputs, ...more });
const plain = (...types) => types.map((type) => block(type));
const category = (name, colour, contents, more = {}) => ({ kind: "category", name, colour, contents, ...more });

export const TOOLBOX = {
  kind: "categoryToolbox",
  contents: [
    category("Drive", "#2f66c4", [
      block("robot_set", { X: num(0.5), Z: num(0.1) }),
      block("robot_wheels", { LEFT: num(0.4), RIGHT: num(0.6) }),
      block("robot_drive", { X: num(0.5), SECONDS: num(1) }),
      block("robot_turn", { Z: num(0.2), SECONDS: num(1) }),
      block("robot_stop"),
      block("robot_wait", { SECONDS: num(1) }),
    ]),
    category("Sense", "#0d7264", plain("robot_here", "robot_eye", "robot_wheel", "robot_time")),
    category("Loops", "#3c7a1f", [
      block("robot_loop"),
      block("controls_repeat_ext", { TIMES: num(4) }),
      block("controls_whileUntil"),
      block("controls_for", { FROM: num(1), TO: num(10), BY: num(1) }),
      block("controls_flow_statements"),
    ]),
    category("Logic", "#2a6a8a", [
      block("controls_if"),
      block("controls_if", {}, { extraState: { hasElse: true } }),
      ...plain("logic_compare", "logic_operation", "logic_negate", "logic_boolean", "logic_ternary"),
    ]),
    category("Maths", "#4a55b5", [
      block("math_number", {}, { fields: { NUM: 1 } }),
      block("math_arithmetic", { A: num(1), B: num(1) }),
      block("math_single", { NUM: num(9) }),
      block("math_trig", { NUM: num(45) }),
      block("math_constant"),
      block("math_number_property", { NUMBER_TO_CHECK: num(2) }),
      block("math_round", { NUM: num(3.1) }),
      block("math_modulo", { DIVIDEND: num(64), DIVISOR: num(10) }),
      block("math_constrain", { VALUE: num(2), LOW: num(-1), HIGH: num(1) }),
      block("math_random_int", { FROM: num(1), TO: num(6) }),
      block("math_random_float"),
    ]),
    category("Print", "#6a4fb5", [
      block("robot_print", { VALUE: shadow("text", { TEXT: "hello" }) }), block("text"), block("text_join"),
    ]),
    category("Variables", "#a03060", undefined, { custom: "VARIABLE" }),
    category("Functions", "#8a4a9a", undefined, { custom: "PROCEDURE" }),
  ],
};
