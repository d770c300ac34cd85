// What a hand on an input sends to the robot.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Driving } from "#www/driving.js";

import { Clock } from "./clock.js";

function begin(t) {
  const clock = new Clock(t);
  const state = { clock, ready: true, sent: [] };
  const send = (...command) => state.sent.push(command.map((each) => each + 0));
  state.driving = new Driving({ send, ready: () => state.ready, changed() {} });
  return state;
}

test("a hand off the centre sends 20 commands per second, and one zero when it lets go", async (t) => {
  const { clock, driving, sent } = begin(t);
  driving.deflect("pad", 1, 0);
  await clock.pass(1000);
  assert.deepEqual(sent, Array(21).fill([0.5, 0]));
  driving.deflect("pad", 0, 0);
  await clock.pass(1000);
  assert.deepEqual(sent.slice(21), [[0, 0]]);
});

test("a hand that moves sends its newest place, not more commands", async (t) => {
  const { clock, driving, sent } = begin(t);
  for (let step = 0; step <= 100; step += 1) {
    driving.deflect("pad", 1, step / 1000);
    await clock.pass(1);
  }
  assert.ok(sent.length <= 3);
  assert.ok(sent.at(-1)[1] > sent[0][1]);
});

test("a hand that taps sends no more than 20 commands per second, and a zero for each tap", async (t) => {
  const { clock, driving, sent } = begin(t);
  for (let tap = 0; tap < 10; tap += 1) {
    driving.deflect("pad", 1, 0);
    driving.deflect("pad", 0, 0);
    await clock.pass(5);
  }
  assert.deepEqual(sent, [[0.5, 0], ...Array(10).fill([0, 0])]);
});

test("a trembling hand near the centre drives nothing", (t) => {
  const { driving, sent } = begin(t);
  driving.deflect("pad", 0.08, -0.08);
  assert.deepEqual(sent, []);
});

test("a corner is no faster than the edge, a full turn half as fast as full speed, and the slider limits both", (t) => {
  const { clock, driving, sent } = begin(t);
  driving.speed = 1;
  for (const place of [[1, 1], [0, 1]]) {
    driving.deflect("pad", ...place);
    driving.deflect("pad", 0, 0);
    clock.freeze(50);
  }
  const [[forward, left], , [, turn]] = sent;
  assert.ok(Math.abs(Math.hypot(forward, left / 0.5) - 1) < 1e-9);
  assert.equal(turn, 0.5);
});

test("a second input changes nothing, and must return to the centre before it drives", async (t) => {
  const { clock, driving, sent } = begin(t);
  driving.deflect("pad", 1, 0);
  driving.deflect("keys", -1, 0);
  driving.deflect("pad", 0, 0);
  driving.deflect("keys", -1, 0);
  await clock.pass(100);
  assert.deepEqual(sent, [[0.5, 0], [0, 0]]);
  driving.deflect("keys", 0, 0);
  driving.deflect("keys", -1, 0);
  await clock.pass(50);
  assert.deepEqual(sent.at(-1), [-0.5, 0]);
});

test("a hand that was there before the connection must return to the centre first, and says so with a zero", (t) => {
  const state = begin(t);
  state.ready = false;
  state.driving.deflect("pad", 1, 0);
  state.ready = true;
  state.driving.deflect("pad", 1, 0);
  assert.deepEqual(state.sent, []);
  state.driving.deflect("pad", 0, 0);
  assert.deepEqual(state.sent, [[0, 0]]);
});

test("a page that is hidden sends one zero, and the hand must return first", async (t) => {
  const { clock, driving, sent } = begin(t);
  driving.deflect("pad", 1, 0);
  driving.interrupt();
  driving.deflect("pad", 1, 0);
  await clock.pass(500);
  assert.deepEqual(sent, [[0.5, 0], [0, 0]]);
});

test("a robot that was stopped from outside gets nothing until the hand has returned", async (t) => {
  const { clock, driving, sent } = begin(t);
  driving.deflect("pad", 1, 0);
  driving.lift();
  driving.deflect("pad", 0.9, 0);
  await clock.pass(500);
  assert.deepEqual(sent, [[0.5, 0]]);
});

test("a gamepad that may be dead sends one zero, and drives again as soon as it moves", async (t) => {
  const { clock, driving, sent } = begin(t);
  driving.deflect("gamepad", 1, 0);
  assert.equal(driving.pause("gamepad"), true);
  assert.equal(driving.pause("gamepad"), false);
  await clock.pass(50);
  driving.deflect("gamepad", 0.9, 0);
  assert.equal(sent.length, 3);
  assert.ok(sent[2][0] > 0.4);
});
