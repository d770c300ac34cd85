// After STOP, the page names what has not confirmed it, for as long as that is so.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Clock } from "./clock.js";
import "./dom.js";
import { play } from "./steps.js";

import { Stops } from "#www/stops.js";
import { World } from "#www/world.js";

const IDS = ["/jetbot_01", "/jetbot_02", "/jetbot_03"];
let world = null, stops = null;

for (const id of ["stop", "release", "unconfirmed", "notice"]) {
  Object.assign(document.getElementById(id), {
    addEventListener() {}, textContent: "", classList: { toggle() {} }, hidden: true,
  });
}
document.body = { classList: { toggle() {} } };

beforeEach(() => {
  world = new World();
  world.list({ robots: IDS.map((id) => ({ id, label: id.slice(1) })) });
  document.getElementById("unconfirmed").hidden = true;
  stops = new Stops(world, { send: () => true, lost: () => false, notice: { show() {} }, stopped() {} });
});

const press = () => stops.stop(), release = () => stops.release();
const list = (count) => () => world.list({ robots: world.robots.slice(0, count) });
const report = (unconfirmed = [], emergency = true) => () => {
  world.update({ emergency, unconfirmed, pupils_release: false, robots: {} });
  stops.update();
};
const sees = (sentence) => () => {
  stops.show();
  const { hidden, textContent } = document.getElementById("unconfirmed");
  assert.equal(hidden ? "" : textContent, sentence);
};

const [ONE, TWO, THREE] = IDS;
const lacks = (stopped, names) => `Stopped: ${stopped} of 3. Not confirmed: ${names}. Use their own switches.`;
const ALONE = "The stop is not confirmed yet. Press again, or use the robot's own switch.";
const SOMEBODY = Object.entries({ // stops: the robots in the list, who does not confirm, what a person reads
  "a stop by somebody else is named, too": [3, TWO, lacks(2, "jetbot_02")],
  "a robot that is not in the list any more counts, and is named": [2, THREE, lacks(2, "jetbot_03")],
  "one robot alone needs no number": [1, ONE, ALONE],
}).map(([what, [count, id, sentence]]) => [what, [list(count), report([id]), sees(""), 1100, sees(sentence), report(),
  sees(""), report([id]), sees(sentence)]]); // it comes back during the stop

const TESTS = {
  "who has not confirmed the stop a second after it is named until they have": [
    press, report(IDS), 900, report([TWO, THREE]), sees(""), 200, sees(lacks(1, "jetbot_02, jetbot_03")), 3_600_000,
    report([THREE]), sees(lacks(2, "jetbot_03")), report(), sees("")],
  "the sentence stays when somebody presses again, and goes with the release": [
    press, report([THREE]), 1100, press, sees(lacks(2, "jetbot_03")), release, report([], false), sees("")],
  "a cockpit that does not confirm is reported until it does, though it is released at once": [
    press, 1100, sees(ALONE), report(), sees(""), press, report(), report([], false), 1100, sees("")],
  ...Object.fromEntries(SOMEBODY),
};
for (const [what, steps] of Object.entries(TESTS)) test(what, (t) => play({ clock: new Clock(t) }, steps));

test("a robot that has not confirmed the stop is not shown as stopped", () => {
  const holds = { ...world.state(null), holds: ["emergency_stop"], state: "stopped", programs: 0 };
  world.update({ emergency: true, unconfirmed: ["/jetbot_02"], pupils_release: false,
    robots: Object.fromEntries(IDS.map((id) => [id, holds])) });
  world.me = { id: 1, name: "", role: "teacher", robot: null };
  assert.deepEqual(IDS.map((id) => world.summarize(id).level), ["stopped", "warning", "stopped"]);
});
