// What a program does that runs in the page, beside what tests/unit/differential.py compares with its Python.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Interpreter } from "#www/program/interpreter.js";

import { block, body, forever, get, interpret, plug, print, program, set, WORKSHOP } from "./programs.js";

const call = (name) => ({ type: "procedures_callnoreturn", extraState: { name } });
const X = { fields: { VAR: { id: "x" } } };

const FAULTS = {
  "This function is not defined.": program([call("gone")]),
  "Here a number is needed, not the text “a”.": program([block("robot_set", { X: "a" })]),
  "Only a number can be changed, not the text “a”.": program([set("x", "a"), block("math_change", { DELTA: 1 }, X)]),
  "This robot does not report where it is.": program([print(plug("robot_here", {}, { WHAT: "X" }))]),
  "This robot does not report what its line sensor sees.": program([print(plug("robot_eye", {}, { WHAT: "LEFT" }))]),
  "This robot does not report its wheels.": program([print(plug("robot_wheel", {}, { WHAT: "LEFT" }))]),
  "A text has at most 10000 characters.": program([set("x", "abc"),
    forever(set("x", plug("text_join", { ADD0: get("x"), ADD1: get("x") })))]),
};

for (const [sentence, faulty] of Object.entries(FAULTS)) {
  test(`a program that cannot go on says: ${sentence}`, () => {
    assert.equal(interpret(faulty).error, sentence);
  });
}

test("more loops in each other than Python allows are refused before anything runs", () => {
  let inner = { ...print(1), id: "inner" };
  for (let loops = 21; loops > 0; loops -= 1) {
    inner = { ...block("controls_repeat_ext", { TIMES: 1, DO: body(inner) }), id: `loop ${loops}` };
  }
  const { prints, error, block: place } = interpret(program([print("begins"), inner]));
  assert.deepEqual([prints, error, place], [[], "Python allows 20 loops in each other, not more.", "loop 21"]);
});

test("a block drives, waits and stops, in this order", () => {
  const drive = { ...block("robot_drive", { X: 0.5, SECONDS: 2 }), id: "drive" };
  const interpreter = new Interpreter(program([drive, { type: "robot_stop", id: "stop" }]), WORKSHOP);
  const seen = [];
  for (const event of interpreter.run(() => ({}))) seen.push([event, interpreter.motion]);
  assert.deepEqual(seen, [
    [{ step: "drive" }, [0, 0]], [{ wait: 2 }, [0.5, 0]], [{ step: "stop" }, [0, 0]], [{ publish: true }, [0, 0]]]);
});

test("wheels are driven in the robot's own units", () => {
  const wheels = block("robot_wheels", { LEFT: 0.5, RIGHT: 1 });
  const interpreter = new Interpreter(program([wheels]), { wheel_separation: 0.1, max_speed: 0.4 });
  [...interpreter.run(() => ({}))];
  assert.deepEqual(interpreter.motion.map((each) => each.toFixed(6)), ["0.300000", "2.000000"]);
});

test("blocks that hang nowhere, or are disabled, do not run", () => {
  const loose = program([print("a"), { ...print("b"), disabledReasons: ["MANUALLY_DISABLED"] }, print("c")]);
  loose.blocks.blocks.push(print("d"));
  assert.deepEqual(interpret(loose).prints, ["a", "c"]);
  assert.deepEqual(interpret({}).trace, [[0, 0, 0]]);
});

test("a loop without a wait, and a long calculation, let the page have its turn", () => {
  assert.ok(interpret(program([forever()])).events > 20000);
  let value = plug("logic_boolean", {}, { BOOL: "TRUE" });
  for (let depth = 0; depth < 12; depth += 1) value = plug("logic_operation", { A: value, B: value }, { OP: "AND" });
  const events = [...new Interpreter(program([print(value)]), WORKSHOP).run(() => ({}))];
  assert.ok(events.filter(({ breathe }) => breathe).length > 100);
});

test("only a program with a block that asks the robot asks it", () => {
  const { needs } = new Interpreter(program([print(plug("robot_eye"))]), WORKSHOP);
  assert.deepEqual(needs, { senses: true, eyes: true });
  const asks = (type) => new Interpreter(program([print(plug(type))]), WORKSHOP).needs.senses;
  assert.deepEqual(["robot_here", "robot_wheel"].map(asks), [true, true]);
  assert.deepEqual(["robot_time", "robot_drive", "math_number"].map(asks), [false, false, false]);
});
