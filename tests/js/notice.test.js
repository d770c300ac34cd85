// The sentence that the page has for the person is shown for a while, and no longer than it is true.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Notice } from "#www/notice.js";
import { holds } from "#www/refusals.js";
import { World } from "#www/world.js";

import { Clock } from "./clock.js";
import "./dom.js";

const RED = { id: "/red", label: "red", color: "#808080", workshop: true, wheel_separation: 2, max_speed: 1,
  simulated: true };
const BOB = { id: 2, name: "Bob" };
let world = null, drives = false; // this page

function report(state, { emergency = false, robots = [RED] } = {}) {
  world.list({ robots });
  const known = { ...world.state(null), programs: 0, ...state };
  world.update({ emergency, pupils_release: false, robots: { "/red": known } });
}

beforeEach(() => {
  world = new World();
  world.me = { id: 1, name: "Ada", role: "pupil", robot: null };
  world.chosen = "/red";
  drives = false;
  report({});
});

test("a notice that is always true is shown for 6 s", async (t) => {
  const clock = new Clock(t);
  const notice = new Notice();
  notice.show("Only a teacher can put robots back.");
  await clock.pass(5900);
  notice.update();
  assert.ok(notice.visible);
  await clock.pass(200);
  assert.ok(!notice.visible);
});

const ONCE_DRIVEN = [() => {}, () => { drives = true; }];
const REFUSALS = { // the state in which the cockpit refuses it, and one in which it does not any more
  all_stopped: [() => report({}, { emergency: true })],
  stopped: [() => report({ stopped: true })],
  no_answer: [() => report({ answers: false })],
  driven: [() => report({ driver: BOB })],
  judge_driven: [() => report({ driver: BOB })],
  judged_elsewhere: [() => report({ task: { state: "ready" } }), () => report({ task: { state: "done" } })],
  taken: [() => report({ held: "robot" })],
  ended: [() => report({}, { robots: [] })],
  teacher_releases: [() => report({}, { emergency: true })],
  not_stopped: [() => report({}), () => report({ stopped: true })],
  others_stopped: [() => report({ stopped: true })],
  driver_collects: [() => report({}), () => report({ driver: { id: 1, name: "Ada" } })],
  let_go: ONCE_DRIVEN, no_command: ONCE_DRIVEN, interrupted: ONCE_DRIVEN, put_back: ONCE_DRIVEN,
};

for (const [code, [begin, end = () => report({})]] of Object.entries(REFUSALS)) {
  test(`a notice goes as soon as its cause is over, also if the state came a little later: ${code}`, (t) => {
    new Clock(t);
    const notice = new Notice();
    notice.show("Why", () => holds(code, world, "/red", drives));
    for (const report of [() => {}, begin]) {
      report();
      notice.update();
      assert.ok(notice.visible);
    }
    end();
    notice.update();
    assert.ok(!notice.visible);
  });
}
