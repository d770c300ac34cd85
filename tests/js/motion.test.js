// What a program's commands become on their way to the cockpit.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Motion } from "#www/program/motion.js";

import { Clock } from "./clock.js";
import { play, sight } from "./steps.js";

const WORKSHOP = { wheel_separation: 2, max_speed: 1 };

function begin(t) {
  const clock = new Clock(t);
  const sent = [];
  const motion = new Motion((...command) => sent.push(command));
  motion.begin();
  return { clock, motion, sent };
}

const publish = (...command) => ({ motion }) => motion.publish(command, WORKSHOP);
const set = (...commands) => ({ motion }) => commands.forEach((forward) => motion.set(forward, 0));
const end = ({ motion }) => motion.end();
const sees = sight({ last: ({ sent }) => sent.at(-1), command: ({ motion }) => motion.command });
const changesIn = (ms) => ({ motion, clock }) => { motion.changesAt = clock.now + ms; };

const TESTS = {
  "a command is repeated 20 times per second": [
    publish(0.5, 0.25), 500, sees({ sent: Array(11).fill([0.5, 0.25]) })],
  "a program that publishes nothing for a second stops the robot": [publish(0.5, 0), 1100, sees({ last: [0, 0] })],
  "a wheel gets full power at most": [publish(3, 0), sees({ sent: [[1, 0]] })],
  "a command that is not finite stops the robot, as in its controller": [
    publish(0.5, 0), publish(Infinity, 0), sees({ command: [0, 0] }), publish(0.5, 0), publish(0, NaN),
    sees({ command: [0, 0] })],
  "short pulses are not more than the cockpit takes, and end with a stop": [
    ...Array(100).fill(set(1, 0)), ({ sent: { length } }) => assert.ok(length >= 2 && length < 20, String(length)),
    sees({ last: [0, 0] })],
  "a stop is sent at once, whatever was sent before": [
    set(...Array.from({ length: 50 }, (_, index) => (index + 1) / 100), 0), sees({ last: [0, 0] })],
  "a command that changes at once is not repeated before": [
    publish(0.5, 0), 40, changesIn(12), 12, publish(0.2, 0), sees({ sent: [[0.5, 0], [0.2, 0]] })],
  "a program that has ended has stopped the robot, and is silent": [
    publish(0.5, 0), end, 500, sees({ sent: [[0.5, 0], [0, 0]] })],
};
for (const [what, steps] of Object.entries(TESTS)) test(what, (t) => play(begin(t), steps));

test("a limit is in the robot's own units", (t) => {
  const { motion, sent } = begin(t);
  motion.publish([0.3, 4], { wheel_separation: 0.1, max_speed: 0.5 });
  assert.deepEqual(sent[0].map((each) => each.toFixed(6)), ["0.600000", "0.400000"]); // wheels: 0.2 and 1
});
