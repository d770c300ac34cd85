// Writes the program as a node of the workshop's kind. Blockly's own generator writes what is not the robot's.

import { HELPERS, NAMES } from "./helpers.js";
import { ROBOT } from "./robot.js";

const { Blockly } = globalThis;
const python = Blockly.Python;
const { Order } = globalThis.python;

const INDENT = "    ";
const MARK = "#@%1\n"; // a line of its own before a block's first line, with the block's id
const MARKED = /^\s*#@'(.*)'$/s;
const ENDS = /[^\n\x20-\x7e\u00a0-\u{10ffff}]/gu; // other ends of lines, and control characters

// What is no name for a person's variables and functions
const OWN = ["__builtins__", "async", "await", "rospy", "Twist", "motion", "publisher", "rate", "main"];

let needed = new Set(); // of HELPERS

const code = (block, name, order, empty = "0") => python.valueToCode(block, name, order) || empty;

const isWhole = (written) => /^-?\d+$/.test(written);
const body = (block) => python.statementToCode(block, "DO") || python.PASS;
const variable = (block) => python.getVariableName(block.getFieldValue("VAR"));

// Some of Blockly's blocks, as this page runs them
const ADAPTED = {
  controls_flow_statements(block) {
    const flow = block.getFieldValue("FLOW").toLowerCase();
    const ticks = flow === "continue" && block.getSurroundLoop()?.type === "robot_loop";
    return `${ticks ? "publisher.publish(motion)\nrate.sleep()\n" : ""}${flow}\n`;
  },
  controls_for(block, generator) { // Blockly's reads a variable again after it has called a function
    const [from, to, by] = [["FROM"], ["TO"], ["BY", "1"]].map(([name, empty]) => code(block, name, Order.NONE, empty));
    if ([from, to, by].every(isWhole)) return BLOCKLY.controls_for(block, generator);
    needed.add("counting");
    return `for ${variable(block)} in counting(${from}, ${to}, ${by}):\n${body(block)}`;
  },
  controls_repeat_ext(block) { // Blockly's reads 1e-7 as 1
    const [times, name] = [code(block, "TIMES", Order.NONE), python.nameDB_.getDistinctName("count", "VARIABLE")];
    return `for ${name} in range(${isWhole(times) ? times : `int(${times})`}):\n${body(block)}`;
  },
  math_arithmetic(block, generator) {
    if (block.getFieldValue("OP") !== "POWER") return BLOCKLY.math_arithmetic(block, generator);
    python.definitions_.import_math = "import math"; // ** makes complex numbers
    return [`math.pow(${code(block, "A", Order.NONE)}, ${code(block, "B", Order.NONE)})`, Order.FUNCTION_CALL];
  },
  math_change(block) {
    return `${variable(block)} = ${variable(block)} + ${code(block, "DELTA", Order.ADDITIVE)}\n`;
  },
  math_number_property(block, generator) { // Blockly's is False for a divisor that is written as 0
    if (block.getFieldValue("PROPERTY") !== "DIVISIBLE_BY") return BLOCKLY.math_number_property(block, generator);
    const [number, divisor] = ["NUMBER_TO_CHECK", "DIVISOR"].map((name) => code(block, name, Order.MULTIPLICATIVE));
    return [`${number} % ${divisor} == 0`, Order.RELATIONAL];
  },
  math_random_int(block) { // random.randint takes whole numbers alone, the smaller one first
    const [from, to] = ["FROM", "TO"].map((name) => code(block, name, Order.NONE));
    const plain = isWhole(from) && isWhole(to) && Number(from) <= Number(to);
    if (plain) python.definitions_.import_random = "import random";
    else needed.add("random_integer");
    return [`${plain ? "random.randint" : "random_integer"}(${from}, ${to})`, Order.FUNCTION_CALL];
  },
  procedures_callreturn(block) {
    const given = block.getVarModels().map((_, number) => code(block, `ARG${number}`, Order.NONE));
    return [`${python.getProcedureName(block.getFieldValue("NAME"))}(${given.join(", ")})`, Order.FUNCTION_CALL];
  },
};
const BLOCKLY = { ...python.forBlock };

const READ = {
  input_value: (block, { name, check }) => code(block, name, Order.NONE, check ? "0" : '""'),
  input_statement: (block, { name }) => python.statementToCode(block, name),
  field_dropdown: (block, { name }) => block.getFieldValue(name),
};

// Returns what writes the Python of a row of robot.js.
const writer = ({ python: write, args0 = [], needs = [], output }) => (block) => {
  for (const name of needs) needed.add(name);
  const parts = args0.filter(({ type }) => type in READ).map((part) => [part.name, READ[part.type](block, part)]);
  const written = write(Object.fromEntries(parts));
  return output ? [written, Order.FUNCTION_CALL] : written && `${written}\n`;
};

// Prepares Blockly's generator, once.
export function prepareGenerator() {
  Object.assign(python.forBlock, ADAPTED, Object.fromEntries(ROBOT.map((row) => [row.type, writer(row)])));
  Object.assign(python, { INDENT, STATEMENT_PREFIX: MARK, addLoopTrap: (body) => body }); // no marks in loops
  Blockly.Names.prototype.safeName = safeName;
  python.addReservedWords([...OWN, ...NAMES].join(","));
}

// Returns a name as Python reads it, in any language; Blockly's has ASCII alone.
function safeName(name) {
  const safe = name.normalize("NFKC").replace(/\P{XID_Continue}|[\u200c\u200d]/gu, "_"); // some browsers' has these two
  return /^[\p{XID_Start}_]/u.test(safe) ? safe : `my_${safe}`;
}

// Returns { text, lines }: the node of this name, and the numbers of the lines by their blocks' ids, from 0.
// geometry: { wheel_separation, max_speed } of the robot
export function toPython(workspace, name, geometry) {
  needed = new Set();
  python.init(workspace);
  const tops = workspace.getTopBlocks(true);
  for (const top of tops) if (top.type.startsWith("procedures_def")) python.blockToCode(top);
  const start = tops.find(({ type }) => type === "robot_start");
  const program = start ? python.blockToCode(start) : "";
  const { variables, ...definitions } = python.definitions_;
  python.finish("");
  return separate(assemble(name, program, variables, Object.values(definitions), geometry).replace(ENDS, ""));
}

function assemble(name, program, variables, definitions, geometry) {
  const helpers = Object.keys(HELPERS).filter((key) => needed.has(key)).map((key) => HELPERS[key]);
  const imports = [...definitions.filter(isImport), ...helpers.flatMap((each) => each.imports ?? [])];
  const names = variables.match(/^\S+/gm);
  const main = [...names ? [`global ${names.join(", ")}`] : [],
    "while publisher.get_num_connections() == 0:", `${INDENT}rate.sleep()`,
    ...helpers.flatMap(({ start }) => start ?? []), program + "publisher.publish(Twist())", "rate.sleep()"];
  const functions = [...helpers.map((each) => adapt(each.code, geometry)),
    ...definitions.filter((each) => !isImport(each)).map((each) => each.trim()),
    `def main():\n${python.prefixLines(main.join("\n"), INDENT)}`];
  return `#!/usr/bin/env python3
${sorted([...imports, "import rospy", "from geometry_msgs.msg import Twist"]).join("\n")}

rospy.init_node("${name}")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
motion = Twist()
${variables && `${variables.replace(/None$/gm, "0")}\n`}

${functions.join("\n\n\n")}


try:
    main()
except rospy.ROSInterruptException:
    pass
`;
}

function isImport(line) {
  return /^(import|from) /.test(line);
}

// Returns each import once, Python's own first.
function sorted(imports) {
  const rank = (line) => (/_msgs|rospy/.test(line) ? "2" : "1") + (line.startsWith("from") ? "b" : "a") + line;
  return [...new Set(imports)].sort((one, other) => (rank(one) < rank(other) ? -1 : 1));
}

function adapt(helper, { wheel_separation: separation, max_speed: speed }) {
  return helper.replaceAll("%speed", speed === 1 ? "" : ` * ${speed}`).replace("%separation", String(separation));
}

// Takes the marks out.
function separate(marked) {
  const text = [], lines = new Map();
  for (const line of marked.split("\n")) {
    const [, id] = MARKED.exec(line) ?? [];
    if (id === undefined) text.push(line);
    else if (!lines.has(id)) lines.set(id, text.length);
  }
  return { text: text.join("\n"), lines };
}
