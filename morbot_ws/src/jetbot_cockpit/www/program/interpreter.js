// Runs a program, the JSON in which Blockly saves blocks, statement by statement. It knows no page and no clock: run()
// is a generator that yields what is to be done, and goes on once that is done:
// { step }: the id of the block whose statement comes next; { wait }: seconds in which the robot drives `motion`;
// { tick }: the same until the next tenth of a second; { publish }: drive `motion` from now on; { print }: a text;
// { breathe }: nothing, it has computed for a while.

import { ROBOT } from "./robot.js";
import { COMPARISONS, CONSTANTS, modulo, OPERATIONS, plain, PROPERTIES, shown } from "./values.js";

const MAX_DEPTH = 1000; // blocks in blocks, functions that call functions
const MAX_TEXT = 10000; // characters
const BREATHE_AFTER = 50; // values that are evaluated
const TOO_DEEP = "Functions call functions too deep: one of them calls itself for ever.";

// What went wrong, in a sentence for the person; block: the id of where.
export class ProgramError extends Error {
  constructor(sentence, block) {
    super(sentence);
    this.block = block;
  }
}

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

const LOOPS = {
  *robot_loop(run, block) {
    for (;;) {
      yield* run.round(block);
      yield { tick: true };
    }
  },
  *controls_repeat_ext(run, block) {
    for (let left = Math.trunc(yield* run.number(block, "TIMES")); left > 0; left -= 1) yield* run.round(block);
  },
  *controls_whileUntil(run, block) {
    while ((yield* run.truth(block, "BOOL")) === (block.fields.MODE === "WHILE")) yield* run.round(block);
  },
  *controls_for(run, block) {
    const [from, to, by] = [...yield* run.numbers(block, ["FROM", "TO"]), yield* run.number(block, "BY", 1)];
    const step = Math.abs(by) * (from <= to ? 1 : -1);
    if (step === 0) throw new ProgramError("This loop counts by 0, and never arrives.", block.id);
    for (let count = from; step > 0 ? count <= to : count >= to; count += step) {
      run.set(block, count);
      yield* run.round(block);
    }
  },
};

const STATEMENTS = {
  *controls_if(run, block) {
    for (let number = 0; block.inputs?.[`IF${number}`] || block.inputs?.[`DO${number}`]; number += 1) {
      if (yield* run.truth(block, `IF${number}`)) return yield* run.body(block, `DO${number}`);
    }
    yield* run.body(block, "ELSE");
  },
  *controls_flow_statements(_, block) {
    throw { way: block.fields.FLOW };
  },
  *variables_set(run, block) {
    run.set(block, yield* run.value(block, "VALUE"));
  },
  *math_change(run, block) {
    const [before, delta] = [plain(run.get(block)), yield* run.number(block, "DELTA")];
    if (typeof before !== "number") throw new ProgramError(`${shown(before)} is no number to change.`, block.id);
    run.set(block, finite(before + delta, block));
  },
  *procedures_callnoreturn(run, block) {
    yield* run.call(block);
  },
  *procedures_ifreturn(run, block) {
    if (yield* run.truth(block, "CONDITION")) throw { way: "RETURN", result: yield* run.value(block, "VALUE", null) };
  },
};

const VALUES = {
  *logic_boolean(_, block) {
    return block.fields.BOOL === "TRUE";
  },
  *logic_negate(run, block) {
    return !(yield* run.truth(block, "BOOL", true));
  },
  *logic_operation(run, block) { // returns one of both, as Python does; an empty one has no effect
    const and = block.fields.OP === "AND";
    const neutral = and && Boolean(block.inputs?.A ?? block.inputs?.B);
    const first = yield* run.value(block, "A", neutral);
    return Boolean(first) === and ? yield* run.value(block, "B", neutral) : first;
  },
  *logic_compare(run, block) {
    const [a, b] = [plain(yield* run.value(block, "A")), plain(yield* run.value(block, "B"))];
    const { OP: operator } = block.fields;
    const comparable = typeof a === typeof b && a !== null || ["EQ", "NEQ"].includes(operator);
    if (!comparable) throw new ProgramError(`${shown(a)} and ${shown(b)} cannot be compared.`, block.id);
    return COMPARISONS[operator](a, b);
  },
  *logic_ternary(run, block) {
    return yield* run.value(block, (yield* run.truth(block, "IF")) ? "THEN" : "ELSE", null);
  },
  *text(_, block) {
    return String(block.fields.TEXT);
  },
  *text_join(run, block) {
    let text = "";
    for (let number = 0; number < (block.extraState?.itemCount ?? 2); number += 1) {
      text += shown(yield* run.value(block, `ADD${number}`, ""));
      if (text.length > MAX_TEXT) throw new ProgramError(`A text has at most ${MAX_TEXT} characters.`, block.id);
    }
    return text;
  },
  *variables_get(run, block) {
    return run.get(block);
  },
  *procedures_callreturn(run, block) {
    return yield* run.call(block);
  },
};

const operation = (...inputs) => [inputs, ({ OP }, ...numbers) => OPERATIONS[OP](...numbers)];
const CALCULATIONS = { // from numbers: the inputs that these come from, and how
  math_number: [[], ({ NUM }) => Number(NUM)],
  math_constant: [[], ({ CONSTANT }) => CONSTANTS[CONSTANT]],
  math_arithmetic: operation("A", "B"),
  math_single: operation("NUM"),
  math_trig: operation("NUM"),
  math_round: operation("NUM"),
  math_modulo: [["DIVIDEND", "DIVISOR"], (_, a, b) => modulo(a, b)],
  math_constrain: [["VALUE", "LOW", "HIGH"], (_, value, low, high) => Math.min(Math.max(value, low), high)],
  math_number_property: [["NUMBER_TO_CHECK", "DIVISOR"], ({ PROPERTY }, a, b) => PROPERTIES[PROPERTY](a, b)],
  math_random_int: [["FROM", "TO"], (_, low, high) => Math.floor(low + Math.random() * (high - low + 1))],
  math_random_float: [[], () => Math.random()],
};

const toLoop = (rounds) => (run, block) => run.leaving("BREAK", rounds(run, block));

const toCalculation = ([inputs, calculate]) => function* calculation(run, block) {
  return finite(calculate(block.fields, ...yield* run.numbers(block, inputs)), block);
};

const toReading = ({ read, unknown }) => function* reading(run, block) {
  const value = read(block.fields ?? {}, run.senses()) ?? null;
  if (value === null) throw new ProgramError(`This robot does not report ${unknown}.`, block.id);
  return value;
};

const toAction = ({ does, args0 = [] }) => function* action(run, block) {
  const given = { ...block.fields };
  for (const { type, name, check } of args0) {
    if (type === "input_value") given[name] = yield* check ? run.number(block, name) : run.value(block, name, "");
  }
  for (const event of does(given, run.geometry)) {
    if (event.motion) run.motion = event.motion;
    else yield event;
  }
};

const made = (rows, make) => Object.fromEntries(Object.entries(rows).map(([type, row]) => [type, make(row)]));
const BLOCKS = {
  ...Object.fromEntries(ROBOT.map((row) => [row.type, row.read ? toReading(row) : toAction(row)])),
  ...STATEMENTS, ...VALUES, ...made(LOOPS, toLoop), ...made(CALCULATIONS, toCalculation),
};

// The types of blocks that this page runs.
export const TYPES = new Set([...Object.keys(BLOCKS), "procedures_defnoreturn", "procedures_defreturn"]);

function finite(result, block) {
  if (typeof result === "boolean" || Number.isFinite(result)) return result;
  throw new ProgramError("This calculation has no result.", block.id);
}
