// What a program in the page may import: the nodes in tests/nodes print there what they print with ROS
// (tests/ros/test_nodes.py).

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

import { FILES } from "#www/python/modules/list.js";

import { runPython } from "./micropython.js";

const NODES = new URL("../nodes/", import.meta.url);
const MODULES = new URL("../../morbot_ws/src/jetbot_cockpit/www/python/modules/", import.meta.url);
const ROBOT = { pose: [1, 2, 0.5], line: [0.25, 0.5, 1], wheels: [0.25, 0.5], command: [0.375, 0.125] };

// Returns the lines of a node's last comment: what it prints.
const expected = (text) => text.split("\n").filter((line) => line.startsWith("#>")).map((line) => line.slice(3));

for (const file of readdirSync(NODES).filter((name) => name.endsWith(".py"))) {
  test(`${file} prints what it prints with ROS`, async () => {
    const text = readFileSync(new URL(file, NODES), "utf8");
    const { lines, error } = await runPython(text, { senses: ROBOT, perLine: 1e-5 });
    assert.equal(error, "");
    assert.deepEqual(lines.map((line) => line.trimEnd()), expected(text));
  });
}

test("each file of the modules is sent to a page", () => {
  const files = readdirSync(MODULES, { recursive: true }).filter((name) => name.endsWith(".py"));
  assert.deepEqual(files.sort(), [...FILES].sort());
});
