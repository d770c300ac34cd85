// What a program knows of its robot.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Senses } from "#www/program/senses.js";

import { Clock, settled } from "./clock.js";

const EYE = { senses: true, eyes: true };
const HERE = { senses: true, eyes: false };

function begin(t, needs = HERE) {
  const clock = new Clock(t);
  const asked = [];
  return { clock, asked, senses: new Senses(needs, () => asked.push(clock.now)) };
}

test("the place is seen from where the program starts, with the heading within half a turn", (t) => {
  const { senses } = begin(t);
  senses.receive({ ready: true, pose: [1, 2, Math.PI / 2] });
  senses.begin();
  senses.receive({ ready: true, pose: [0.5, 4, -Math.PI] });
  const { X, Y, HEADING } = senses.values.here;
  assert.deepEqual([X, Y, HEADING].map((each) => each.toFixed(6)), ["2.000000", "0.500000", "90.000000"]);
});

test("the cockpit is asked eleven times per second at most", async (t) => {
  const { clock, asked, senses } = begin(t);
  for (let turn = 0; turn < 1000; turn += 1) {
    senses.refresh();
    await clock.pass(1);
  }
  assert.equal(asked.length, 12);
});

test("an answer that is late is not waited for, and one that comes ends the wait", async (t) => {
  const { clock, senses } = begin(t);
  const ends = [];
  void senses.wait().then(() => ends.push("late"));
  await clock.pass(99);
  assert.deepEqual(ends, []);
  await clock.pass(1);
  assert.deepEqual(ends, ["late"]);
  void senses.wait().then(() => ends.push("answered"));
  senses.receive({ ready: true });
  await settled();
  assert.equal(ends.at(-1), "answered");
});

test("a program that looks at the floor begins once its robot reports what it sees", (t) => {
  const { senses } = begin(t, EYE);
  senses.receive({ ready: true, line: null });
  assert.equal(senses.complete, false);
  senses.receive({ ready: true, line: [1, 0, 1] });
  assert.equal(senses.complete, true);
});
