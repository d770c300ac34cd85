// A sentence in the page's language: its names, its numbers, its plurals. Without a browser it is English.

import assert from "node:assert/strict";
import { test } from "node:test";

import { number, t } from "#www/language.js";

test("names are replaced, and what has no value stays", () => {
  assert.equal(t("{name} has taken {robot}.", { name: "Ada", robot: "{name}" }), "Ada has taken {name}.");
  assert.equal(t("{name} drives."), "{name} drives.");
});

test("count chooses the form of a plural", () => {
  const robots = "{count} robot|{count} robots";
  assert.deepEqual([0, 1, 2, "1"].map((count) => t(robots, { count })), ["0 robots", "1 robot", "2 robots", "1 robot"]);
});

test("a number has the language's decimal mark, and every other text stays", () => {
  assert.deepEqual(["0.40", "−1.5", "1.2.3", "v1.5", 7].map(number), ["0.40", "−1.5", "1.2.3", "v1.5", "7"]);
});
