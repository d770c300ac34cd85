// Random programs of blocks, as the page saves them: of all blocks that Blockly has there, also used as few people do.

import "./blockly.js";
import { stream } from "./stream.js";

const { TYPES } = await import("#www/program/semantics.js");
const { Blockly } = globalThis;

const SOUP = "!#$%()*+,-./:;=?@[]^_`{|}~AZaz09"; // of ids, as Blockly's
const NAMES = ["x", "i", "größe", "async", "await", "None", "print", "motion", "rospy", "main", "count", "math", "int",
  "drive", "سرعت", "👩‍👩‍👧‍👦", "a b", "1st", "class", "match", "self", "x2", "É", "is it?", "start", "random", "_"];
const TEXTS = ["", "a", "hello", "it's", 'say "x"', "سلام", "👩‍👩‍👧‍👦", "b\\n", "#@'1'", "7", "%s $& ${x}"];
const NUMBERS = [0, 1, 2, 3, 4, 5, 7, 10, -1, -2, -3, 0.5, 0.1, 2.5, -0.5, 1.5, 0.2, 0.3, 9, 45, 90, 570, 1000];
const POWERS = [0, 0.1, 0.2, 0.5, -0.3, 1, 0.25];
const SECONDS = [0, 0.1, 0.2, 0.25, 0.5, 1, -1, 0.05, 0.37];
const STEPS = [1, 1, 1, 2, 3, 0.5, -1, 0];
const DEEPEST = 3; // values in values, and statements in statements
const OF_INPUTS = { // numbers, by the name of an input
  X: POWERS, Z: POWERS, LEFT: POWERS, RIGHT: POWERS, SECONDS, BY: STEPS, DIVISOR: STEPS,
  TIMES: [0, 1, 2, 3, 4, 2.5, -1],
};
const OFTEN = { // how often a block is drawn, beside one that is not here
  math_number: 6, variables_get: 6, logic_compare: 6, robot_print: 5, math_arithmetic: 4, variables_set: 4, text: 4,
  math_number_property: 3, procedures_callreturn: 3, procedures_callnoreturn: 3, controls_if: 3, logic_operation: 2,
  logic_negate: 2, logic_boolean: 2, text_join: 2, robot_set: 2, robot_drive: 2, robot_wait: 2, math_change: 2,
  controls_repeat_ext: 2, controls_for: 2, robot_loop: 0.5, robot_here: 0.5, robot_eye: 0.5, robot_wheel: 0.5,
};
const MUTATION = (name, value) => `<mutation ${name}="${value}"></mutation>`;


const known = new Map(); // by a block's type and state

// Returns what Blockly says of a block: the kind of its value, if it has one, its choices and its inputs.
function define(type, extraState = null) {
  const key = JSON.stringify([type, extraState]);
  if (!known.has(key)) known.set(key, read(type, extraState));
  return known.get(key);
}

function read(type, extraState) {
  const block = Blockly.serialization.blocks.append({ type, ...extraState && { extraState } }, new Blockly.Workspace());
  const kindOf = (connection) => connection.getCheck()?.[0] ?? "any";
  const dropdowns = [...block.getFields()].filter((field) => field instanceof Blockly.FieldDropdown
    && !(field instanceof Blockly.FieldVariable));
  const choices = dropdowns.map((field) => [field.name, field.getOptions().map(([, value]) => value)]);
  const inputs = block.inputList.filter(({ connection }) => connection).map(({ name, type: of, connection }) => (
    { name, isBody: of === Blockly.inputs.inputTypes.STATEMENT, kind: kindOf(connection) }));
  return { type, choices, inputs, kind: block.outputConnection && kindOf(block.outputConnection),
    follows: Boolean(block.previousConnection), goesOn: Boolean(block.nextConnection) };
}

const DEFINED = [...TYPES].map((type) => define(type));
const VALUES = DEFINED.filter(({ kind }) => kind);
const LEAVES = VALUES.filter(({ inputs, type }) => !inputs.length && !type.startsWith("procedures"));
const STATEMENTS = DEFINED.filter(({ follows }) => follows);

// What Blockly's definition leaves open, of a block whose value is to be of this kind: its fields, its state, the kinds
// of its inputs, or its inputs themselves if its state is XML; or null: there is no such block here.
const OPEN = {
  math_number: (make) => ({ fields: { NUM: make.one(NUMBERS) } }),
  text: (make) => ({ fields: { TEXT: make.one(TEXTS) } }),
  variables_get: (make, kind) => ({ fields: { VAR: make.variable(kind) } }),
  variables_set(make) {
    const VALUE = make.one(make.kinds);
    return { fields: { VAR: make.variable(VALUE) }, kinds: { VALUE } };
  },
  math_change: (make) => ({ fields: { VAR: make.variable("Number") } }),
  controls_for: (make) => ({ fields: { VAR: make.variable("Number") } }),
  logic_compare(make) {
    const kind = make.one(["Number", "Number", "Number", "Boolean", "String"]);
    return { kinds: { A: kind, B: kind } };
  },
  logic_ternary: (_, kind) => ({ kinds: { THEN: kind, ELSE: kind } }),
  math_number_property(make) {
    const PROPERTY = make.one(["EVEN", "ODD", "PRIME", "WHOLE", "POSITIVE", "NEGATIVE", "DIVISIBLE_BY"]);
    const inputs = ["NUMBER_TO_CHECK", ...PROPERTY === "DIVISIBLE_BY" ? ["DIVISOR"] : []];
    return { fields: { PROPERTY }, inputs: inputs.map((name) => ({ name, kind: "Number" })),
      extraState: MUTATION("divisor_input", inputs.length > 1) };
  },
  text_join: (make) => ({ extraState: { itemCount: make.up(4) - 1 } }),
  controls_if(make) {
    const [elseIfCount, hasElse] = [make.chance(0.4) ? make.up(3) : 0, make.chance(0.4)];
    const extraState = { ...elseIfCount && { elseIfCount }, ...hasElse && { hasElse } };
    return elseIfCount || hasElse ? { extraState } : {};
  },
  procedures_callreturn: (make, kind) => (kind === "Number" ? make.call(true) : null),
  procedures_callnoreturn: (make) => make.call(false),
  procedures_ifreturn: ({ inside }) => inside && { extraState: MUTATION("value", Number(inside.returns)),
    inputs: [{ name: "CONDITION", kind: "Boolean" }, ...inside.returns ? [{ name: "VALUE", kind: "Number" }] : []] },
  controls_flow_statements: ({ loops }) => (loops ? {} : null),
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
    this.kinds = this.variables.map(() => this.one(["Number", "Number", "Number", "Boolean", "String"]));
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

  // Draws one of the definitions that can be used here; returns its block.
  draw(defined, kind = null) {
    let left = this.random() * defined.reduce((sum, { type }) => sum + (OFTEN[type] ?? 1), 0);
    const { type } = defined.find((each) => (left -= OFTEN[each.type] ?? 1) < 0) ?? defined[0];
    const open = OPEN[type] ? OPEN[type](this, kind) : {};
    return open ? this.block(type, open) : this.draw(defined, kind);
  }

  value(wanted) {
    const kind = wanted === "any" ? this.one(["Number", "Number", "Boolean", "String"]) : wanted;
    this.depth += 1;
    const defined = this.depth > DEEPEST ? LEAVES : VALUES;
    const made = this.draw(defined.filter((each) => [kind, "any"].includes(each.kind)), kind);
    this.depth -= 1;
    return made;
  }

  block(type, { fields = {}, extraState = null, kinds = {}, inputs = null }) {
    const defined = define(type, inputs ? null : extraState);
    const made = { type, id: this.id(), ...extraState && { extraState } };
    const chosen = { ...Object.fromEntries(defined.choices.map(([name, all]) => [name, this.one(all)])), ...fields };
    if (Object.keys(chosen).length) made.fields = chosen;
    const filled = (inputs ?? defined.inputs).map(({ name, isBody, kind }) => [name,
      isBody ? this.body(name) : this.input(name, kinds[name] ?? kind)]).filter(([, input]) => input);
    if (filled.length) made.inputs = Object.fromEntries(filled);
    return made;
  }

  // Returns an input: empty, or with a value, above a shadow or not.
  input(name, kind) {
    if (this.chance(0.04)) return null;
    const own = OF_INPUTS[name];
    const shadowed = kind === "Number" && (own || this.chance(0.5));
    const NUM = this.one(own ?? NUMBERS);
    const shadow = shadowed && { shadow: { type: "math_number", id: this.id(), fields: { NUM } } };
    if (shadow && this.chance(own ? 0.75 : 0.3)) return shadow;
    return { ...shadow, block: this.value(kind) };
  }

  variable(kind) {
    const fitting = this.variables.filter((_, index) => this.kinds[index] === kind);
    return { id: this.one(fitting.length && this.chance(0.97) ? fitting : this.variables).id };
  }

  // Returns a call of a function, or null: one that calls itself is rare.
  call(returns) {
    const fitting = this.functions.filter((each) => each.returns === returns);
    const later = fitting.filter((each) => this.functions.indexOf(each) > this.functions.indexOf(this.inside));
    const called = this.one(this.chance(0.05) ? fitting : later);
    if (!called) return null;
    const [{ name }, params] = [called, called.params.map((each) => each.name)];
    return { extraState: { name, ...params.length && { params } },
      kinds: Object.fromEntries(params.map((_, number) => [`ARG${number}`, "Number"])) };
  }

  // Returns an input with statements, or none.
  body(name) {
    const isLoop = name === "DO";
    this.nesting += 1;
    this.loops += Number(isLoop);
    const statements = this.statements(this.nesting > DEEPEST || this.chance(0.15) ? 0 : this.up(3));
    this.nesting -= 1;
    this.loops -= Number(isLoop);
    return statements;
  }

  statements(length) {
    if (length < 1) return null;
    const block = this.draw(STATEMENTS);
    const { goesOn } = STATEMENTS.find(({ type }) => type === block.type);
    const next = goesOn ? this.statements(length - 1) : null;
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
      ...returns && this.chance(0.85) && { RETURN: this.input("RETURN", "Number") },
    };
    this.inside = null;
    const filled = Object.entries(inputs).filter(([, input]) => input);
    return { type: returns ? "procedures_defreturn" : "procedures_defnoreturn", id: this.id(),
      x: 400, y: 30 + 200 * index, ...Object.keys(state).length && { extraState: state }, fields: { NAME: name },
      ...filled.length && { inputs: Object.fromEntries(filled) } };
  }

  // Returns statements that set most of the variables.
  beginning() {
    return this.variables.map(({ id }, index) => [id, this.kinds[index]]).filter(() => this.chance(0.8))
      .map(([id, VALUE]) => this.block("variables_set", { fields: { VAR: { id } }, kinds: { VALUE } }));
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
