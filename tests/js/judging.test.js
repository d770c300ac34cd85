// Judge me, from the press to the score, and whatever comes between.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Judging } from "#www/program/judging.js";

import { Clock } from "./clock.js";

const STAND = { type: "drive", robot: "/red", forward: 0, left: 0 };
const ASK = { type: "judge", robot: "/red", task: "metre" };
const END = { type: "judge", robot: "/red", task: "" };
const STARTING = "The robot goes to the start of the task.";
const CANCELLED = "Judge me was cancelled.";
const RESULT = { state: "done", title: "One metre", score: 87.26, seconds: 3.41, text: "Largest loss: too late." };

// Returns a page on which Judge me was pressed; report(fields): the judge of /red says so.
function press(t, task = null) {
  const page = { clock: new Clock(t), sent: [], read: [], runs: 0, blocked: false, states: { "/red": { task } } };
  page.world = { chosen: "/red", state: (robot) => page.states[robot] ?? {}, isBlocked: () => page.blocked };
  page.judging = new Judging({
    world: page.world, send: (message) => page.sent.push(message), say: (text) => page.read.push(text),
    run: () => { page.runs += 1; },
  });
  page.report = (fields) => {
    page.states["/red"].task = fields && { name: "metre", ...fields };
    page.judging.update();
  };
  page.judging.begin("/red", "metre");
  return page;
}

function drive(t) {
  const page = press(t);
  page.report({ state: "ready" });
  page.sent.splice(0);
  return page;
}

test("the robot stands, goes to the start, the program runs once, and the score is shown", (t) => {
  const { judging, sent, read, report } = press(t);
  assert.deepEqual(sent, [STAND, ASK]);
  for (const fields of [null, { name: "square", state: "ready" }, { state: "driving" }]) report(fields);
  assert.deepEqual([judging.isWaiting, read], [true, [STARTING]]);
  report({ state: "ready" });
  report({ state: "driving" });
  judging.programEnded(false);
  report({ ...RESULT });
  assert.match(read[1], /^The judge measures from the first motion/);
  assert.deepEqual(read.slice(2), ["One metre: 87.3 points, 3.4 s. Largest loss: too late."]);
  assert.equal(judging.state.name, "idle");
});

test("the program runs when the robot is at its start, and only then", (t) => {
  const page = press(t);
  page.report({ state: "driving" });
  assert.equal(page.runs, 0);
  page.report({ state: "ready" });
  page.report({ state: "ready" });
  assert.equal(page.runs, 1);
  assert.match(page.read.at(-1), /^The judge measures/, "not that the program has ended");
});

test("a robot that is at the start already is not put there again", (t) => {
  const page = press(t, { name: "metre", state: "ready" });
  page.judging.update();
  assert.deepEqual([page.sent, page.runs], [[STAND], 1]);
});

const STOPS = {
  "the person cancels": ({ judging }) => judging.cancel(),
  "another robot is chosen": ({ world }) => { world.chosen = "/blue"; },
  "the robot is stopped": (page) => { page.blocked = true; },
};
for (const [what, stop] of Object.entries(STOPS)) {
  test(`before the start, when ${what}, the judge ends it and the program never runs`, (t) => {
    const page = press(t);
    stop(page);
    page.judging.update();
    page.world.chosen = "/red";
    page.blocked = false;
    page.report({ state: "ready" });
    assert.deepEqual([page.sent.slice(2), page.read.slice(1), page.runs], [[END], [CANCELLED], 0]);
  });
}

test("a refusal of the cockpit ends it with the cockpit's sentence", (t) => {
  const { judging, sent, read } = press(t);
  judging.cancel("No judge has this task.");
  assert.deepEqual([sent.slice(2), read.at(-1)], [[END], "No judge has this task."]);
});

test("a sentence that comes later cancels nothing", (t) => {
  const { judging, sent, read } = drive(t);
  judging.cancel("Somebody has come.");
  assert.equal(judging.state.name, "driving");
  assert.deepEqual([sent, read.length], [[], 2]);
});

test("what the judge cancels meanwhile is said, and it may still begin; what it said before is not said", (t) => {
  const old = { name: "metre", state: "cancelled", text: "Its program was stopped." };
  const page = press(t, old);
  page.report(old);
  assert.deepEqual(page.read, [STARTING]);
  page.report({ state: "cancelled", text: "The robot was moved." });
  page.report({ state: "cancelled", text: "The robot was moved." });
  assert.deepEqual(page.read.slice(1), ["The robot was moved."]);
  page.report({ state: "ready" });
  assert.equal(page.runs, 1);
});

test("after 20 s without the robot at its start it ends, with the judge's reason if there is one", (t) => {
  for (const [task, sentence] of [[null, "The judge did not put the robot at its start. Try again."],
    [{ state: "cancelled", text: "The robot was moved." }, "The robot was moved."]]) {
    const page = press(t);
    page.clock.freeze(20000);
    page.report(task);
    assert.equal(page.judging.isWaiting, true);
    page.clock.freeze(1);
    page.report(task);
    assert.deepEqual([page.read.at(-1), page.sent.at(-1), page.judging.state.name], [sentence, END, "idle"]);
    t.mock.restoreAll();
  }
});

test("a program that is paused, or ends before its end, gives no score, and the judge says so", (t) => {
  for (const stop of [(judging) => judging.paused(), (judging) => judging.programEnded(true)]) {
    const { judging, sent, read, report } = drive(t);
    stop(judging);
    assert.deepEqual(sent, [END]);
    report({ state: "cancelled", text: "Its program was stopped." });
    assert.deepEqual([read.at(-1), judging.state.name], ["Its program was stopped.", "idle"]);
    t.mock.restoreAll();
  }
});

test("a program that ends and has not driven is said; who drives on by hand gets the score", (t) => {
  const { judging, sent, read, report } = drive(t);
  judging.programEnded(false);
  report({ state: "ready" });
  assert.equal(read.at(-1), "The program has ended, and the robot stands at the start.");
  report({ state: "driving" });
  report({ ...RESULT });
  assert.deepEqual([sent, judging.state.name], [[], "idle"]);
  assert.match(read.at(-1), /^One metre: 87.3 points/);
});

test("a judge that ends, or begins another task, is said", (t) => {
  for (const task of [null, { name: "square", state: "driving" }]) {
    const { judging, read, report } = drive(t);
    report(task);
    assert.deepEqual([read.at(-1), judging.state.name], ["The judge has ended. Try again.", "idle"]);
    t.mock.restoreAll();
  }
});

test("without Judge me, programs end and pause, and no judge hears of it", (t) => {
  const { judging, sent, report } = drive(t);
  report({ ...RESULT });
  judging.paused();
  judging.programEnded(true);
  judging.update();
  assert.deepEqual(sent, []);
});
