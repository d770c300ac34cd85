// Runs a program, the JSON in which Blockly saves blocks, statement by statement. It knows no page and no clock: run()
// is a generator that yields what is to be done, and goes on once that is done:
// { step }: the id of the block whose statement comes next; { wait }: seconds in which the robot drives `motion`;
// { tick }: the same until the next tenth of a second; { publish }: drive `motion` from now on; { print }: a text;
// { breathe }: nothing, it has computed for a while.

const MAX_DEPTH = 1000; // blocks in blocks, functions that call functions
const MAX_TEXT = 10000; // characters
const MAX_PRIME = 1e10; // what is larger takes too long
const BREATHE_AFTER = 50; // values that are evaluated
const TOO_DEEP = "Functions call functions too deep: one of them calls itself for ever.";
const [BREAK, CONTINUE] = ["BREAK", "CONTINUE"];

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
  // read(kind, part): what the robot senses, a number, or null if that is not known
  constructor(program, geometry, read) {
    Object.assign(this, { geometry, read });
    const tops = program.blocks?.blocks ?? [];
    this.start = tops.find(({ type }) => type === "robot_start");
    const functions = tops.filter(({ type }) => type.startsWith("procedures_def"));
    this.functions = new Map(functions.map((block) => [block.fields.NAME, block]));
  }

  *run() {
    if (this.start?.next) yield* this.chain(this.start.next.block);
  }

  // Runs these statements, one after the other; returns BREAK, CONTINUE, { result } of a function, or undefined.
  *chain(first) {
    this.enter(first);
    for (let block = first; block; block = block.next?.block) {
      yield { step: block.id };
      const statement = STATEMENTS[block.type];
      if (!statement) throw new ProgramError(`This page cannot run ${block.type}.`, block.id);
      const done = yield* statement(this, block);
      if (done) return this.leave(done);
    }
    return this.leave();
  }

  *body(block, name = "DO") {
    const first = block.inputs?.[name]?.block;
    return first ? yield* this.chain(first) : undefined;
  }

  // Runs the body once more; returns { done } if the loop ends with it.
  *round(block) {
    yield { step: block.id };
    const done = yield* this.body(block);
    return done && done !== CONTINUE ? { done: done === BREAK ? undefined : done } : null;
  }

  *value(block, name, fallback = 0) {
    const input = block.inputs?.[name];
    const inner = input?.block ?? input?.shadow;
    if (!inner) return fallback;
    this.enter(inner);
    this.evaluated += 1;
    if (this.evaluated % BREATHE_AFTER === 0) yield { breathe: true };
    const evaluate = VALUES[inner.type];
    if (!evaluate) throw new ProgramError(`This page cannot run ${inner.type}.`, inner.id);
    return this.leave(yield* evaluate(this, inner));
  }

  *number(block, name, fallback = 0) {
    const value = yield* this.value(block, name, fallback);
    if (typeof value !== "number") throw new ProgramError(`Here a number is needed, not ${shown(value)}.`, block.id);
    return value;
  }

  *truth(block, name) {
    const value = yield* this.value(block, name, false);
    return Boolean(value);
  }

  enter(block) {
    this.depth += 1;
    if (this.depth > MAX_DEPTH) throw new ProgramError(TOO_DEEP, block.id);
  }

  leave(value) {
    this.depth -= 1;
    return value;
  }

  get(id) {
    return this.locals.has(id) ? this.locals.get(id) : this.variables.get(id) ?? 0;
  }

  set(id, value) {
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
    const done = yield* this.body(called, "STACK");
    const result = done?.result ?? (yield* this.value(called, "RETURN", 0));
    this.locals = outer;
    return result;
  }
}

const UNKNOWN = { here: "where it is", eye: "what its line sensor sees", wheel: "its wheels", time: "the time" };

const STATEMENTS = {
  *robot_set(run, block) {
    run.motion = [yield* run.number(block, "X"), yield* run.number(block, "Z")];
  },
  *robot_wheels(run, block) {
    const [left, right] = [yield* run.number(block, "LEFT"), yield* run.number(block, "RIGHT")];
    const { wheel_separation: separation, max_speed: speed } = run.geometry;
    run.motion = [(left + right) / 2 * speed, (right - left) / separation * speed];
  },
  *robot_drive(run, block) {
    yield* drive(run, [yield* run.number(block, "X"), 0], yield* run.number(block, "SECONDS"));
  },
  *robot_turn(run, block) {
    const z = yield* run.number(block, "Z");
    yield* drive(run, [0, block.fields.SIDE === "RIGHT" ? -z : z], yield* run.number(block, "SECONDS"));
  },
  *robot_stop(run) {
    run.motion = [0, 0];
    yield { publish: true };
  },
  *robot_wait(run, block) {
    yield { wait: yield* run.number(block, "SECONDS") };
  },
  *robot_loop(run, block) {
    for (;;) {
      const last = yield* run.round(block);
      if (last) return last.done;
      yield { tick: true };
    }
  },
  *robot_print(run, block) {
    yield { print: shown(yield* run.value(block, "VALUE", "")) };
  },
  *controls_if(run, block) {
    for (let number = 0; block.inputs?.[`IF${number}`] || block.inputs?.[`DO${number}`]; number += 1) {
      if (yield* run.truth(block, `IF${number}`)) return yield* run.body(block, `DO${number}`);
    }
    return yield* run.body(block, "ELSE");
  },
  *controls_repeat_ext(run, block) {
    for (let left = Math.trunc(yield* run.number(block, "TIMES")); left > 0; left -= 1) {
      const last = yield* run.round(block);
      if (last) return last.done;
    }
  },
  *controls_whileUntil(run, block) {
    while ((yield* run.truth(block, "BOOL")) === (block.fields.MODE === "WHILE")) {
      const last = yield* run.round(block);
      if (last) return last.done;
    }
  },
  *controls_for(run, block) {
    const [from, to] = [yield* run.number(block, "FROM"), yield* run.number(block, "TO")];
    const step = Math.abs(yield* run.number(block, "BY", 1)) * (from <= to ? 1 : -1);
    if (step === 0) throw new ProgramError("This loop counts by 0, and never arrives.", block.id);
    for (let count = from; step > 0 ? count <= to : count >= to; count += step) {
      run.set(block.fields.VAR.id, count);
      const last = yield* run.round(block);
      if (last) return last.done;
    }
  },
  *controls_flow_statements(run, block) {
    return block.fields.FLOW;
  },
  *variables_set(run, block) {
    run.set(block.fields.VAR.id, yield* run.value(block, "VALUE"));
  },
  *math_change(run, block) {
    const { id } = block.fields.VAR;
    const [before, delta] = [run.get(id), yield* run.number(block, "DELTA")];
    if (typeof before !== "number") throw new ProgramError(`${shown(before)} is no number to change.`, block.id);
    run.set(id, finite(before + delta, block));
  },
  *procedures_callnoreturn(run, block) {
    yield* run.call(block);
  },
  *procedures_ifreturn(run, block) {
    if (yield* run.truth(block, "CONDITION")) return { result: yield* run.value(block, "VALUE") };
  },
};

function* drive(run, motion, seconds) {
  run.motion = motion;
  yield { wait: seconds };
  run.motion = [0, 0];
}

const degrees = (radians) => radians * 180 / Math.PI;
const radians = (angle) => angle * Math.PI / 180;
const modulo = (a, b) => a - b * Math.floor(a / b); // as in Python
const OPERATIONS = {
  ADD: (a, b) => a + b, MINUS: (a, b) => a - b, MULTIPLY: (a, b) => a * b, DIVIDE: (a, b) => a / b,
  POWER: (a, b) => a ** b,
  ROOT: Math.sqrt, ABS: Math.abs, NEG: (a) => -a, LN: Math.log, LOG10: Math.log10, EXP: Math.exp, POW10: (a) => 10 ** a,
  SIN: (a) => Math.sin(radians(a)), COS: (a) => Math.cos(radians(a)), TAN: (a) => Math.tan(radians(a)),
  ASIN: (a) => degrees(Math.asin(a)), ACOS: (a) => degrees(Math.acos(a)), ATAN: (a) => degrees(Math.atan(a)),
  ROUND: roundToEven, ROUNDUP: Math.ceil, ROUNDDOWN: Math.floor,
};
const CONSTANTS = {
  PI: Math.PI, E: Math.E, GOLDEN_RATIO: (1 + Math.sqrt(5)) / 2, SQRT2: Math.SQRT2, SQRT1_2: Math.SQRT1_2,
  INFINITY: Infinity,
};
const PROPERTIES = {
  EVEN: (a) => modulo(a, 2) === 0, ODD: (a) => modulo(a, 2) === 1, WHOLE: (a) => modulo(a, 1) === 0, PRIME: isPrime,
  POSITIVE: (a) => a > 0, NEGATIVE: (a) => a < 0, DIVISIBLE_BY: (a, b) => (b ? modulo(a, b) === 0 : NaN),
};
const ORDERS = { LT: (a, b) => a < b, LTE: (a, b) => a <= b, GT: (a, b) => a > b, GTE: (a, b) => a >= b };

const operation = (...inputs) => [inputs, ({ OP }, ...numbers) => OPERATIONS[OP](...numbers)];
const CALCULATED = { // from numbers: the inputs that these come from, and how
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
const SENSED = { robot_here: "here", robot_eye: "eye", robot_wheel: "wheel", robot_time: "time" };

function* calculate(run, block) {
  const [inputs, calculation] = CALCULATED[block.type];
  const numbers = [];
  for (const input of inputs) numbers.push(yield* run.number(block, input));
  return finite(calculation(block.fields, ...numbers), block);
}

function* sense(run, block) {
  const [kind, part] = [SENSED[block.type], block.fields?.WHAT];
  const value = run.read(kind, part);
  if (value === null) throw new ProgramError(`This robot does not report ${UNKNOWN[kind]}.`, block.id);
  return value;
}

const same = (types, evaluate) => Object.fromEntries(Object.keys(types).map((type) => [type, evaluate]));

const VALUES = {
  ...same(CALCULATED, calculate), ...same(SENSED, sense),
  *logic_boolean(run, block) {
    return block.fields.BOOL === "TRUE";
  },
  *logic_negate(run, block) {
    return !(yield* run.truth(block, "BOOL"));
  },
  *logic_operation(run, block) {
    const first = yield* run.truth(block, "A");
    return first === (block.fields.OP === "AND") ? yield* run.truth(block, "B") : first;
  },
  *logic_compare(run, block) {
    const [a, b] = [yield* run.value(block, "A"), yield* run.value(block, "B")];
    const { OP: operator } = block.fields;
    if (operator === "EQ" || operator === "NEQ") return (a === b) === (operator === "EQ");
    if (typeof a !== typeof b) throw new ProgramError(`${shown(a)} and ${shown(b)} cannot be compared.`, block.id);
    return ORDERS[operator](a, b);
  },
  *logic_ternary(run, block) {
    return yield* run.value(block, (yield* run.truth(block, "IF")) ? "THEN" : "ELSE");
  },
  *text(run, block) {
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
    return run.get(block.fields.VAR.id);
  },
  *procedures_callreturn(run, block) {
    return yield* run.call(block);
  },
};

// The types of blocks that this page runs.
export const TYPES = new Set([...Object.keys(STATEMENTS), ...Object.keys(VALUES), "robot_start",
  "procedures_defnoreturn", "procedures_defreturn"]);

function finite(result, block) {
  if (typeof result !== "boolean" && !Number.isFinite(result)) throw new ProgramError("This calculation has no result.", block.id);
  return result;
}

function roundToEven(number) {
  return Math.abs(number % 1) === 0.5 ? 2 * Math.round(number / 2) : Math.round(number);
}

function isPrime(number) {
  if (number > MAX_PRIME) return NaN;
  for (let divisor = 2; divisor * divisor <= number; divisor += 1) if (number % divisor === 0) return false;
  return number > 1 && number % 1 === 0;
}

// Returns a value as it is printed.
export function shown(value) {
  if (typeof value === "boolean") return value ? "True" : "False";
  return typeof value === "number" ? String(Number(value.toPrecision(Math.abs(value) < 1e5 ? 6 : 15))) : value;
}
