// What a hand on an input sends to the robot.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Driving } from "#www/driving.js";

import { Clock } from "./clock.js";

// Plays what happens, one after the other: the ms that pass, where an input is ("pad 1 0"), or what Driving is asked.
// Returns what was sent.
async function play(t, ...steps) {
  const [clock, page] = [new Clock(t), { ready: true, sent: [] }];
  const send = (...command) => page.sent.push(command.map((each) => each + 0));
  const driving = new Driving({ send, ready: () => page.ready, changed() {} });
  for (const step of steps) {
    const [what, ...place] = String(step).split(" ");
    if (typeof step === "number") await clock.pass(step);
    else if (typeof step === "object") Object.assign(step.speed ? driving : page, step);
    else if (place.length) driving.deflect(what, ...place.map(Number));
    else driving[what]();
  }
  return page.sent;
}

const TAP = ["pad 1 0", "pad 0 0", 5];
const SEQUENCES = { // what happens, and what is sent
  "a hand off the centre sends 20 commands per second, and one zero when it lets go":
    [["pad 1 0", 1000, "pad 0 0", 1000], [...Array(21).fill([0.5, 0]), [0, 0]]],
  "a hand that taps sends no more than 20 commands per second, and a zero for each tap":
    [Array(10).fill(TAP).flat(), [[0.5, 0], ...Array(10).fill([0, 0])]],
  "a trembling hand near the centre drives nothing": [["pad 0.08 -0.08"], []],
  "a second input changes nothing, also once it is alone": [
    ["pad 1 0", "keys -1 0", "pad 0 0", "keys -1 0", 100], [[0.5, 0], [0, 0]]],
  "a second input drives once it has returned to the centre": [
    ["pad 1 0", "keys -1 0", "pad 0 0", "keys 0 0", "keys -1 0", 50], [[0.5, 0], [0, 0], [0, 0], [-0.5, 0]]],
  "a hand that was there before the connection must return to the centre first":
    [[{ ready: false }, "pad 1 0", { ready: true }, "pad 1 0"], []],
  "a hand that was there before the connection says with a zero that it has returned":
    [[{ ready: false }, "pad 1 0", { ready: true }, "pad 1 0", "pad 0 0"], [[0, 0]]],
  "a page that is hidden sends one zero, and the hand must return first":
    [["pad 1 0", "interrupt", "pad 1 0", 500], [[0.5, 0], [0, 0]]],
  "a robot that was stopped from outside gets nothing until the hand has returned":
    [["pad 1 0", "lift", "pad 0.9 0", 500], [[0.5, 0]]],
};

for (const [what, [steps, sent]] of Object.entries(SEQUENCES)) {
  test(what, async (t) => assert.deepEqual(await play(t, ...steps), sent));
}

test("a hand that moves sends its newest place, not more commands", async (t) => {
  const moves = Array.from({ length: 101 }, (_, step) => [`pad 1 ${step / 1000}`, 1]);
  const sent = await play(t, ...moves.flat());
  assert.ok(sent.length <= 3);
  assert.ok(sent.at(-1)[1] > sent[0][1]);
});

test("a corner is no faster than the edge, a full turn half as fast as full speed, and the slider limits both",
  async (t) => {
    const sent = await play(t, { speed: 1 }, "pad 1 1", "pad 0 0", 50, "pad 0 1", "pad 0 0");
    const [[forward, left], , [, turn]] = sent;
    assert.ok(Math.abs(Math.hypot(forward, left / 0.5) - 1) < 1e-9);
    assert.equal(turn, 0.5);
  });

test("a gamepad that may be dead sends one zero, and drives again as soon as it moves", async (t) => {
  const clock = new Clock(t);
  const sent = [];
  const driving = new Driving({ send: (forward) => sent.push(forward), ready: () => true, changed() {} });
  driving.deflect("gamepad", 1, 0);
  assert.deepEqual([driving.pause("gamepad"), driving.pause("gamepad")], [true, false]);
  await clock.pass(50);
  driving.deflect("gamepad", 0.9, 0);
  assert.equal(sent.length, 3);
  assert.ok(sent[2] > 0.4);
});
