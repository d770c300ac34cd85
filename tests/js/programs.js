// Programs of blocks, as tests write them, and what the page does with them.

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

// Runs a program without a robot, by a clock that its waits turn. Returns what it prints; [time, x, z] of each command,
// in tenths of a second; why it failed; and how many events it had.
export function interpret(json, senses = {}) {
  const done = { prints: [], commands: [], error: "", events: 0 };
  const clock = { now: 0, ticked: 0 };
  const interpreter = new Interpreter(json, WORKSHOP, () => ({ seconds: clock.now / 10, ...senses }));
  try {
    for (const event of interpreter.run()) {
      if ((done.events += 1) > 20000 || clock.now > 100) break;
      if ("print" in event) done.prints.push(event.print);
      if (!("wait" in event || "tick" in event || "publish" in event)) continue;
      done.commands.push([Math.round(clock.now), ...interpreter.motion]);
      turn(clock, event);
    }
  } catch (error) {
    Object.assign(done, { error: error.message, block: error.block });
  }
  return done;
}

function turn(clock, { wait, tick }) {
  if (wait > 0) clock.now += 10 * wait;
  if (!tick) return;
  const { now, ticked } = clock;
  Object.assign(clock, { now: Math.max(now, ticked + 1), ticked: now - ticked > 3 ? now : ticked + 1 });
}
