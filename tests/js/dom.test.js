// Numbers and times as the page shows them.

import assert from "node:assert/strict";
import { test } from "node:test";

import { inSeconds, signed } from "#www/dom.js";

test("a number has two places, a real minus, and no negative zero", () => {
  assert.deepEqual([0.5, -0.256, -0.001, 0].map(signed), ["0.50", "−0.26", "0.00", "0.00"]);
});

test("a time has its unit, and is nothing where it is not known", () => {
  assert.deepEqual([12.34, 0, null].map(inSeconds), ["12.3 s", "0.0 s", ""]);
});
