// What each block does: a generator of events, as interpreter.js explains them, that returns the block's value.
// run: the Interpreter; block: its JSON.

import { t } from "../language.js";
import { ProgramError } from "./program_error.js";
import { ROBOT } from "./robot.js";
import {
  comparable, COMPARISONS, CONSTANTS, constrain, modulo, notChangeable, notComparable, OPERATIONS, plain, PROPERTIES,
  randomInteger, shown, truth, whole,
} from "./values.js";

const MAX_TEXT = 10000; // characters
const TOO_LONG = t("A text has at most {most} characters.", { most: MAX_TEXT });

export const LOOPS = {
  *robot_loop(run, block) {
    for (;;) {
      yield* run.round(block);
      yield { tick: true };
    }
  },
  *controls_repeat_ext(run, block) {
    for (let left = whole(Math.trunc)(yield* run.number(block, "TIMES")); left > 0; left -= 1) yield* run.round(block);
  },
  *controls_whileUntil(run, block) {
    while ((yield* run.truth(block, "BOOL")) === (block.fields.MODE === "WHILE")) yield* run.round(block);
  },
  *controls_for(run, block) {
    const [from, to, by] = yield* run.numbers(block, { FROM: 0, TO: 0, BY: 1 });
    if (Number(by) === 0) throw new ProgramError(t("This loop counts by 0, and never arrives."));
    const sign = from <= to ? 1 : -1;
    for (let count = from; sign * count <= sign * to; count += sign * Math.abs(by)) {
      run.set(block, count);
      yield* run.round(block);
    }
  },
};

const STATEMENTS = {
  *controls_if(run, block) {
    for (let number = 0; number <= (block.extraState?.elseIfCount ?? 0); number += 1) {
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
    if (typeof before !== "number") throw new ProgramError(notChangeable(before));
    run.set(block, before + delta);
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
    return truth(first) === and ? yield* run.value(block, "B", neutral) : first;
  },
  *logic_compare(run, block) {
    const values = [yield* run.value(block, "A"), yield* run.value(block, "B")];
    const [a, b] = values.map(comparable);
    const { OP: operator } = block.fields;
    const ordered = typeof a === typeof b && a !== null || ["EQ", "NEQ"].includes(operator);
    if (!ordered) throw new ProgramError(notComparable(...values));
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
      if (text.length > MAX_TEXT) throw new ProgramError(TOO_LONG);
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

const operation = (...inputs) => [
  Object.fromEntries(inputs.map((name) => [name, 0])), ({ OP }, ...numbers) => OPERATIONS[OP](...numbers.map(Number)),
];
const CALCULATIONS = { // from numbers: the inputs that these come from, with what they are if empty, and how
  math_number: [{}, ({ NUM }) => Number(NUM)],
  math_constant: [{}, ({ CONSTANT }) => CONSTANTS[CONSTANT]],
  math_arithmetic: operation("A", "B"),
  math_single: operation("NUM"),
  math_trig: operation("NUM"),
  math_round: operation("NUM"),
  math_modulo: [{ DIVIDEND: 0, DIVISOR: 0 }, (_, a, b) => modulo(a, b)],
  math_constrain: [{ VALUE: 0, LOW: 0, HIGH: Infinity }, (_, ...numbers) => constrain(...numbers)],
  math_number_property: [{ NUMBER_TO_CHECK: 0, DIVISOR: 0 }, ({ PROPERTY }, a, b) => PROPERTIES[PROPERTY](a, b)],
  math_random_int: [{ FROM: 0, TO: 0 }, (_, one, other) => randomInteger(one, other)],
  math_random_float: [{}, () => Math.random()],
};

const toLoop = (rounds) => (run, block) => run.leaving("BREAK", rounds(run, block));

const toCalculation = ([inputs, calculate]) => function* calculation(run, block) {
  return calculate(block.fields, ...yield* run.numbers(block, inputs));
};

const toReading = ({ read, unknown }) => function* reading(run, block) {
  const value = read(block.fields ?? {}, run.senses()) ?? null;
  if (value === null) throw new ProgramError(unknown);
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
export const BLOCKS = {
  ...Object.fromEntries(ROBOT.map((row) => [row.type, row.read ? toReading(row) : toAction(row)])),
  ...STATEMENTS, ...VALUES, ...made(LOOPS, toLoop), ...made(CALCULATIONS, toCalculation),
};

// The types of blocks that this page runs.
export const TYPES = new Set([...Object.keys(BLOCKS), "procedures_defnoreturn", "procedures_defreturn"]);
