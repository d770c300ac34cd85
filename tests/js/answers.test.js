// What a page takes from the worker of a text, whatever runs in it.

import assert from "node:assert/strict";
import { test } from "node:test";

import { checked } from "#www/python/answers.js";

const NOTHING = { events: [], variables: null, over: false, problem: undefined, broken: "" };

test("of an answer the page takes what an engine understands, and nothing else", () => {
  const events = [{ step: 3, publish: true }, { wait: 0.1 }, { breathe: true }, { print: "a" }, { name: "b", value: 1 },
    { motion: [1, 2], robot: "/other" }];
  assert.deepEqual(checked({ events, robot: "/other", over: true }).events,
    [{ step: 3 }, { wait: 0.1 }, { breathe: true }, { print: "a" }, { name: "b", value: 1 }, { motion: [1, 2] }]);
});

for (const answer of [null, 5, "text", [], {}, { events: 5 }, { events: { length: 5 } }, { over: 1 }, { variables: 5 },
  ...[null, 5, "x", { step: "<b>" }, { step: 1.5 }, { wait: "1" }, { print: { length: 1 } }, { name: "x", value: "1" },
    { motion: 5 }, { motion: ["1", "2"] }, { publish: true }, { send: {} }].map((event) => ({ events: [event] }))]) {
  test(`${JSON.stringify(answer)} is no answer`, () => assert.deepEqual(checked(answer), NOTHING));
}

test("what is too much is cut", () => {
  const long = "x".repeat(1e6);
  const name = "x".repeat(150);
  const variables = JSON.stringify(Array.from({ length: 500 }, (_, index) => [index + name, name]));
  const answer = checked({ events: Array(1000).fill({ print: long }), variables, broken: long,
    problem: { type: long, message: long, line: "x" } });
  assert.equal(answer.events.length, 100);
  assert.equal(answer.variables.size, 100);
  assert.ok([...answer.variables].flat().every(({ length }) => length <= 100));
  assert.equal(checked({ variables: JSON.stringify([["x", long]]) }).variables, null);
  const texts = [answer.events[0].print, answer.broken, answer.problem.message];
  assert.ok(texts.every(({ length }) => length <= 10000));
});
