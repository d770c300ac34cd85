// Which part of the floor the map shows by itself: the robot in the middle, or the whole course of its task.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import "./dom.js";

import { RobotMap } from "#www/map.js";
import { World } from "#www/world.js";

const COURSE = [{ kind: "course", width: 0.01, points: [[0, 0], [1, 0]] }];
const hands = {}; // what a person does, by element and event
let world = null, map = null;

globalThis.ResizeObserver = class {
  observe() {}
};

function field(id) {
  return Object.assign(document.getElementById(id), {
    clientWidth: 400, clientHeight: 300, offsetHeight: 0, setPointerCapture() {}, setAttribute() {},
    addEventListener: (type, call) => { hands[`${id} ${type}`] = call; },
  });
}

function report(state, task = null) {
  const red = { ...world.state(null), programs: 0, pose: [0, 0, 0], state, task: task && { state: task } };
  world.update({ emergency: false, pupils_release: false, robots: { "/red": red } });
  map.update();
}

// The robot's scene arrives.
function draw(shapes) {
  if (world.scene({ robot: "/red", shapes })) map.showCourse("/red");
}

beforeEach(() => {
  world = new World();
  world.chosen = "/red";
  for (const id of ["tools", "legend", "zoom-in", "zoom-out", "fit", "follow"]) field(id);
  map = new RobotMap(field("map"), world, { choose() {}, redraw() {} });
  report("stopped");
  draw(COURSE);
  report("driving", "driving");
});

test("the map shows the whole course while its task is driven, and at its end", () => {
  report("stopped", "done");
  assert.ok(!map.following);
  assert.equal(map.viewport.x, 0.5);
});

const removed = () => draw([]);
for (const [what, acts, state, following] of [ // what a person does, or what comes; the last state
  ["follows the robot again when that drives on after its task", [], "driving", true],
  ["follows the robot again when the course is gone", [removed], "stopped", true],
  ["that a person drags stays as it is", [() => map.viewport.drag(50, 0), removed], "driving", false],
  ["that a person zooms stays as it is", [() => hands["zoom-in click"](), removed], "driving", false],
  ["that shows all, as a person wants it, stays as it is", [() => hands["fit click"](), removed], "driving", false],
]) {
  test(`a map ${what}`, () => {
    for (const act of acts) act();
    report(state, state === "driving" ? "done" : null);
    assert.equal(map.following, following);
  });
}
