// One run of a program, with its robot and its clock.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Run } from "#www/program/run.js";

import { Clock } from "./clock.js";
import { block, forever, plug, print, program } from "./programs.js";

const ROBOT = { id: "/red", wheel_separation: 2, max_speed: 1 };
const drive = (X, SECONDS) => block("robot_drive", { X, SECONDS });
const ZERO = { type: "drive", robot: "/red", forward: 0, left: 0 };

// Runs a program, whose robot answers at once, on a page that shows what it prints and why it has ended.
async function begin(t, json, { stepping = false, delay = 0, ready = true } = {}) {
  const page = { clock: new Clock(t), sent: [], prints: [], ends: [] };
  page.run = new Run(json, ROBOT, stepping, {
    send: (message) => (message.type === "program" ? answer(page, ready) : page.sent.push(message)),
    printed: (text) => page.prints.push(text), changed() {}, delay: () => delay,
    ended: (...why) => page.ends.push(why),
  });
  await page.clock.pass(60);
  return page;
}

function answer(page, ready) {
  setTimeout(() => page.run.senses.receive({ type: "program", ready, pose: [0, 0, 0], line: null, wheels: [0, 0] }));
}

const speeds = ({ sent }) => sent.map(({ forward }) => forward);

test("a program begins and ends with a stop, and drives for as long as it says", async (t) => {
  const page = await begin(t, program([drive(0.5, 1), print("done")]));
  await page.clock.pass(900);
  assert.deepEqual(page.ends, []);
  await page.clock.pass(200);
  assert.deepEqual([page.ends, page.prints], [[["", null]], ["done"]]);
  const [first, ...others] = speeds(page);
  assert.deepEqual([first, others.at(-1)], [0, 0]);
  assert.ok(others.filter((speed) => speed === 0.5).length >= 20);
});

test("nothing moves before the robot's controller is connected; a program whose robot never is says so", async (t) => {
  const page = await begin(t, program([drive(0.5, 1)]), { ready: false });
  await page.clock.pass(3800);
  assert.deepEqual(page.ends, []);
  await page.clock.pass(300);
  assert.deepEqual(page.ends, [["The robot is not connected to the cockpit. Start its controller again.", null]]);
  assert.ok(page.sent.every(({ forward, left }) => !forward && !left));
});

test("a pause stops the robot, and takes no time of the program", async (t) => {
  const page = await begin(t, program([drive(0.5, 1), print(plug("robot_time"))]));
  await page.clock.pass(400);
  page.run.pause();
  assert.deepEqual(page.sent.at(-1), ZERO);
  await page.clock.pass(5000);
  assert.deepEqual(page.sent.at(-1), ZERO);
  page.run.resume();
  await page.clock.pass(300);
  assert.equal(speeds(page).at(-1), 0.5);
  await page.clock.pass(600);
  assert.ok(Math.abs(page.prints[0] - 1) < 0.1, page.prints[0]);
});

test("a step runs one block, and the robot stands after it", async (t) => {
  const page = await begin(t, program([drive(0.5, 0.2), print("done")]), { stepping: true });
  assert.ok(page.run.held);
  page.run.step();
  await page.clock.pass(1000);
  assert.ok(page.run.held);
  assert.ok(speeds(page).includes(0.5));
  assert.deepEqual([page.sent.at(-1), page.prints], [ZERO, []]);
  page.run.step();
  await page.clock.pass(100);
  assert.deepEqual(page.prints, ["done"]);
});

test("a slow program stands for a while before each block", async (t) => {
  const page = await begin(t, program([print("a"), print(plug("robot_time"))]), { delay: 1000 });
  await page.clock.pass(900);
  assert.deepEqual(page.prints, []);
  await page.clock.pass(200);
  assert.deepEqual(page.prints, ["a"]);
  await page.clock.pass(1000);
  assert.equal(page.prints.length, 2);
  assert.ok(page.prints[1] < 0.1, `its clock stands, too: ${page.prints[1]} s`);
});

test("a program that is stopped stops the robot at once, and does nothing any more", async (t) => {
  const page = await begin(t, program([forever(drive(0.5, 1), print("round"))]));
  await page.clock.pass(500);
  page.run.end("Stopped.");
  assert.deepEqual(page.sent.at(-1), ZERO);
  const count = page.sent.length;
  await page.clock.pass(3000);
  assert.deepEqual([page.sent.length, page.prints, page.ends], [count, [], [["Stopped.", null]]]);
});

test("after the page was frozen its program drives no robot", async (t) => {
  const page = await begin(t, program([drive(0.5, 30)]));
  await page.clock.pass(500);
  page.clock.freeze(400);
  const count = page.sent.length;
  await page.clock.pass(500);
  assert.deepEqual(page.ends, [["This page was interrupted, so the robot stopped.", null]]);
  assert.deepEqual(page.sent.slice(count), [ZERO]);
});

test("a program that was frozen while it waited has ended, too", async (t) => {
  const page = await begin(t, program([block("robot_wait", { SECONDS: 30 })]));
  await page.clock.pass(500);
  page.clock.freeze(400);
  await page.clock.pass(100);
  assert.deepEqual(page.ends, [["This page was interrupted, so the robot stopped.", null]]);
});

test("a block that fails stops the robot, and is named", async (t) => {
  const faulty = plug("math_arithmetic", { A: 1, B: 0 }, { OP: "DIVIDE" });
  faulty.block.id = "here";
  const moving = [block("robot_set", { X: 0.5, Z: 0 }), block("robot_wait", { SECONDS: 0.1 })];
  const page = await begin(t, program([...moving, print(faulty)]));
  await page.clock.pass(300);
  assert.deepEqual(page.ends, [["This block divides by 0.", "here"]]);
  assert.deepEqual(page.sent.at(-1), ZERO);
});
