// Runs a program, the JSON in which Blockly saves blocks, statement by statement. It knows no page and no clock: run()
// is a generator that yields what is to be done, and goes on once that is done:
// { step }: the id of the block whose statement comes next; { wait }: seconds in which the robot drives `motion`;
// { tick }: the same until the next tenth of a second; { publish }: drive `motion` from now on; { print }: a text;
// { breathe }: nothing, it has computed for a while.

import { ProgramError } from "./program_error.js";
import { BLOCKS } from "./semantics.js";
import { plain, shown } from "./values.js";

const MAX_DEPTH = 1000; // blocks in blocks, functions that call functions
const BREATHE_AFTER = 50; // values that are evaluated
const TOO_DEEP = "Functions call functions too deep: one of them calls itself for ever.";

export class Interpreter {
  variables = new Map(); // by id
  locals = new Map(); // of the function that runs
  motion = [0, 0]; // x, z: in the units of the robot's commands
  depth = 0;
  evaluated = 0; // values

  // program: as Blockly.serialization saves it; geometry: { wheel_separation, max_speed } of the robot;
  // senses(): what the robot senses, as the rows of robot.js read it
  constructor(program, geometry, senses) {
    this.geometry = geometry;
    this.senses = senses;
    const tops = program.blocks?.blocks ?? [];
    this.start = tops.find(({ type }) => type === "robot_start");
    const functions = tops.filter(({ type }) => type.startsWith("procedures_def"));
    this.functions = new Map(functions.map((block) => [block.fields.NAME, block]));
  }

  *run() {
    try {
      yield* this.chain(this.start?.next?.block);
    } catch (error) {
      throw error instanceof RangeError ? new ProgramError(TOO_DEEP) : error; // the browser's own limit came first
    }
  }

  // Runs these statements, one after the other.
  *chain(first) {
    for (let block = first; block; block = block.next?.block) {
      if (block.disabledReasons) continue; // as Blockly's Python
      yield { step: block.id };
      yield* this.perform(block);
    }
  }

  body(block, name = "DO") {
    return this.chain(block.inputs?.[name]?.block);
  }

  // Runs the body of a loop once more.
  *round(block) {
    yield { step: block.id };
    yield* this.leaving("CONTINUE", this.body(block));
  }

  // Runs a part of the program that a block may leave: it throws { way }, which is returned here.
  *leaving(way, part) {
    const { depth } = this;
    try {
      yield* part;
    } catch (leave) {
      if (leave.way !== way) throw leave;
      this.depth = depth;
      return leave;
    }
  }

  *perform(block) {
    this.depth += 1;
    if (this.depth > MAX_DEPTH) throw new ProgramError(TOO_DEEP, block.id);
    const result = yield* BLOCKS[block.type](this, block);
    this.depth -= 1;
    return result;
  }

  *value(block, name, /** @type {any} */ fallback = 0) {
    const input = block.inputs?.[name];
    const inner = input?.block ?? input?.shadow;
    if (!inner) return fallback;
    this.evaluated += 1;
    if (this.evaluated % BREATHE_AFTER === 0) yield { breathe: true };
    return yield* this.perform(inner);
  }

  *number(block, name, fallback = 0) {
    const value = plain(yield* this.value(block, name, fallback));
    if (typeof value !== "number") throw new ProgramError(`Here a number is needed, not ${shown(value)}.`, block.id);
    return value;
  }

  *numbers(block, names) {
    const numbers = [];
    for (const name of names) numbers.push(yield* this.number(block, name));
    return numbers;
  }

  *truth(block, name, fallback = false) {
    return Boolean(yield* this.value(block, name, fallback));
  }

  get({ fields: { VAR: { id } } }) {
    return this.locals.has(id) ? this.locals.get(id) : this.variables.get(id) ?? 0;
  }

  set({ fields: { VAR: { id } } }, value) {
    (this.locals.has(id) ? this.locals : this.variables).set(id, value);
  }

  *call(block) {
    const called = this.functions.get(block.extraState?.name);
    if (!called) throw new ProgramError("This function is not defined.", block.id);
    const locals = new Map();
    for (const [index, { id }] of (called.extraState?.params ?? []).entries()) {
      locals.set(id, yield* this.value(block, `ARG${index}`));
    }
    const outer = this.locals;
    this.locals = locals;
    const left = yield* this.leaving("RETURN", this.body(called, "STACK"));
    const result = left ? left.result : yield* this.value(called, "RETURN", null);
    this.locals = outer;
    return result;
  }
}
