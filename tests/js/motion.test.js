// What a program's commands become on their way to the cockpit.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Motion } from "#www/program/motion.js";

import { Clock } from "./clock.js";

const WORKSHOP = { wheel_separation: 2, max_speed: 1 };

function begin(t) {
  const clock = new Clock(t);
  const sent = [];
  const motion = new Motion((...command) => sent.push(command));
  motion.begin();
  return { clock, motion, sent };
}

test("a command is repeated 20 times per second", async (t) => {
  const { clock, motion, sent } = begin(t);
  motion.publish([0.5, 0.25], WORKSHOP);
  await clock.pass(500);
  assert.deepEqual(sent, Array(11).fill([0.5, 0.25]));
});

test("a program that publishes nothing for a second stops the robot", async (t) => {
  const { clock, motion, sent } = begin(t);
  motion.publish([0.5, 0], WORKSHOP);
  await clock.pass(1100);
  assert.deepEqual(sent.at(-1), [0, 0]);
});

test("a wheel gets full power at most, in the robot's own units", (t) => {
  const { motion, sent } = begin(t);
  motion.publish([0.3, 4], { wheel_separation: 0.1, max_speed: 0.5 });
  assert.deepEqual(sent[0].map((each) => each.toFixed(6)), ["0.600000", "0.400000"]); // wheels: 0.2 and 1
  motion.publish([3, 0], WORKSHOP);
  assert.deepEqual(sent[1], [1, 0]);
});

test("a command that is not finite stops the robot, as in its controller", (t) => {
  const { motion } = begin(t);
  for (const endless of [[Infinity, 0], [0, NaN]]) {
    motion.publish([0.5, 0], WORKSHOP);
    motion.publish(endless, WORKSHOP);
    assert.deepEqual(motion.command, [0, 0]);
  }
});

test("short pulses are not more than the cockpit takes, and end with a stop", (t) => {
  const { motion, sent } = begin(t);
  for (let count = 0; count < 100; count += 1) {
    motion.set(1, 0);
    motion.set(0, 0);
  }
  assert.ok(sent.length >= 2 && sent.length < 20, String(sent.length));
  assert.deepEqual(sent.at(-1), [0, 0]);
});

test("a stop is sent at once, whatever was sent before", (t) => {
  const { motion, sent } = begin(t);
  for (let count = 1; count <= 50; count += 1) motion.set(count / 100, 0);
  motion.set(0, 0);
  assert.deepEqual(sent.at(-1), [0, 0]);
});

test("a command that changes at once is not repeated before", async (t) => {
  const { clock, motion, sent } = begin(t);
  motion.publish([0.5, 0], WORKSHOP);
  await clock.pass(40);
  motion.changesAt = clock.now + 12;
  await clock.pass(12);
  motion.publish([0.2, 0], WORKSHOP);
  assert.deepEqual(sent, [[0.5, 0], [0.2, 0]]);
});

test("a program that has ended has stopped the robot, and is silent", async (t) => {
  const { clock, motion, sent } = begin(t);
  motion.publish([0.5, 0], WORKSHOP);
  motion.end();
  await clock.pass(500);
  assert.deepEqual(sent, [[0.5, 0], [0, 0]]);
});
