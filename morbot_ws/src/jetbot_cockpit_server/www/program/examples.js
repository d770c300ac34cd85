// Programs to begin with, one for each idea of the lessons.

import { num } from "./blocks.js";

const plug = (type, fields = {}, inputs = {}, more = {}) => ({ block: { type, fields, inputs, ...more } });
const set = (x, z) => ({ type: "robot_set", inputs: { X: num(x), Z: num(z) } });
const wait = (seconds) => ({ type: "robot_wait", inputs: { SECONDS: num(seconds) } });
const drive = (x, seconds) => ({ type: "robot_drive", inputs: { X: num(x), SECONDS: num(seconds) } });
const turn = (side, z, seconds) => ({
  type: "robot_turn", fields: { SIDE: side }, inputs: { Z: num(z), SECONDS: num(seconds) },
});
const stop = { type: "robot_stop" };
const stack = ([first, ...others]) => (others.length ? { ...first, next: { block: stack(others) } } : first);
const body = (...blocks) => ({ block: stack(blocks) });
const loop = (...blocks) => ({ type: "robot_loop", inputs: { DO: body(...blocks) } });
const repeat = (times, ...blocks) => ({
  type: "controls_repeat_ext", inputs: { TIMES: num(times), DO: body(...blocks) },
});
const print = (value) => ({ type: "robot_print", inputs: { VALUE: value } });
const compare = (left, operator, right) => plug("logic_compare", { OP: operator }, { A: left, B: right });
const variable = (id) => ({ VAR: { id } });
const get = (id) => plug("variables_get", variable(id));
const assign = (id, value) => ({ type: "variables_set", fields: variable(id), inputs: { VALUE: value } });
const leave = { type: "controls_flow_statements", fields: { FLOW: "BREAK" } };
const eye = (side) => plug("robot_eye", { WHAT: side });

const program = (blocks, variables = [], others = []) => JSON.stringify({
  blocks: { languageVersion: 0, blocks: [stack([{ type: "robot_start", x: 30, y: 30 }, ...blocks]), ...others] },
  variables: variables.map((name) => ({ name, id: name })),
});

const call = { type: "procedures_callnoreturn", extraState: { name: "side" } };
const side = {
  type: "procedures_defnoreturn", x: 30, y: 230, fields: { NAME: "side" },
  inputs: { STACK: body(drive(0.5, 3.4), turn("LEFT", 0.147, 1.05)) },
};

export const EMPTY = program([]);

export const EXAMPLES = {
  "One metre": program([drive(0.5, 3.33), stop]),
  "The workshop's loop": program([loop(set(0.5, 0.1))]),
  "x − z and x + z": program([
    { type: "robot_wheels", inputs: { LEFT: num(0.4), RIGHT: num(0.6) } }, wait(2), set(0.5, 0.1), wait(2), stop,
  ]),
  Zigzag: program([
    assign("z", num(0.05)),
    repeat(4, { type: "robot_set", inputs: { X: num(0.3), Z: get("z") } }, wait(2),
      assign("z", plug("math_arithmetic", { OP: "MULTIPLY" }, { A: get("z"), B: num(-1) }))),
    stop,
  ], ["z"]),
  "A square, with a function": program([repeat(4, call), stop], [], [side]),
  "Drive until I am there": program([
    set(0.4, 0),
    {
      type: "controls_whileUntil", fields: { MODE: "UNTIL" },
      inputs: { BOOL: compare(plug("robot_here", { WHAT: "X" }), "GTE", num(0.96)), DO: body(wait(0.1)) },
    },
    stop, print(plug("robot_here", { WHAT: "X" })),
  ]),
  "Follow the line": program([loop({
    type: "controls_if", extraState: { elseIfCount: 2, hasElse: true },
    inputs: {
      IF0: compare(eye("LEFT"), "LT", num(0.5)), DO0: body(set(0.2, 0.1)),
      IF1: compare(eye("RIGHT"), "LT", num(0.5)), DO1: body(set(0.2, -0.1)),
      IF2: compare(eye("MIDDLE"), "GT", num(0.9)), DO2: body(leave),
      ELSE: body(set(0.3, 0)),
    },
  }), stop]),
};
