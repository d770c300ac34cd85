// What the page knows of the robots, and what it says about them.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { World } from "#www/world.js";

import "./dom.js";

const LIMITS = { trail: 3, trail_step: 0.01 };
const robot = (name, more = {}) => ({ id: `/${name}`, label: name, color: "#808080", ...more });
let world = null;

// Takes the states of robots, as far as they are not those of a robot that waits.
function report(states, more = {}) {
  const waiting = { ...world.state(null), status: "waiting for commands", state: "stopped" };
  const robots = Object.entries(states).map(([name, state]) => [`/${name}`, { ...waiting, ...state }]);
  world.update({ emergency: false, pupils_release: false, robots: Object.fromEntries(robots), ...more });
}

function login(role, own = null) {
  world.hello({ type: "hello", id: 1, name: "Ada", role, robot: own, codes: false, limits: LIMITS });
}

beforeEach(() => {
  world = new World();
  login("pupil");
  world.list({ robots: [robot("red"), robot("blue")] });
  world.chosen = "/red";
});

test("a pupil with a robot of its own chooses that one only; everybody else chooses from all", () => {
  assert.deepEqual(world.allowed.map(({ label }) => label), ["red", "blue"]);
  login("pupil", "/blue");
  world.list({ robots: [robot("red"), robot("blue")] });
  assert.deepEqual(world.allowed.map(({ label }) => label), ["blue"]);
});

test("robots that come and go are named, or counted if they are many; the first list is no news", () => {
  assert.equal(world.list({ robots: [robot("red")] }), "blue is not running any more.");
  assert.deepEqual(world.missing.map(({ label }) => label), ["blue"]);
  assert.equal(world.list({ robots: [robot("red"), robot("blue"), robot("tom")] }), "2 robots are running.");
  assert.deepEqual(world.missing, []);
  assert.equal(world.list({ robots: [robot("red"), robot("blue"), robot("tom")] }), "");
  login("pupil");
  assert.equal(world.list({ robots: [robot("red")] }), "");
});

test("a trail keeps its newest points, and none of a robot that stands", () => {
  for (const x of [0, 0.001, 1, 2, 3]) report({ red: { pose: [x, 0, 0] } });
  assert.deepEqual(world.trails.get("/red"), [[1, 0], [2, 0], [3, 0]]);
});

test("a robot's start is where it was seen first, or was put, and that of the cockpit where it is known", () => {
  const goal = { kind: "goal", width: 0.1, points: [[1, 0], [1.1, 0]] };
  const start = () => world.placeOf("/red").start;
  assert.equal(start(), undefined);
  for (const x of [1, 2]) report({ red: { pose: [x, 0, 3] }, blue: { pose: [0, 0, 0] } });
  assert.deepEqual(start(), [1, 0, 3]);
  world.trail({ type: "trail", robot: "/red", start: [0, 0, 0.5], points: [] });
  report({ red: { pose: [9, 0, 0] }, blue: { pose: [0, 0, 0] } });
  world.scene({ robot: "/red", shapes: [goal] });
  assert.deepEqual(world.placeOf("/red"), { pose: [9, 0, 0], start: [0, 0, 0.5], goal: [1, 0], others: 1 });
  login("pupil");
  assert.equal(start(), undefined, "a new connection tells it again");
});

test("a robot that has gone leaves no trail and no walls on the map", () => {
  report({ blue: { pose: [1, 1, 0] } });
  world.scene({ robot: "/blue", shapes: [{ kind: "wall", width: 0.01, points: [[0, 0], [1, 0]] }] });
  world.list({ robots: [robot("red")] });
  assert.deepEqual([world.trails.size, world.starts.size, world.pointsOf("/blue")], [0, 0, []]);
});

test("the page learns when a robot's course is another one, and draws no shape that it does not know", () => {
  const course = { kind: "course", width: 0.01, points: [[0, 0], [1, 0]] };
  const shapes = [course, { kind: "wall", width: 0.01, points: [[2, 2]] }, { kind: "constructor", points: [[9, 9]] }];
  assert.equal(world.scene({ robot: "/red", shapes }), true);
  assert.equal(world.scene({ robot: "/red", shapes: [course] }), false);
  assert.equal(world.scene({ robot: "/red", shapes }), false);
  assert.deepEqual(world.pointsOf("/red"), [[0, 0], [1, 0], [2, 2]]);
});

test("what the names of a class begin with is left out, if only numbers follow", () => {
  const name = (...labels) => {
    world.list({ robots: labels.map((label) => robot(label)) });
    return world.commonName;
  };
  assert.equal(name("jetbot_01", "jetbot_02"), "jetbot_");
  assert.deepEqual([name("red", "blue"), name("jetbot_01", "red_01"), name("jetbot_01"), name()], ["", "", "", ""]);
});

const TAKEN = "Your teacher has taken red. Wait until a teacher presses Go on.";
const SUMMARIES = [ // the state of the robot, whether all are stopped; what is said, and how urgent that is
  [{ status: "driving", state: "driving" }, false, "driving", "driving"],
  [{ status: "no commands", state: "stopped" }, false, "no commands", "waiting"],
  [{ status: "battery low", warning: true }, false, "battery low", "warning"],
  [{ status: "" }, false, "waiting for its status", "waiting"],
  [{ status: "red does not answer. Restart it, or resume it with fg.", answers: false }, false,
    "red does not answer. Tell your teacher.", "warning"],
  [{ status: "stopped: no answer at 0x60", stopped: true, cause: "board" }, false,
    "stopped: its motor board cannot be reached. Tell your teacher.", "stopped"],
  [{ status: "stopped: no command for 1.0 s (repeat it: rostopic pub -r 10)", cause: "no_command" }, false,
    "stopped: no more commands came", "waiting"],
  [{ status: "stopped: its terminal is suspended (Ctrl-Z); fg resumes it", cause: "suspended", warning: true }, false,
    "stopped: it is paused at its computer. Tell your teacher.", "warning"],
  [{ status: "stopped: made up", cause: "constructor" }, false, "stopped: made up", "waiting"],
  [{ status: "driving", stopped: true }, false, "stopped: emergency stop", "stopped"],
  [{ status: "stopped: its own emergency stop", stopped: true, cause: "own_emergency_stop" }, false,
    "stopped: by your teacher", "stopped"],
  [{ status: "driving" }, true, "Your teacher stopped all robots.", "stopped"],
  [{ status: "driving", held: "robot" }, false, TAKEN, "stopped"],
];

for (const [state, emergency, text, level] of SUMMARIES) {
  test(`a pupil reads "${text}", as ${level}`, () => {
    report({ red: state }, { emergency });
    assert.deepEqual(world.summarize("/red"), { text, level });
  });
}

test("a teacher reads the status itself, which helps at a terminal", () => {
  login("teacher");
  world.list({ robots: [robot("red")] });
  report({ red: { status: "fg resumes it", cause: "suspended" } });
  assert.equal(world.summarize("/red").text, "fg resumes it");
  report({ red: { answers: false } });
  assert.equal(world.summarize("/red").text, "red does not answer. Restart it, or resume it with fg.");
});

const ADA = { id: 1, name: "Ada" };
const BOB = { id: 2, name: "Bob" };
const DRIVERS = [ // the state of the robot; what is said, and whether this page can drive
  [{}, "Free to drive: drag the pad", true],
  [{ driver: ADA }, "You drive it", true],
  [{ driver: BOB }, "Bob drives it", false],
  [{ state: "driving" }, "A program drives. Take the pad to drive.", true],
  [{ state: "driving", program: "/zigzag" }, "/zigzag drives. Take the pad to drive.", true],
  [{ resumes: 3 }, "The program drives on in 3 s", true],
  [{ held: "robot" }, "Pupils and programs wait until a teacher presses Go on", false],
  [{ held: "programs", waiting: ["/zigzag"] }, "The program waits until a teacher presses Go on", true],
  [{ held: "programs" }, "Free to drive: drag the pad", true],
  [{ stopped: true }, "Nobody drives it", false],
  [{ answers: false, state: "driving" }, "Nobody drives it", false],
];

for (const [state, text, free] of DRIVERS) {
  test(`of the driver a pupil reads "${text}": ${JSON.stringify(state)}`, () => {
    report({ red: state });
    assert.equal(world.describeDriver("/red"), text);
    assert.equal(!world.isBlocked("/red"), free);
  });
}

const STOP = { emergency: true };
const blocked = () => world.isBlocked("/red"), waits = () => world.mustWait, takes = () => world.mayTake("/red");
for (const [what, role, ask, state, more, expected] of [
  ["drives what a teacher holds", "teacher", blocked, { held: "robot" }, {}, false],
  ["does not drive while all robots are stopped", "teacher", blocked, {}, STOP, true],
  ["waits for the teacher's release", "pupil", waits, {}, { ...STOP, pupils_release: false }, true],
  ["releases what the pupil stopped alone", "pupil", waits, {}, { ...STOP, pupils_release: true }, false],
  ["waits while the robot is stopped", "pupil", waits, { stopped: true }, {}, true],
  ["waits for nobody's release", "teacher", waits, { stopped: true }, STOP, false],
  ["takes a robot from its driver", "teacher", takes, { driver: BOB }, {}, true],
  ["takes a robot from a program", "teacher", takes, { program: "/zigzag" }, {}, true],
  ["takes a robot from what is about to drive", "teacher", takes, { resumes: 2 }, {}, true],
  ["takes a robot that is driven", "teacher", takes, { state: "driving" }, {}, true],
  ["takes no robot from itself", "teacher", takes, { driver: ADA }, {}, false],
  ["takes no robot from nobody", "teacher", takes, {}, {}, false],
  ["takes no robot that it holds", "teacher", takes, { held: "robot", program: "/zigzag" }, {}, false],
]) {
  test(`a ${role} ${what}`, () => {
    login(role);
    report({ red: state }, more);
    assert.equal(ask(), expected);
  });
}

for (const [what, own, robots, sentence] of [
  ["their own, while others run", "/red", ["blue"], "red is not running. This page shows it as soon as it runs."],
  ["any", null, [], "No robot is running. This page shows it as soon as it runs."],
]) {
  test(`a person reads that a robot does not run only once the list has come, after each connection: ${what}`, () => {
    const world = new World();
    const hello = { id: 1, name: "Ada", role: "pupil", robot: own, limits: LIMITS };
    assert.equal(world.status.text, "Connecting");
    for (let connection = 0; connection < 2; connection += 1) {
      world.hello(hello);
      assert.equal(world.status.text, "Connecting");
      world.list({ robots: robots.map((name) => robot(name)) });
      assert.equal(world.status.text, sentence);
    }
  });
}
