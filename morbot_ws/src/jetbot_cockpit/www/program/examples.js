// Programs to begin with, one for each idea of the lessons.

import { t } from "../language.js";
import { block } from "./blocks.js";
import { withPython } from "./check.js";

const plug = (type, inputs, fields) => ({ block: block(type, inputs, { fields }) });
const set = (X, Z) => block("robot_set", { X, Z });
const wait = (SECONDS) => block("robot_wait", { SECONDS });
const drive = (X, SECONDS) => block("robot_drive", { X, SECONDS });
const turn = (SIDE, Z, SECONDS) => block("robot_turn", { Z, SECONDS }, { fields: { SIDE } });
const stop = block("robot_stop");
const stack = (/** @type {any[]} */ [first, ...others]) =>
  (others.length ? { ...first, next: { block: stack(others) } } : first);
const body = (...blocks) => ({ block: stack(blocks) });
const loop = (...blocks) => block("robot_loop", { DO: body(...blocks) });
const repeat = (TIMES, ...blocks) => block("controls_repeat_ext", { TIMES, DO: body(...blocks) });
const print = (VALUE) => block("robot_print", { VALUE });
const compare = (A, OP, B) => plug("logic_compare", { A, B }, { OP });
const get = (id) => plug("variables_get", {}, { VAR: { id } });
const assign = (id, VALUE) => block("variables_set", { VALUE }, { fields: { VAR: { id } } });
const leave = block("controls_flow_statements", {}, { fields: { FLOW: "BREAK" } });
const eye = (WHAT) => plug("robot_eye", {}, { WHAT });
const x = plug("robot_here", {}, { WHAT: "X" });

const program = (blocks, variables = [], others = []) => JSON.stringify({
  blocks: { languageVersion: 0, blocks: [stack([{ type: "robot_start", x: 30, y: 30 }, ...blocks]), ...others] },
  variables: variables.map((name) => ({ name, id: name })),
});

const call = block("procedures_callnoreturn", {}, { extraState: { name: "side" } });
const side = block("procedures_defnoreturn", { STACK: body(drive(0.5, 3.4), turn("LEFT", 0.147, 1.05)) },
  { x: 30, y: 230, fields: { NAME: "side" } });

// A program to begin with that is a text: the workshop's loop
export const NEW_PYTHON = withPython(`#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("my_program")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
motion = Twist()

motion.linear.x = 0.3
motion.angular.z = 0
while not rospy.is_shutdown():
    publisher.publish(motion)
    rate.sleep()
`);

export const EXAMPLES = {
  [t("One metre")]: program([drive(0.5, 3.33), stop]),
  [t("The workshop's loop")]: program([loop(set(0.5, 0.1))]),
  [t("x − z and x + z")]: program([
    block("robot_wheels", { LEFT: 0.4, RIGHT: 0.6 }), wait(2), set(0.5, 0.1), wait(2), stop,
  ]),
  [t("Zigzag")]: program([
    assign("z", 0.05),
    repeat(4, set(0.3, get("z")), wait(2),
      assign("z", plug("math_arithmetic", { A: get("z"), B: -1 }, { OP: "MULTIPLY" }))),
    stop,
  ], ["z"]),
  [t("A square, with a function")]: program([repeat(4, call), stop], [], [side]),
  [t("Drive until I am there")]: program([
    set(0.4, 0),
    block("controls_whileUntil", { BOOL: compare(x, "GTE", 0.96), DO: body(wait(0.1)) }, { fields: { MODE: "UNTIL" } }),
    stop, print(x),
  ]),
  [t("Follow the line")]: program([loop(block("controls_if", {
    IF0: compare(eye("LEFT"), "LT", 0.5), DO0: body(set(0.2, 0.1)),
    IF1: compare(eye("RIGHT"), "LT", 0.5), DO1: body(set(0.2, -0.1)),
    IF2: compare(eye("MIDDLE"), "GT", 0.9), DO2: body(leave),
    ELSE: body(set(0.3, 0)),
  }, { extraState: { elseIfCount: 2, hasElse: true } })), stop]),
};
