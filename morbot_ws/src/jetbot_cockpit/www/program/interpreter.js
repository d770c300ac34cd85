// Runs a program, the JSON in which Blockly saves blocks, statement by statement. It knows no page and no clock: run()
// is a generator that yields what is to be done, and goes on once that is done:
// { step }: the id of the block whose statement comes next; { wait }: seconds in which the robot drives `motion`;
// { tick }: the same until the next tenth of a second; { publish }: drive `motion` from now on; { print }: a text;
// { breathe }: nothing, it has computed for a while.

import { t } from "../language.js";
import { ProgramError } from "./program_error.js";
import { SENSE } from "./robot.js";
import { BLOCKS, LOOPS } from "./semantics.js";
import { notANumber, truth } from "./values.js";

const MAX_CALLS = 998; // functions that call functions; Python's
const MAX_LOOPS = 20; // in each other; Python's
const BREATHE_AFTER = 50; // values that are evaluated
const NOTHING = t("Nothing is below \"when the program starts\": drag blocks there.");
const ASKING = SENSE.filter(({ unknown }) => unknown).map(({ type }) => type);
const SENSORS = RegExp(`"type":"(${ASKING.join("|")})"`); // blocks that ask the robot
const EYES = /"type":"robot_eye"/;

export class Interpreter {
  repeats = true; // what drives is repeated while the program waits
  variables = new Map(); // by id
  locals = new Map(); // of the function that runs
  motion = [0, 0]; // x, z: in the units of the robot's commands
  running = []; // generators: the program, the function that it calls, the one that this one calls ...
  evaluated = 0; // values

  // program: as Blockly.serialization saves it; geometry: { wheel_separation, max_speed } of the robot
  constructor(program, geometry) {
    this.geometry = geometry;
    const text = JSON.stringify(program);
    this.needs = { senses: SENSORS.test(text), eyes: EYES.test(text) };
    const tops = program.blocks?.blocks ?? [];
    this.start = tops.find(({ type }) => type === "robot_start");
    const functions = tops.filter(({ type }) => type.startsWith("procedures_def"));
    this.functions = new Map(functions.map((block) => [block.fields.NAME, block]));
  }

  // Throws a ProgramError if there is nothing to run.
  prepare() {
    if (!this.start?.next) throw new ProgramError(NOTHING, this.start?.id);
  }

  end() {}

  // state(): { senses, seconds }: what the robot senses, and the program's clock, as the rows of robot.js read them.
  // A function's body does not run inside its caller's, but on top of it: a browser's own stack is not deep enough.
  *run(state) {
    this.senses = () => {
      const { senses, seconds } = state();
      return { ...senses, seconds };
    };
    for (const top of [this.start, ...this.functions.values()]) checkLoops(top);
    this.running = [this.chain(this.start?.next?.block)];
    let result;
    while (this.running.length) {
      const { value, done } = this.running.at(-1).next(result);
      result = done ? value : undefined;
      if (done) this.running.pop();
      else if ("call" in value) this.running.push(value.call);
      else yield value;
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
    try {
      yield* part;
    } catch (leave) {
      if (leave.way !== way) throw leave;
      return leave;
    }
  }

  *perform(block) {
    try {
      return yield* BLOCKS[block.type](this, block);
    } catch (error) {
      if (error instanceof ProgramError) error.place ??= block.id;
      throw error;
    }
  }

  *value(block, name, /** @type {any} */ fallback = 0) {
    const input = block.inputs?.[name];
    const inner = input?.block ?? input?.shadow;
    if (!inner) return fallback;
    this.evaluated += 1;
    if (this.evaluated % BREATHE_AFTER === 0) yield { breathe: true };
    return yield* this.perform(inner);
  }

  // Returns a number, or True or False, with which Python calculates too.
  *number(block, name, fallback = 0) {
    const value = yield* this.value(block, name, fallback);
    if (["number", "boolean"].includes(typeof value)) return value;
    throw new ProgramError(notANumber(value));
  }

  *numbers(block, inputs) {
    const numbers = [];
    for (const [name, fallback] of Object.entries(inputs)) numbers.push(yield* this.number(block, name, fallback));
    return numbers;
  }

  *truth(block, name, fallback = false) {
    return truth(yield* this.value(block, name, fallback));
  }

  get({ fields: { VAR: { id } } }) {
    const known = [this.locals, this.variables].find((each) => each.has(id));
    return known ? known.get(id) : 0;
  }

  set({ fields: { VAR: { id } } }, value) {
    (this.locals.has(id) ? this.locals : this.variables).set(id, value);
  }

  *call(block) {
    const called = this.functions.get(block.extraState?.name);
    if (!called) throw new ProgramError(t("This function is not defined."));
    const locals = new Map();
    for (const [index, { id }] of (called.extraState?.params ?? []).entries()) {
      locals.set(id, yield* this.value(block, `ARG${index}`));
    }
    if (this.running.length > MAX_CALLS) {
      throw new ProgramError(t("Functions call each other more than {most} deep. Does one call itself for ever?",
        { most: MAX_CALLS }));
    }
    const outer = this.locals;
    this.locals = locals;
    const result = yield { call: this.activation(called) };
    this.locals = outer;
    return result;
  }

  *activation(called) {
    const left = yield* this.leaving("RETURN", this.body(called, "STACK"));
    return left ? left.result : yield* this.value(called, "RETURN", null);
  }
}

// Throws if there are more loops in each other than Python allows.
function checkLoops(first, around = 0) {
  for (let block = first; block; block = block.next?.block) {
    const loops = around + Number(block.type in LOOPS);
    if (loops > MAX_LOOPS) {
      throw new ProgramError(t("Python allows {most} loops in each other, not more.", { most: MAX_LOOPS }), block.id);
    }
    for (const { block: inner } of Object.values(block.inputs ?? {})) checkLoops(inner, loops);
  }
}
