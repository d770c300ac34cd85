// Random programs of blocks, as the page saves them: with all blocks of the toolbox, also used as few people use them.

const SOUP = "!#$%()*+,-./:;=?@[]^_`{|}~AZaz09"; // of ids, as Blockly's
const NAMES = ["x", "i", "größe", "async", "await", "None", "print", "motion", "rospy", "main", "count", "math", "int",
  "drive", "سرعت", "👩‍👩‍👧‍👦", "a b", "1st", "class", "match", "self", "x2", "É", "is it?", "start", "random", "_"];
const TEXTS = ["", "a", "hello", "it's", 'say "x"', "سلام", "👩‍👩‍👧‍👦", "b\\n", "#@'1'", "7", "%s $& ${x}"];
const NUMBERS = [0, 1, 2, 3, 4, 5, 7, 10, -1, -2, -3, 0.5, 0.1, 2.5, -0.5, 1.5, 0.2, 0.3, 9, 45, 90, 570, 1000];
const POWERS = [0, 0.1, 0.2, 0.5, -0.3, 1, 0.25];
const SECONDS = [0, 0.1, 0.2, 0.25, 0.5, 1, -1, 0.05, 0.37];
const STEPS = [1, 1, 1, 2, 3, 0.5, -1, 0];
const SIDES = ["LEFT", "RIGHT"];
const EYES = ["LEFT", "MIDDLE", "RIGHT"];
const DEEPEST = 3; // values in values, and statements in statements
const MUTATION = (name, value) => `<mutation ${name}="${value}"></mutation>`;

// Returns draws from a stream of random numbers in [0, 1): Tommy Ettinger's Mulberry32
export function stream(seed) {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

// Each writes a value of its kind. in numbers: their weights
const KINDS = {
  number: {
    math_number: [6, (make) => make.block("math_number", { NUM: make.one(NUMBERS) })],
    variables_get: [6, (make) => make.get("number")],
    math_arithmetic: [4, (make) => make.block("math_arithmetic",
      { OP: make.one(["ADD", "MINUS", "MULTIPLY", "DIVIDE", "POWER"]) },
      { A: "number", B: make.one([NUMBERS, "number"]) })],
    math_single: [1, (make) => make.block("math_single",
      { OP: make.one(["ROOT", "ABS", "NEG", "LN", "LOG10", "EXP", "POW10"]) }, { NUM: "number" })],
    math_trig: [1, (make) => make.block("math_trig",
      { OP: make.one(["SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN"]) }, { NUM: "number" })],
    math_constant: [1, (make) => make.block("math_constant",
      { CONSTANT: make.one(["PI", "E", "GOLDEN_RATIO", "SQRT2", "SQRT1_2", "INFINITY"]) })],
    math_round: [2, (make) => make.block("math_round",
      { OP: make.one(["ROUND", "ROUNDUP", "ROUNDDOWN"]) }, { NUM: "number" })],
    math_modulo: [2, (make) => make.block("math_modulo", {},
      { DIVIDEND: "number", DIVISOR: make.one([STEPS, "number"]) })],
    math_constrain: [2, (make) => make.block("math_constrain", {}, { VALUE: "number", LOW: "number", HIGH: "number" })],
    math_random_int: [2, (make) => make.block("math_random_int", {}, { FROM: "number", TO: "number" })],
    math_random_float: [1, (make) => make.block("math_random_float")],
    robot_here: [0.5, (make) => make.block("robot_here", { WHAT: make.one(["X", "Y", "HEADING"]) })],
    robot_eye: [0.5, (make) => make.block("robot_eye", { WHAT: make.one(EYES) })],
    robot_wheel: [0.5, (make) => make.block("robot_wheel", { WHAT: make.one(SIDES) })],
    robot_time: [1, (make) => make.block("robot_time")],
    logic_ternary: [1, (make) => make.ternary("number")],
    procedures_callreturn: [3, (make) => make.value("call")],
  },
  truth: {
    logic_boolean: [2, (make) => make.block("logic_boolean", { BOOL: make.one(["TRUE", "FALSE"]) })],
    logic_compare: [6, (make) => make.compare()],
    logic_operation: [2, (make) => make.block("logic_operation",
      { OP: make.one(["AND", "OR"]) }, { A: "truth", B: "truth" })],
    logic_negate: [2, (make) => make.block("logic_negate", {}, { BOOL: "truth" })],
    math_number_property: [3, (make) => make.property()],
    variables_get: [1, (make) => make.get("truth")],
    logic_ternary: [0.5, (make) => make.ternary("truth")],
  },
  text: {
    text: [3, (make) => make.block("text", { TEXT: make.one(TEXTS) })],
    text_join: [2, (make) => make.join()],
    variables_get: [1, (make) => make.get("text")],
  },
  call: {
    procedures_callreturn: [1, (make) => make.call(true) ?? make.get("number")],
  },
  any: {
    number: [8, (make) => make.value("number")],
    truth: [3, (make) => make.value("truth")],
    text: [3, (make) => make.value("text")],
  },
};

const LEAVES = ["math_number", "variables_get", "logic_boolean", "text"];

const STATEMENTS = {
  robot_set: [2, (make) => make.block("robot_set", {}, { X: POWERS, Z: make.one([POWERS, POWERS, "call"]) })],
  robot_wheels: [1, (make) => make.block("robot_wheels", {}, { LEFT: POWERS, RIGHT: POWERS })],
  robot_drive: [2, (make) => make.block("robot_drive", {}, { X: POWERS, SECONDS })],
  robot_turn: [1, (make) => make.block("robot_turn", { SIDE: make.one(SIDES) }, { Z: POWERS, SECONDS })],
  robot_stop: [1, (make) => make.block("robot_stop")],
  robot_wait: [2, (make) => make.block("robot_wait", {}, { SECONDS })],
  robot_print: [5, (make) => make.block("robot_print", {}, { VALUE: "any" })],
  robot_plot: [1, (make) => make.block("robot_plot", {}, { NAME: "any", VALUE: "any" })],
  variables_set: [4, (make) => make.set()],
  math_change: [2, (make) => make.block("math_change", { VAR: make.variable("number") }, { DELTA: "number" })],
  controls_if: [3, (make) => make.branches()],
  controls_repeat_ext: [2, (make) => make.loop("controls_repeat_ext", {}, { TIMES: [0, 1, 2, 3, 4, 2.5, -1] })],
  controls_whileUntil: [1, (make) => make.loop("controls_whileUntil",
    { MODE: make.one(["WHILE", "UNTIL"]) }, { BOOL: "truth" })],
  controls_for: [2, (make) => make.loop("controls_for",
    { VAR: make.variable("number") }, { FROM: "number", TO: "number", BY: make.one([STEPS, "number"]) })],
  robot_loop: [0.5, (make) => make.loop("robot_loop", {}, {})],
  procedures_callnoreturn: [3, (make) => make.call(false) ?? make.block("robot_stop")],
  procedures_ifreturn: [1, (make) => make.ifReturn()],
  controls_flow_statements: [1, (make) => make.leave()],
};

class Maker {
  depth = 0; // of values
  nesting = 0; // of statements
  loops = 0; // around a statement
  inside = null; // the function that is made
  last = 0;

  constructor(seed) {
    this.random = stream(seed);
    const names = this.shuffled(NAMES);
    const take = () => ({ name: names.pop(), id: this.id() });
    this.variables = Array.from({ length: this.up(5) }, take);
    this.kinds = this.variables.map(() => this.one(["number", "number", "number", "truth", "text"]));
    this.functions = Array.from({ length: this.up(4) - 1 }, () => ({
      name: names.pop(), returns: this.chance(0.5), params: this.shuffled(this.variables).slice(0, this.up(3) - 1),
    }));
  }

  one(options) {
    return options[Math.floor(this.random() * options.length)];
  }

  // Returns a number from 1 to this one.
  up(to) {
    return 1 + Math.floor(this.random() * to);
  }

  chance(part) {
    return this.random() < part;
  }

  shuffled(all) {
    return all.map((each) => [this.random(), each]).sort(([one], [other]) => one - other).map(([, each]) => each);
  }

  id() {
    return `${this.last += 1}${this.one(SOUP)}${this.one(SOUP)}`;
  }

  // Draws one of { type: [weight, write] }, and writes it.
  draw(rows) {
    let left = this.random() * Object.values(rows).reduce((sum, [weight]) => sum + weight, 0);
    for (const [weight, write] of Object.values(rows)) {
      left -= weight;
      if (left < 0) return write(this);
    }
    return this.draw(rows);
  }

  value(kind) {
    const all = Object.entries(KINDS[kind]);
    const leaves = all.filter(([type]) => LEAVES.includes(type));
    this.depth += 1;
    const made = this.draw(Object.fromEntries(this.depth > DEEPEST && leaves.length ? leaves : all));
    this.depth -= 1;
    return made;
  }

  // inputs: kinds of values, or the numbers among which a shadow has one
  block(type, fields = {}, inputs = {}, extraState = null) {
    const made = { type, id: this.id() };
    if (extraState) made.extraState = extraState;
    if (Object.keys(fields).length) made.fields = fields;
    const filled = Object.entries(inputs).map(([name, kind]) => [name, this.input(kind)]).filter(([, input]) => input);
    if (filled.length) made.inputs = Object.fromEntries(filled);
    return made;
  }

  // Returns an input: empty, or with a value, above a shadow or not.
  input(kind) {
    if (typeof kind === "object" && !Array.isArray(kind)) return kind;
    if (this.chance(0.04)) return null;
    const numbers = Array.isArray(kind) ? kind : NUMBERS;
    const shadowed = Array.isArray(kind) || kind === "number" && this.chance(0.5);
    const shadow = shadowed && { shadow: { type: "math_number", id: this.id(), fields: { NUM: this.one(numbers) } } };
    if (shadow && this.chance(Array.isArray(kind) ? 0.75 : 0.3)) return shadow;
    return { ...shadow, block: this.value(Array.isArray(kind) ? "number" : kind) };
  }

  variable(kind) {
    const fitting = this.variables.filter((_, index) => this.kinds[index] === kind);
    return { id: this.one(fitting.length && this.chance(0.97) ? fitting : this.variables).id };
  }

  get(kind) {
    return this.block("variables_get", { VAR: this.variable(kind) });
  }

  set() {
    const kind = this.one(this.kinds);
    return this.block("variables_set", { VAR: this.variable(kind) }, { VALUE: kind });
  }

  ternary(kind) {
    const empty = this.chance(0.2);
    return this.block("logic_ternary", {}, { IF: "truth", ...!empty && { THEN: kind }, ELSE: kind });
  }

  compare() {
    const kind = this.one(["number", "number", "number", "truth", "text"]);
    const operators = ["EQ", "NEQ", "LT", "LTE", "GT", "GTE"];
    return this.block("logic_compare", { OP: this.one(operators) }, { A: kind, B: kind });
  }

  property() {
    const PROPERTY = this.one(["EVEN", "ODD", "PRIME", "WHOLE", "POSITIVE", "NEGATIVE", "DIVISIBLE_BY"]);
    const divisible = PROPERTY === "DIVISIBLE_BY";
    return this.block("math_number_property", { PROPERTY },
      { NUMBER_TO_CHECK: "number", ...divisible && { DIVISOR: "number" } }, MUTATION("divisor_input", divisible));
  }

  join() {
    const itemCount = this.up(4) - 1;
    const inputs = Array.from({ length: itemCount }, (_, number) => [`ADD${number}`, "any"]);
    return this.block("text_join", {}, Object.fromEntries(inputs), { itemCount });
  }

  // Returns a call of a function, or null: one that calls itself is rare.
  call(returns) {
    const fitting = this.functions.filter((each) => each.returns === returns);
    const later = fitting.filter((each) => this.functions.indexOf(each) > this.functions.indexOf(this.inside));
    const called = this.one(this.chance(0.05) ? fitting : later);
    if (!called) return null;
    const names = called.params.map(({ name }) => name);
    const inputs = called.params.map((_, number) => [`ARG${number}`, "number"]);
    return this.block(returns ? "procedures_callreturn" : "procedures_callnoreturn", {}, Object.fromEntries(inputs),
      { name: called.name, ...names.length && { params: names } });
  }

  branches() {
    const [elseIfCount, hasElse] = [this.chance(0.4) ? this.up(3) : 0, this.chance(0.4)];
    const inputs = {};
    for (let number = 0; number <= elseIfCount; number += 1) {
      if (this.chance(0.2)) continue; // an empty branch
      inputs[`IF${number}`] = "truth";
      inputs[`DO${number}`] = this.body();
    }
    if (hasElse) inputs.ELSE = this.body();
    const state = { ...elseIfCount && { elseIfCount }, ...hasElse && { hasElse } };
    return this.block("controls_if", {}, inputs, elseIfCount || hasElse ? state : null);
  }

  loop(type, fields, inputs) {
    this.loops += 1;
    const DO = this.body();
    this.loops -= 1;
    return this.block(type, fields, { ...inputs, DO });
  }

  leave() {
    if (!this.loops) return this.block("robot_stop");
    const leave = this.block("controls_flow_statements", { FLOW: this.one(["BREAK", "CONTINUE"]) });
    const DO0 = { block: leave };
    return this.block("controls_if", {}, { IF0: "truth", DO0 });
  }

  ifReturn() {
    if (!this.inside) return this.block("robot_print", {}, { VALUE: "text" });
    const { returns } = this.inside;
    return this.block("procedures_ifreturn", {}, { CONDITION: "truth", ...returns && { VALUE: "number" } },
      MUTATION("value", Number(returns)));
  }

  // Returns an input with statements, or none.
  body() {
    this.nesting += 1;
    const length = this.nesting > DEEPEST || this.chance(0.15) ? 0 : this.up(3);
    const statements = this.statements(length);
    this.nesting -= 1;
    return statements;
  }

  statements(length) {
    if (length < 1) return null;
    const block = this.draw(STATEMENTS);
    const next = this.statements(length - 1);
    return { block: next ? { ...block, next } : block };
  }

  definition(called, index) {
    this.inside = called;
    const { name, returns, params } = called;
    const hasStatements = !returns || this.chance(0.8);
    const state = { ...params.length && { params: params.map((each) => ({ ...each })) },
      ...!hasStatements && { hasStatements } };
    const inputs = {
      ...hasStatements && { STACK: this.statements(this.up(4)) },
      ...returns && this.chance(0.85) && { RETURN: "number" },
    };
    const { type, id, ...more } = this.block(returns ? "procedures_defreturn" : "procedures_defnoreturn",
      { NAME: name }, inputs, Object.keys(state).length ? state : null);
    this.inside = null;
    return { type, id, x: 400, y: 30 + 200 * index, ...more };
  }

  // Returns statements that set most of the variables.
  beginning() {
    return this.variables.filter(() => this.chance(0.8)).map(({ id }) => this.block("variables_set", { VAR: { id } },
      { VALUE: this.kinds[this.variables.findIndex((each) => each.id === id)] }));
  }

  program() {
    const next = this.beginning().reduceRight((below, each) => ({ block: { ...each, ...below && { next: below } } }),
      this.statements(this.up(9)));
    const start = { type: "robot_start", id: this.id(), x: 30, y: 30, next };
    const loose = this.chance(0.1) ? [{ type: "robot_stop", id: this.id(), x: 700, y: 30 }] : [];
    const definitions = this.functions.map((each, index) => this.definition(each, index));
    return { blocks: { languageVersion: 0, blocks: [start, ...definitions, ...loose] }, variables: this.variables };
  }
}

// Returns the JSON of a program, always the same one for a seed.
export function randomProgram(seed) {
  return new Maker(seed).program();
}
