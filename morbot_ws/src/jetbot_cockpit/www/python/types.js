// Values of the wrong type: a text and a number added, what is no function called, too few values.

import { t } from "../language.js";

export const NO_RESULT = t("A function without return gives None.");
export const CALL = t("A function is called with brackets after its name: f()");
const CONVERT = t("str(x) makes a text of a number, float(x) a number of a text.");
export const POINT = t("A decimal number has a point, and no comma: 0.5");
const ITEM = t("An item is taken with square brackets: x[0]");
export const SELF = t("The first parameter of a method is self: def name(self):");
const WHOLE = t("int(x) makes a whole number of x.");
const MULTIPLY = t("To multiply, write *");
const RANGE = t("range(10) gives 10 numbers.");

const KINDS = {
  __proto__: null, str: t("text"), int: t("number"), float: t("number"), bool: t("True or False"), NoneType: "None",
  list: t("list"), dict: t("dictionary"), function: t("function"), bound_method: t("function"),
  closure: t("function"), module: t("module"),
};
const SIGNS = {
  __proto__: null, add: "+", sub: "-", mul: "*", truediv: "/", floordiv: "//", mod: "%", pow: "**", lt: "<", gt: ">",
  le: "<=", ge: ">=", and: "&", or: "|", xor: "^", lshift: "<<", rshift: ">>", iadd: "+=", isub: "-=", imul: "*=",
  itruediv: "/=",
};
const HINTS = [ // for what meets in an operation
  [["function", "bound_method", "closure"], CALL], [["NoneType"], NO_RESULT], [["tuple"], POINT], [["str"], CONVERT],
];

// Returns the name of a type of values; other classes keep their own.
/** @param {string} type */
export const kindOf = (type) => KINDS[type] ?? type;
export const joined = (...parts) => parts.filter(Boolean).join(" ");

function unsupported({ sign, one, other }) {
  const [, hint] = HINTS.find(([types]) => types.some((type) => type === one || type === other)) ?? [];
  const text = `${kindOf(one)} ${SIGNS[sign] ?? sign ?? "in"} ${kindOf(other)}`;
  return joined(t("This does not work: {text}.", { text }), hint);
}

const needsNumber = ({ type }) => joined(t("Here a number is needed, not {value}.", { value: kindOf(type) }),
                                         { str: CONVERT, tuple: POINT, NoneType: NO_RESULT }[type]);

const noFunction = ({ type }) => joined(
  t("What comes before “(” is not a function, but: {text}.", { text: kindOf(type) }),
  { list: ITEM, tuple: ITEM, dict: ITEM, str: ITEM, int: MULTIPLY, float: MULTIPLY }[type]);

const ofFunction = ({ count, got }) => t(
  "The function takes {count} value but gets {got}.|The function takes {count} values but gets {got}.",
  { count, got });

function wrongCount({ name, needed, given, source, code }) {
  const isMethod = new RegExp(`^[ \\t]+def\\s+${name}\\s*\\(`, "m").test(source);
  const isCallback = new RegExp(`\\b(?:Subscriber|Timer)\\(.*\\b${name}\\b`).test(source);
  if (isCallback && given - needed === 1 && !code.includes(`${name}(`)) return callback(name, isMethod, source);
  const hasSelf = new RegExp(`\\bdef\\s+${name}\\s*\\(\\s*self\\b`).test(source);
  if (isMethod && !hasSelf && code.includes(`.${name}(`)) return SELF;
  const isMade = name === "__init__";
  const [count, got] = [needed, given].map((each) => each - (hasSelf || isMade ? 1 : 0));
  if (isMade) return ofFunction({ count, got });
  return t("{name}() takes {count} value but gets {got}.|{name}() takes {count} values but gets {got}.",
           { name, count, got });
}

// Returns what is said of a callback, and the line on which it begins.
function callback(name, isMethod, source) {
  const line = source.split("\n").findIndex((each) => new RegExp(`\\bdef\\s+${name}\\b`).test(each)) + 1;
  const text = `def ${name}(${isMethod ? "self, " : ""}message):`;
  return { line, text: t("A callback gets one value, such as a message: {text}", { text }) };
}

/** @import { Row } from "./mistakes.js" */
/** @type {Row[]} */
export const TYPES = [
  ["TypeError", /^unsupported types for (?:__r?(?<sign>\w+)__)?: '(?<one>\w+)', '(?<other>\w+)'$/, unsupported],
  ["TypeError", /^unsupported type for __hash__: '(?<type>\w+)'$/,
    ({ type }) => t("This cannot be a key of a dictionary, nor be in a set: {text}.", { text: kindOf(type) })],
  ["TypeError", /^unsupported type for __\w+__: '(?<type>\w+)'$/, needsNumber],
  ["TypeError", /^can't convert float to int$/, () => joined(t("Here a whole number is needed."), WHOLE)],
  ["TypeError", /^can't convert (?<type>\w+) to (?:int|float)$/, needsNumber],
  ["TypeError", /^can't convert '\w+' object to str/,
    () => t("Here a text is needed: put quotation marks around it.")],
  ["TypeError", /^'(?<type>\w+)' object isn't callable$/, noFunction],
  ["TypeError", /^(?<name>\w+)\(\) takes (?<needed>\d+) positional arguments but (?<given>\d+) were given$/,
    wrongCount],
  ["TypeError", /^function takes (?<count>\d+) positional arguments but (?<got>\d+) were given$/, ofFunction],
  ["TypeError", /^function missing /, () => t("The function needs more values between its brackets.")],
  ["TypeError", /^function expected at most/, () => t("The function takes fewer values between its brackets.")],
  ["TypeError", /^unexpected keyword argument '(?<name>\w+)'$/,
    ({ name }) => t("The function has no parameter “{name}”.", { name })],
  ["TypeError", /keyword arguments(?: given)?$/, () => t("The function has no parameter of this name.")],
  ["TypeError", /^function got multiple values for argument '(?<name>\w+)'$/,
    ({ name }) => t("“{name}” gets two values in this call.", { name })],
  ["TypeError", /^'(?<type>\w+)' object isn't iterable$/, ({ type }) => joined(
    t("Here a list, a text or a range is needed, not: {text}.", { text: kindOf(type) }),
    { int: RANGE, float: RANGE, NoneType: NO_RESULT }[type])],
  ["TypeError", /^object of type '(?<type>\w+)' has no len\(\)$/,
    ({ type }) => t("This has no length: {text}.", { text: kindOf(type) })],
  ["TypeError", /indices must be integers, not (?<type>\w+)$/, ({ type }) => t(
    "The position of an item is a whole number (0, 1, 2 ...), not: {text}.", { text: kindOf(type) })],
  ["TypeError", /^'(?<type>\w+)' object isn't subscriptable$/, ({ type }) => joined(
    t("This has no items to take with [ ]: {text}.", { text: kindOf(type) }), type === "NoneType" && NO_RESULT)],
  ["TypeError", /^'(?<type>\w+)' object doesn't support item assignment$/,
    ({ type }) => t("The items of this cannot be changed: {text}. Those of a list can.", { text: kindOf(type) })],
];
