// Calculations and prints are Python's, as tests/unit/differential.py compares them; here, what random programs do not
// meet.

import assert from "node:assert/strict";
import { test } from "node:test";

import { comparable, COMPARISONS, notANumber, OPERATIONS, plain, PROPERTIES, shown } from "#www/program/values.js";

test("primes are found, and a number that would take too long is refused", () => {
  assert.deepEqual([...Array(20).keys()].filter(PROPERTIES.PRIME), [2, 3, 5, 7, 11, 13, 17, 19]);
  assert.throws(() => PROPERTIES.PRIME(1e12), /^Error: Whether 1000000000000 is prime takes too long to find out\.$/);
});

test("a number is printed with six digits, a large one with all", () => {
  assert.deepEqual([1 / 3, 0.1 + 0.2, 123456.789, 2e-7, 4].map(shown), ["0.333333", "0.3", "123456.789", "2e-7", "4"]);
});

test("texts are compared by their code points", () => {
  assert.ok(COMPARISONS.LT(...["\ufe0f", "👪"].map(comparable)));
});

test("True, False and None are printed as such, and calculated as 1 and 0", () => {
  assert.deepEqual([true, false, null, "<b>"].map(shown), ["True", "False", "None", "<b>"]);
  assert.deepEqual([Infinity, -Infinity, NaN].map(shown), ["inf", "-inf", "nan"]);
  assert.deepEqual([true, false, 3].map(plain), [1, 0, 3]);
});

test("a sentence names a value as the blocks do", () => {
  const named = [true, false, null].map((value) => notANumber(value).match(/not (.*)\./)?.[1]);
  assert.deepEqual(named, ["“true”", "“false”", "“nothing”"]);
  for (const [value, sign] of [[Infinity, "∞"], [-Infinity, "−∞"], [NaN, "“not a number”"]]) {
    assert.throws(() => OPERATIONS.ROUND(value), { message: `${sign} cannot be rounded.` });
  }
});
