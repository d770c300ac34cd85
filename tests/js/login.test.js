// What a person wants to be called.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./dom.js";

import { NameField } from "#www/login.js";
import { World } from "#www/world.js";

const RED = { id: "/red", label: "red", color: "#808080", workshop: true, wheel_separation: 2, max_speed: 1,
  simulated: true };

test("who is named by a teacher is not asked for a name, everybody else is", () => {
  const [world, field] = [new World(), document.getElementById("name")];
  field.addEventListener = () => {};
  const name = new NameField(world, () => true);
  for (const [robot, pupil, hidden] of [["/red", "Ada", true], ["/red", "", false], [null, "Ada", false]]) {
    world.me = { id: 1, name: "pupil 1", role: "pupil", robot };
    world.list({ robots: [{ ...RED, pupil }] });
    name.show();
    assert.equal(field.hidden, hidden);
  }
});
