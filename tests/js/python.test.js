// The Python that the page writes of a program.

import assert from "node:assert/strict";
import { test } from "node:test";

import { write } from "./blockly.js";
import { block, print, program, set } from "./programs.js";

test("each block's line is known, so that the page can mark it", () => {
  const { text, lines } = write(program([
    { ...block("robot_set", { X: 0.5, Z: 0.1 }), id: "set" }, { ...print("done"), id: "print" }]));
  const line = (id) => text.split("\n")[lines.get(id)].trim();
  assert.deepEqual(["set", "print"].map(line), ["motion.linear.x = 0.5", "print('done')"]);
  assert.doesNotMatch(text, /#@/);
});

test("only the helpers and imports that a program needs are written", () => {
  const { text } = write(program([block("robot_wait", { SECONDS: 1 })]));
  assert.match(text, /def wait/);
  assert.doesNotMatch(text, /def drive|import math|nav_msgs/);
});

test("a variable has the name that the person gave it, in any language, as far as Python takes it", () => {
  const names = ["größe", "何か", "is it?", "1st", "ﬁ", "👩‍👩", "x in %"];
  const { text } = write(program(names.map((name) => set(name, 1)), { variables: names }));
  assert.match(text, /global größe, 何か, is_it_, my_1st, fi, ___, x_in_\w+\n/);
});

test("wheels are set in the robot's own units", () => {
  const wheels = program([block("robot_wheels", { LEFT: 0.5, RIGHT: 0.5 })]);
  assert.match(write(wheels).text, /\(right - left\) \/ 2\n/);
  assert.match(write(wheels, { wheel_separation: 0.1125, max_speed: 0.6 }).text, /\(right - left\) \/ 0.1125 \* 0.6\n/);
});

const USED = [
  "rospy", "Twist", "motion", "publisher", "rate", "main", "math", "Pose2D", "Odometry", "Float32MultiArray", "wait",
  "drive", "stop", "set_wheels", "seconds", "beginning", "here", "origin", "on_odom", "eyes", "on_line", "wheels",
  "on_wheels",
];

test("a variable may have the name of what a node uses", () => {
  const { text } = write(program(USED.map((name) => set(name, 1)), { variables: USED }));
  for (const name of USED) assert.match(text, RegExp(`^ {4}${name}2 = 1$`, "m"));
});

test("no text and no name begins a line of its own", () => {
  const evil = "a\rimport os\x0cos.x()\x85os.y()\u2028b\nc";
  const { text } = write(program([set(evil, 1), print(evil)], { variables: [evil] }));
  assert.doesNotMatch(text, /^\s*(import os|os\.)/m);
  assert.ok(["\r", "\x0c", "\x85"].every((end) => !text.includes(end)));
});
