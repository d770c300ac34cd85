// What a teacher does about the robots of a class, and what a page says of one that is out of reach.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./dom.js";

import { batteryOf } from "#www/health.js";
import { toDo } from "#www/to_do.js";
import { World } from "#www/world.js";

const row = (code, level, values = {}) => ({ code, level, template: "Look.", arguments: values });

// states: of each robot, with its version
function classOf(...states) {
  const world = new World();
  const ids = states.map((_, index) => `/jetbot_0${index + 1}`);
  world.me = { id: 1, name: "", role: "teacher", robot: null };
  world.list({ robots: ids.map((id, index) => ({
    id, label: id.slice(1), version: states[index].version ?? "1.2.0", address: "http://10.0.0.1:8080/",
  })) });
  world.update({ emergency: false, unconfirmed: [], pupils_release: false,
    robots: Object.fromEntries(ids.map((id, index) => [id, { ...world.state(null), ...states[index] }])) });
  return world;
}

test("the robots to charge come first, and each kind of trouble has one line", () => {
  const [low, weak] = [row("battery", "warning", { percent: "33" }), row("wifi", "bad")];
  const world = classOf({ health: [weak] }, { health: [low] }, { health: [row("battery", "ok")] },
    { health: [low, weak, row("input", "warning"), row("undervoltage", "warning")] }, { health: null });
  assert.deepEqual(toDo(world), ["Charge before the lesson: jetbot_02, jetbot_04", "Weak supply: jetbot_04",
    "Weak Wi-Fi: jetbot_01, jetbot_04"]);
});

test("trouble that this page does not know yet is no reason to fail", () => {
  assert.deepEqual(toDo(classOf({ health: [row("new", "bad")] })), []);
});

test("robots with another version than most are named; one that has not said its version is not", () => {
  const states = ["1.2.0", "1.1.0", "1.2.0", ""].map((version) => ({ version }));
  assert.deepEqual(toDo(classOf(...states)), ["Other version: jetbot_02"]);
  assert.deepEqual(toDo(classOf(states[0], states[2])), []);
});

test("the charge is that of the battery, or not known", () => {
  const full = row("battery", "ok", { percent: "86" });
  assert.equal(batteryOf({ health: [row("disk", "ok"), full] }), "86 %");
  for (const health of [null, [], [row("disk", "ok")]]) assert.equal(batteryOf({ health }), "");
});

test("a robot out of reach has its reason, and is never shown as stopped", () => {
  const away = { answers: false, state: "", status: "" };
  const world = classOf(away, { ...away, template: "{robot} has another key.", arguments: { robot: "jetbot_02" } });
  world.update({ emergency: true, unconfirmed: [], pupils_release: false, robots: world.states });
  assert.deepEqual(world.summarize("/jetbot_01"), { level: "away",
    text: "jetbot_01 is out of reach. Driven from here, it stops by itself within 0.3 s." });
  assert.match(world.summarize("/jetbot_02").text, /^jetbot_02 has another key\. Driven from here/);
});
