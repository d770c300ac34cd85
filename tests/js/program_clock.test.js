// A program's own clock, by which it waits.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Clock as ProgramClock } from "#www/program/clock.js";

import { Clock } from "./clock.js";

function begin(t) {
  const clock = new Clock(t);
  const own = new ProgramClock();
  own.begin();
  return { clock, own, since: own.now };
}

test("a pause takes no time of the program", async (t) => {
  const { clock, own } = begin(t);
  await clock.pass(1000);
  own.stop();
  own.stop();
  await clock.pass(5000);
  assert.equal(own.stands, true);
  own.goOn();
  own.goOn();
  await clock.pass(500);
  assert.equal(own.seconds, 1.5);
});

test("waits add up, though each timer is late by some ms", async (t) => {
  const { clock, own, since } = begin(t);
  for (let wait = 1; wait <= 10; wait += 1) {
    assert.equal(own.afterWait(0.1) - since, 100 * wait);
    await clock.pass(own.due - own.now + 7);
  }
});

test("after a statement that took long, a wait is as long as it says", async (t) => {
  const { clock, own } = begin(t);
  await clock.pass(400);
  assert.equal(own.afterWait(0.1) - own.now, 100);
});

test("a loop at 10 Hz keeps its tenths of a second, and catches up after a long round only once", async (t) => {
  const { clock, own, since } = begin(t);
  assert.equal(own.nextTick() - since, 100);
  await clock.pass(130);
  assert.equal(own.nextTick() - since, 200);
  await clock.pass(1000);
  assert.equal(own.nextTick() - since, 300); // is over: the round begins at once
  assert.equal(own.nextTick() - since, 1230);
});
