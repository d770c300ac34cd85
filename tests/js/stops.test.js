// After STOP, the page names what has not confirmed it, for as long as that is so.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Clock } from "./clock.js";
import "./dom.js";

import { Stops } from "#www/stops.js";
import { World } from "#www/world.js";

const IDS = ["/jetbot_01", "/jetbot_02", "/jetbot_03"];
let [world, stops, sent, connected] = /** @type {any[]} */ ([]);

for (const id of ["stop", "release", "unconfirmed", "notice"]) {
  Object.assign(document.getElementById(id), {
    addEventListener() {}, textContent: "", classList: { toggle() {} }, hidden: true,
  });
}
document.body = { classList: { toggle() {} } };

function shown() {
  stops.show();
  const { hidden, textContent } = document.getElementById("unconfirmed");
  return hidden ? "" : textContent;
}

function report({ emergency = true, unconfirmed = [] } = {}) {
  world.update({ emergency, unconfirmed, pupils_release: false, robots: {} });
  stops.update();
}

beforeEach(() => {
  [world, sent, connected] = [new World(), [], true];
  world.list({ robots: IDS.map((id) => ({ id, label: id.slice(1) })) });
  document.getElementById("unconfirmed").hidden = true;
  const send = (message) => connected && sent.push(message);
  stops = new Stops(world, { send, lost: () => !connected, notice: { show() {} }, stopped() {} });
});

test("who has not confirmed the stop a second after it is named until they have", async (t) => {
  const clock = new Clock(t);
  stops.stop();
  report({ unconfirmed: IDS });
  await clock.pass(900);
  report({ unconfirmed: IDS.slice(1) });
  assert.equal(shown(), "", "they confirm one after the other");
  await clock.pass(200);
  assert.equal(shown(), "Stopped: 1 of 3. Not confirmed: jetbot_02, jetbot_03. Use their own switches.");
  await clock.pass(3_600_000);
  report({ unconfirmed: IDS.slice(2) });
  assert.equal(shown(), "Stopped: 2 of 3. Not confirmed: jetbot_03. Use their own switches.");
  report();
  assert.equal(shown(), "");
});

test("the sentence stays when somebody presses again, and goes with the release", async (t) => {
  const clock = new Clock(t);
  stops.stop();
  report({ unconfirmed: ["/jetbot_03"] });
  await clock.pass(1100);
  stops.stop();
  assert.match(shown(), /jetbot_03/);
  stops.release();
  report({ emergency: false });
  assert.equal(shown(), "");
});

for (const [what, listed, unconfirmed, sentence] of [
  ["a stop by somebody else is named, too", 3, "/jetbot_02",
    "Stopped: 2 of 3. Not confirmed: jetbot_02. Use their own switches."],
  ["a robot that is not in the list any more counts, and is named", 2, "/jetbot_03",
    "Stopped: 2 of 3. Not confirmed: jetbot_03. Use their own switches."],
  ["one robot alone needs no number", 1, "/jetbot_01",
    "The stop is not confirmed yet. Press again, or use the robot's own switch."],
]) {
  test(what, async (t) => {
    const clock = new Clock(t);
    world.list({ robots: world.robots.slice(0, listed) });
    report({ unconfirmed: [unconfirmed] });
    assert.equal(shown(), "");
    await clock.pass(1100);
    assert.equal(shown(), sentence);
    report();
    assert.equal(shown(), "");
    report({ unconfirmed: [unconfirmed] });
    assert.equal(shown(), sentence, "it comes back during the stop");
  });
}

test("a cockpit that does not confirm is reported until it does, though it is released at once", async (t) => {
  const clock = new Clock(t);
  stops.stop();
  await clock.pass(1100);
  assert.match(shown(), /not confirmed yet/);
  report();
  assert.equal(shown(), "");
  stops.stop();
  report();
  report({ emergency: false });
  await clock.pass(1100);
  assert.equal(shown(), "");
});

test("a robot that has not confirmed the stop is not shown as stopped", () => {
  const holds = { ...world.state(null), holds: ["emergency_stop"], state: "stopped", programs: 0 };
  world.update({ emergency: true, unconfirmed: ["/jetbot_02"], pupils_release: false,
    robots: Object.fromEntries(IDS.map((id) => [id, holds])) });
  world.me = { id: 1, name: "", role: "teacher", robot: null };
  assert.deepEqual(IDS.map((id) => world.summarize(id).level), ["stopped", "warning", "stopped"]);
});
