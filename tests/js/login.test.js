// What a person wants to be called.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./dom.js";

import { NameField } from "#www/login.js";
import { World } from "#www/world.js";

const RED = { id: "/red", label: "red", color: "#808080", workshop: true, wheel_separation: 2, max_speed: 1,
  simulated: true };

// Returns whether the name that a pupil may type is hidden, where the teacher has named this robot's pupil so.
function hides(robot, pupil) {
  const [world, field] = [new World(), document.getElementById("name")];
  field.addEventListener = () => {};
  const name = new NameField(world, () => true);
  world.me = { id: 1, name: "pupil 1", role: "pupil", robot };
  world.list({ robots: [{ ...RED, pupil }] });
  name.show();
  return field.hidden;
}

test("who is named by a teacher is not asked for a name, everybody else is", () => {
  for (const [robot, pupil, hidden] of [["/red", "Ada", true], ["/red", "", false], [null, "Ada", false]]) {
    assert.equal(hides(robot, pupil), hidden);
  }
});

test("who types a name just when the teacher gives one can end that: the next letters do not drive", () => {
  document.activeElement = document.getElementById("name");
  assert.equal(hides("/red", "Ada"), false);
  document.activeElement = null;
  assert.equal(hides("/red", "Ada"), true);
});
