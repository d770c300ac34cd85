// Programs of blocks, as tests write them, and what the page does with them.

import { Clock } from "#www/program/clock.js";
import { Interpreter } from "#www/program/interpreter.js";

export const WORKSHOP = { wheel_separation: 2, max_speed: 1 };

const INPUTS = {
  number: (value) => ({ block: { type: "math_number", fields: { NUM: value } } }),
  string: (value) => ({ block: { type: "text", fields: { TEXT: value } } }),
  object: (value) => value,
};

// Returns a block. inputs: numbers, texts, or inputs with blocks in them
export function block(type, inputs = {}, more = {}) {
  const filled = Object.entries(inputs).map(([name, value]) => [name, INPUTS[typeof value](value)]);
  return { type, inputs: Object.fromEntries(filled), ...more };
}

export const plug = (type, inputs, fields) => ({ block: block(type, inputs, { fields }) });
export const body = (first, ...others) => ({ block: others.length ? { ...first, next: body(...others) } : first });
export const get = (id) => plug("variables_get", {}, { VAR: { id } });
export const set = (id, VALUE) => block("variables_set", { VALUE }, { fields: { VAR: { id } } });
export const print = (VALUE) => block("robot_print", { VALUE });
export const forever = (...blocks) => block("controls_whileUntil", {
  BOOL: plug("logic_boolean", {}, { BOOL: "TRUE" }), ...blocks.length && { DO: body(...blocks) },
}, { fields: { MODE: "WHILE" } });

// Returns a program of these statements. variables: their names, which are their ids
export function program(blocks, { functions = [], variables = [] } = {}) {
  return {
    blocks: { languageVersion: 0, blocks: [body({ type: "robot_start" }, ...blocks).block, ...functions] },
    variables: variables.map((name) => ({ name, id: name })),
  };
}

const DRIVES = ["wait", "tick", "publish"]; // events

// An interpreter that sees whether a value is larger than all whole numbers that the page knows exactly.
class Watched extends Interpreter {
  exact = true;

  *value(...parts) {
    const value = yield* super.value(...parts);
    if (Number.isFinite(value) && Math.abs(value) > Number.MAX_SAFE_INTEGER) this.exact = false;
    return value;
  }
}

// Runs a program without a robot, by a clock that its waits turn, for 10 s or so many events, while its numbers are
// exact. Returns what it prints, and [ms, x, z] of each command: in their order, and by themselves; whether it is cut
// short; whether its numbers are exact; why it failed, and at which block; and how many events it had.
export function interpret(json, senses = {}, most = 20000) {
  const done = { trace: [], cut: false, error: "", events: 0 };
  const clock = new Clock();
  stand(clock, 0);
  clock.begin();
  const interpreter = new Watched(json, WORKSHOP);
  try {
    for (const event of interpreter.run(() => ({ seconds: clock.seconds, senses }))) {
      if (!interpreter.exact) break;
      if ("print" in event) done.trace.push(event.print);
      if (DRIVES.some((name) => name in event)) done.trace.push(command(clock, interpreter));
      turn(clock, event);
      done.cut = (done.events += 1) > most || clock.now > 10000;
      if (done.cut) break;
    }
    interpreter.motion = [0, 0]; // as run.js ends
    if (!done.cut && interpreter.exact) done.trace.push(command(clock, interpreter));
  } catch (error) {
    Object.assign(done, { error: error.message, block: error.place });
  }
  const [prints, commands] = [false, true].map((are) => done.trace.filter((each) => Array.isArray(each) === are));
  return { ...done, exact: interpreter.exact, prints, commands };
}

const command = (clock, { motion }) => [Math.round(clock.now), ...motion.map(Number)];

function turn(clock, { wait, tick }) {
  if (tick) stand(clock, Math.max(clock.now, clock.nextTick()));
  if (wait) stand(clock, clock.afterWait(wait));
}

function stand(clock, now) {
  clock.stoodAt = Math.round(1000 * now) / 1000;
}
