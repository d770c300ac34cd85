// The map in words.

import assert from "node:assert/strict";
import { test } from "node:test";

import { describePlace, describeSteering } from "#www/place.js";

const START = [0, 0, 0];
const QUARTER = Math.PI / 2;
const WAYS = ["ahead", "ahead and left", "left", "back and left", "back", "back and right", "right", "ahead and right"];

function say(pose, more = {}) {
  return describePlace({ pose, start: START, others: 0, ...more });
}

test("where the robot is from its start, in tenths of a metre", () => {
  const places = {
    "The robot is at its start.": [0.04, -0.04],
    "The robot is 0.4 m ahead of its start.": [0.42, 0],
    "The robot is 0.1 m behind its start.": [-0.051, 0.049],
    "The robot is 12.0 m to the left of its start.": [0, 12],
    "The robot is 0.3 m to the right of its start.": [0, -0.3],
    "The robot is 0.4 m ahead of its start and 0.1 m to the left.": [0.4, 0.1],
    "The robot is 0.4 m ahead of its start and 0.1 m to the right.": [0.4, -0.1],
    "The robot is 0.4 m behind its start and 0.1 m to the left.": [-0.4, 0.1],
    "The robot is 0.4 m behind its start and 0.1 m to the right.": [-0.4, -0.1],
  };
  for (const [sentence, place] of Object.entries(places)) {
    assert.equal(say([...place, 0]), `${sentence} It faces ahead.`);
  }
});

test("ahead and left are those of the robot as it started, wherever that was", () => {
  assert.equal(say([5, 5.4, 2 * QUARTER], { start: [5, 5, QUARTER] }),
    "The robot is 0.4 m ahead of its start. It faces left.");
});

test("where it faces, in eighths of a turn, however often it has turned", () => {
  for (const turns of [-3, 0, 2]) {
    WAYS.forEach((heading, eighths) => [-0.3, 0, 0.3].forEach((off) => {
      const yaw = turns * 4 * QUARTER + eighths * QUARTER / 2 + off;
      assert.ok(say([0, 0, yaw]).endsWith(` It faces ${heading}.`), `${yaw} is ${heading}`);
    }));
  }
});

test("how far the goal is, if there is one, and how many others there are", () => {
  assert.ok(say([0.4, 0.4, 0], { goal: [0.7, 0] }).endsWith(" The goal is 0.5 m away."));
  assert.ok(say([0, 0, 0], { others: 1 }).endsWith(" ahead. 1 other robot is on the map."));
  assert.ok(say([0, 0, 0], { goal: [0, 0], others: 14 })
    .endsWith(" The goal is 0.0 m away. 14 other robots are on the map."));
});

test("a robot without odometry, or none at all, has no place that is known", () => {
  for (const place of [{ pose: null }, { pose: START, start: null }, { pose: START, start: undefined }]) {
    assert.equal(describePlace({ start: START, others: 2, ...place }), "The robot's place is not known.");
  }
});

test("where the pad is, as a person would say it, and nothing when it is released", () => {
  const commands = [[1, 0], [0.5, 0.5], [0.1, 1], [-1, 1], [-0.2, 0.01], [-1, -1], [0, -1], [1, -1]];
  assert.deepEqual(commands.map(describeSteering), WAYS.map((way) => `You steer ${way}.`));
  assert.equal(describeSteering([0, 0]), "");
});
