// Values as Python has them: how they are calculated, compared and printed. None is null.

import { t } from "../language.js";
import { ProgramError } from "./program_error.js";

const MAX_PRIME = 1e10; // what is larger takes too long
const MAX_NAME = 40; // characters of a text in a sentence
const WORDS = { // as the blocks have them, for sentences
  True: t("“true”"), False: t("“false”"), None: t("“nothing”"), inf: "∞", "-inf": "−∞", nan: t("“not a number”"),
};

const degrees = (radians) => radians / Math.PI * 180;
const radians = (angle) => angle / 180 * Math.PI;
const power = (a, b) => (a === 1 || a === -1 && Math.abs(b) === Infinity ? 1 : Math.pow(a, b));

// Refuses what Python's math refuses: no result, or an infinite one of what is finite.
const checked = (calculate) => (...given) => {
  const result = calculate(...given);
  const fails = Number.isNaN(result) ? !given.some(Number.isNaN)
    : !Number.isFinite(result) && given.every(Number.isFinite);
  return fails ? refuse(t("This calculation has no result.")) : result;
};

// Refuses to round what is not finite, as Python does.
export const whole = (round) => (number) =>
  (isFinite(number) ? round(number) : refuse(t("{value} cannot be rounded.", { value: named(number) })));

export const OPERATIONS = {
  ADD: (a, b) => a + b, MINUS: (a, b) => a - b, MULTIPLY: (a, b) => a * b, DIVIDE: (a, b) => a / divisor(b),
  POWER: checked(power), ROOT: checked(Math.sqrt), ABS: Math.abs, NEG: (a) => -a,
  LN: checked(Math.log), LOG10: checked(Math.log10), EXP: checked(Math.exp), POW10: checked((a) => Math.pow(10, a)),
  SIN: checked((a) => Math.sin(radians(a))), COS: checked((a) => Math.cos(radians(a))),
  TAN: checked((a) => Math.tan(radians(a))), ASIN: checked((a) => degrees(Math.asin(a))),
  ACOS: checked((a) => degrees(Math.acos(a))), ATAN: (a) => degrees(Math.atan(a)),
  ROUND: whole(roundToEven), ROUNDUP: whole(Math.ceil), ROUNDDOWN: whole(Math.floor),
};
export const CONSTANTS = {
  PI: Math.PI, E: Math.E, GOLDEN_RATIO: (1 + Math.sqrt(5)) / 2, SQRT2: Math.SQRT2, SQRT1_2: Math.SQRT1_2,
  INFINITY: Infinity,
};
export const PROPERTIES = {
  EVEN: (a) => modulo(a, 2) === 0, ODD: (a) => modulo(a, 2) === 1, WHOLE: (a) => modulo(a, 1) === 0, PRIME: isPrime,
  POSITIVE: (a) => a > 0, NEGATIVE: (a) => a < 0, DIVISIBLE_BY: (a, b) => modulo(a, b) === 0,
};
export const COMPARISONS = {
  EQ: (a, b) => a === b, NEQ: (a, b) => a !== b,
  LT: (a, b) => a < b, LTE: (a, b) => a <= b, GT: (a, b) => a > b, GTE: (a, b) => a >= b,
};

export function modulo(a, b) {
  const rest = a % divisor(b);
  return rest && rest < 0 !== b < 0 ? rest + b : rest;
}

// Returns a value, or the bound that it exceeds, as Python's max and min do.
export function constrain(value, low, high) {
  const raised = low > value ? low : value;
  return high < raised ? high : raised;
}

// Returns a whole number from one to the other, whichever is larger.
export function randomInteger(one, other) {
  const [low, high] = [one, other].map(OPERATIONS.ROUND).sort((a, b) => a - b);
  return low + Math.floor(Math.random() * (high - low + 1));
}

function divisor(number) {
  return Number(number) === 0 ? refuse(t("This block divides by 0.")) : number;
}

function roundToEven(number) {
  return Math.abs(number % 1) === 0.5 ? 2 * Math.round(number / 2) : Math.round(number);
}

function isPrime(number) {
  if (!(number > 1) || modulo(number, 1) !== 0) return false;
  if (number > MAX_PRIME) refuse(t("Whether {value} is prime takes too long to find out.", { value: shown(number) }));
  for (let factor = 2; factor * factor <= number; factor += 1) if (number % factor === 0) return false;
  return true;
}

// Returns the value with True as 1, and False as 0.
export function plain(value) {
  return typeof value === "boolean" ? Number(value) : value;
}

// Returns what Python compares: of a text, the code points, which JavaScript would compare in halves.
export function comparable(value) {
  if (typeof value !== "string") return plain(value);
  return Array.from(value, (each) => Number(each.codePointAt(0)).toString(16).padStart(6, "0")).join("");
}

// Returns whether a condition with this value holds.
export function truth(value) {
  return Boolean(value) || Number.isNaN(value);
}

// Returns a value as it is printed.
export function shown(value) {
  if (value === null) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value !== "number") return value;
  if (!Number.isFinite(value)) return String(value).replace("Infinity", "inf").replace("NaN", "nan");
  return String(Number.isInteger(value) ? value : Number(value.toPrecision(Math.abs(value) < 1e5 ? 6 : 15)));
}

// Returns a value in a sentence, where no text is.
function named(value) {
  return WORDS[shown(value)] ?? shown(value);
}

// Returns that this value is no number, where one is needed.
export function notANumber(value) {
  return isText(value) ? t("Here a number is needed, not the text “{text}”.", { text: short(value) })
    : t("Here a number is needed, not {value}.", { value: named(value) });
}

// Returns the same of the value of a variable that a block changes.
export function notChangeable(value) {
  return isText(value) ? t("Only a number can be changed, not the text “{text}”.", { text: short(value) })
    : t("Only a number can be changed, not {value}.", { value: named(value) });
}

// Returns that these values are of two kinds.
export function notComparable(a, b) {
  if (isText(a)) return t("The text “{text}” and {value} cannot be compared.", { text: short(a), value: named(b) });
  if (isText(b)) return t("{value} and the text “{text}” cannot be compared.", { text: short(b), value: named(a) });
  return t("{one} and {other} cannot be compared.", { one: named(a), other: named(b) });
}

function isText(value) {
  return typeof value === "string";
}

function short(text) {
  return text.slice(0, MAX_NAME);
}

function refuse(sentence) {
  throw new ProgramError(sentence);
}
