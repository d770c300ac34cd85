// Values as Python has them: how they are calculated, compared and printed. None is null; what has no result is NaN.

const MAX_PRIME = 1e10; // what is larger takes too long
const degrees = (radians) => radians * 180 / Math.PI;
const radians = (angle) => angle * Math.PI / 180;

export const OPERATIONS = {
  ADD: (a, b) => a + b, MINUS: (a, b) => a - b, MULTIPLY: (a, b) => a * b, DIVIDE: (a, b) => a / b,
  POWER: (a, b) => a ** b,
  ROOT: Math.sqrt, ABS: Math.abs, NEG: (a) => -a, LN: Math.log, LOG10: Math.log10, EXP: Math.exp, POW10: (a) => 10 ** a,
  SIN: (a) => Math.sin(radians(a)), COS: (a) => Math.cos(radians(a)), TAN: (a) => Math.tan(radians(a)),
  ASIN: (a) => degrees(Math.asin(a)), ACOS: (a) => degrees(Math.acos(a)), ATAN: (a) => degrees(Math.atan(a)),
  ROUND: roundToEven, ROUNDUP: Math.ceil, ROUNDDOWN: Math.floor,
};
export const CONSTANTS = {
  PI: Math.PI, E: Math.E, GOLDEN_RATIO: (1 + Math.sqrt(5)) / 2, SQRT2: Math.SQRT2, SQRT1_2: Math.SQRT1_2,
  INFINITY: Infinity,
};
export const PROPERTIES = {
  EVEN: (a) => modulo(a, 2) === 0, ODD: (a) => modulo(a, 2) === 1, WHOLE: (a) => modulo(a, 1) === 0, PRIME: isPrime,
  POSITIVE: (a) => a > 0, NEGATIVE: (a) => a < 0, DIVISIBLE_BY: (a, b) => (b ? modulo(a, b) === 0 : NaN),
};
export const COMPARISONS = {
  EQ: (a, b) => a === b, NEQ: (a, b) => a !== b,
  LT: (a, b) => a < b, LTE: (a, b) => a <= b, GT: (a, b) => a > b, GTE: (a, b) => a >= b,
};

export function modulo(a, b) {
  const rest = a % b;
  return rest * b < 0 ? rest + b : rest;
}

function roundToEven(number) {
  return Math.abs(number % 1) === 0.5 ? 2 * Math.round(number / 2) : Math.round(number);
}

function isPrime(number) {
  if (number > MAX_PRIME) return NaN;
  for (let divisor = 2; divisor * divisor <= number; divisor += 1) if (number % divisor === 0) return false;
  return number > 1 && number % 1 === 0;
}

// Returns the value with True as 1, and False as 0.
export function plain(value) {
  return typeof value === "boolean" ? Number(value) : value;
}

// Returns a value as it is printed.
export function shown(value) {
  if (value === null) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  return typeof value === "number" ? String(Number(value.toPrecision(Math.abs(value) < 1e5 ? 6 : 15))) : value;
}
