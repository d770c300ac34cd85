// What a screen reader says of the robot's status.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./dom.js";

import { showStatus } from "#www/status.js";
import { World } from "#www/world.js";

const [ME, BEN] = [{ id: 1, name: "Ada" }, { id: 2, name: "Ben" }];
const RED = { id: "/red", label: "red", color: "#808080", workshop: true, wheel_separation: 2, max_speed: 1,
  simulated: true };
const body = { classList: { toggle() {} } };
Object.assign(document, { body });
document.documentElement.style = { setProperty() {} };

// Returns whether a change to this state of the robot, or of the connection, is said.
function isSaid(state, problem = "") {
  const [world, attributes] = [new World(), {}];
  Object.assign(world, { me: { ...ME, role: "pupil", robot: null }, chosen: "/red" });
  world.list({ robots: [RED] });
  const known = { ...world.state(null), answers: true, warning: false, cause: "", programs: 0, ...state };
  world.update({ emergency: false, pupils_release: false, robots: { "/red": known } });
  Object.assign(document.getElementById("status"), {
    dataset: {}, setAttribute: (name, value) => { attributes[name] = value; },
  });
  showStatus(world, problem);
  return attributes["aria-live"] !== "off";
}

const DRIVES = { state: "driving" };
const ZERO = { state: "stopped", cause: "zero" };

test("what a person's own hand does is not said at each press", () => {
  for (const state of [DRIVES, ZERO]) assert.ok(!isSaid({ ...state, driver: ME }));
});

test("all else that happens to the robot is said, also while the person drives", () => {
  for (const state of [DRIVES, ZERO]) assert.ok(isSaid({ ...state, driver: BEN }));
  const others = { board: {}, emergency_stop: { stopped: true }, zero: { warning: true }, "": { answers: false } };
  for (const [cause, more] of Object.entries(others)) {
    assert.ok(isSaid({ ...DRIVES, cause, ...more, driver: ME }), cause);
  }
  assert.ok(isSaid({ ...DRIVES, driver: ME }, "No connection."));
});
