// One run of a program, with its robot and its clock.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Interpreter } from "#www/program/interpreter.js";
import { excess, newsOf } from "#www/program/remarks.js";
import { Run } from "#www/program/run.js";

import { Clock } from "./clock.js";
import { block, body, forever, plug, print, program, set } from "./programs.js";
import { play, sight } from "./steps.js";

const ROBOT = { id: "/red", wheel_separation: 2, max_speed: 1 };
const drive = (X, SECONDS) => block("robot_drive", { X, SECONDS });
const ZERO = { type: "drive", robot: "/red", forward: 0, left: 0 };

// Returns the program with an id for each block that has none, as the editor saves it.
function named(json) {
  let count = 0;
  return JSON.parse(JSON.stringify(json), (_, each) => (each?.type ? { id: `block ${count += 1}`, ...each } : each));
}

// Runs a program, whose robot answers at once, on a page that shows what it prints and why it has ended.
async function begin(t, json, { stepping = false, delay = () => 0, ready = true, printed } = {}) {
  const page = { clock: new Clock(t), sent: [], prints: [], ends: [] };
  page.run = new Run(json.run ? json : new Interpreter(named(json), ROBOT), ROBOT, stepping, {
    send: (message) => (message.type === "program" ? answer(page, ready) : page.sent.push(message)),
    printed: ({ print: text }) => page.prints.push(text) && printed?.(page.run), changed() {},
    delay: () => delay(page.clock),
    ended: (...why) => page.ends.push(why),
  });
  await page.clock.pass(60);
  return page;
}

function answer(page, ready) {
  setTimeout(() => page.run.senses.receive({ type: "program", ready, pose: [0, 0, 0], line: null, wheels: [0, 0] }));
}

const sees = sight({
  last: ({ sent }) => sent.at(-1).forward, ended: ({ ends }) => ends.map(([sentence]) => sentence).join(),
  held: ({ run }) => run.held, waitless: ({ run }) => run.waitless, moved: ({ sent }) => sent.some(moves),
});
const moves = ({ forward, left }) => forward !== 0 || left !== 0;
const printed = (index, low, high) => ({ prints }) => assert.ok(low <= prints[index] && prints[index] < high, prints);

async function perform(t, json, given, steps) {
  const page = await begin(t, json, given);
  await play(page, steps);
  page.run.end("Stopped.");
}

const pause = ({ run }) => run.pause(), resume = ({ run }) => run.resume(), step = ({ run }) => run.step();

const TIME = print(plug("robot_time"));
const INTERRUPTED = "This page was interrupted, so the robot stopped.";
const freeze = ({ clock, sent }) => {
  clock.freeze(400);
  sent.length = 0;
};
const stop = ({ run, sent }) => {
  run.end("Stopped.");
  assert.deepEqual(sent.splice(0).at(-1), ZERO);
};
const MARKED = { ...plug("math_arithmetic", { A: 1, B: 0 }, { OP: "DIVIDE" }) };
MARKED.block.id = "here";

const RUNS = { // the blocks, how they are run, and what happens
  "a program begins and ends with a stop, and drives for as long as it says": [
    [drive(0.5, 1), print("done")], {}, 900, sees({ ends: [] }), 200, sees({ ends: [["", null]], prints: ["done"] }),
    ({ sent }) => assert.deepEqual([sent[0], sent.at(-1)], [ZERO, ZERO]),
    ({ sent }) => assert.ok(sent.filter(({ forward }) => forward === 0.5).length >= 20)],
  "nothing moves before the robot's controller is connected; a program whose robot never is says so": [
    [drive(0.5, 1)], { ready: false }, 3800, sees({ ends: [] }), 300,
    sees({ ended: "The robot did not get ready in time. Try again, or tell your teacher.", moved: false })],
  "a pause stops the robot, and takes no time of the program": [
    [drive(0.5, 1), TIME], {}, 400, pause, sees({ last: 0 }), 5000, sees({ last: 0 }), resume, 300,
    sees({ last: 0.5 }), 600, printed(0, 0.9, 1.1)],
  "a step runs one block, and the robot stands after it": [
    [drive(0.5, 0.2), print("done")], { stepping: true }, sees({ held: true }), step, 1000,
    sees({ held: true, moved: true, last: 0, prints: [] }), step, 100, sees({ prints: ["done"] })],
  "a loop that has nothing in it is stepped through, too": [
    [forever()], { stepping: true }, ...Array(3).fill([step, 100, sees({ held: true })]).flat()],
  "a slow program stands for a while before each block, and so does its clock": [
    [print("a"), TIME], { delay: () => 1000 }, 900, sees({ prints: [] }), 200, sees({ prints: ["a"] }), 1000,
    printed(1, 0, 0.1)],
  "a program that is stopped stops the robot at once, and does nothing any more": [
    [forever(drive(0.5, 1), print("round"))], {}, 500, stop, 3000, sees({ sent: [], prints: [], ended: "Stopped." })],
  "after the page was frozen a program that drove ends": [
    [drive(0.5, 30)], {}, 500, freeze, 500, sees({ ended: INTERRUPTED, sent: [ZERO] })],
  "after the page was frozen a program that drove sends no command, but ends": [
    [drive(0.5, 30)], {}, 500, freeze, ({ run }) => run.command(0.5, 0), sees({ ended: INTERRUPTED, sent: [ZERO] })],
  "after the page was frozen a program that waited ends, too": [
    [block("robot_wait", { SECONDS: 30 })], {}, 500, freeze, 500, sees({ ended: INTERRUPTED, sent: [ZERO] })],
  "a block that fails stops the robot, and is named": [
    [block("robot_set", { X: 0.5, Z: 0 }), block("robot_wait", { SECONDS: 0.1 }), print(MARKED)], {}, 300,
    sees({ ends: [["This block divides by 0.", "here"]], moved: true, last: 0 })],
  "a program without a block below its start says so, and marks the start": [
    [], {}, sees({ ends: [['Nothing is below "when the program starts": drag blocks there.', "block 1"]] })],
};
for (const [what, [blocks, given, ...steps]] of Object.entries(RUNS)) {
  test(what, (t) => perform(t, program(blocks), given, steps));
}

test("a step into a loop marks its first block: no two steps look the same", async (t) => {
  const repeat = (id, TIMES, each) => ({ ...block("controls_repeat_ext", { TIMES, DO: body(each) }), id });
  const outer = repeat("outer", 2, repeat("inner", 1, { ...print("a"), id: "print" }));
  const page = await begin(t, program([outer]), { stepping: true });
  const places = [page.run.at];
  while (!page.run.over) {
    page.run.step();
    await page.clock.pass(100);
    places.push(page.run.at);
  }
  assert.deepEqual(places.slice(0, -1), ["outer", "inner", "print", "outer", "inner", "print"]);
});

const SET = block("robot_set", { X: 0.5, Z: 0 });
const WAIT = block("robot_wait", { SECONDS: 0.1 });
const UNUSED = "The robot obeys while the program waits: put a wait below the last block that sets its speed.";
const LEFT = block("robot_turn", { Z: 1, SECONDS: 0.1 }, { fields: { SIDE: "LEFT" } });
const speed = (X, Z) => ({ ...block("robot_set", { X, Z }), id: "fast" });
const way = (X) => ({ ...drive(X, 0.1), id: "fast" });
for (const [what, blocks, text = "", place = null] of [ // what a person reads, and of which block
  ["drives too fast, and once more", [way(3.33), drive(9, 0.1)], "A wheel takes 1 at most, not 3.33.", "fast"],
  ["drives back too fast", [way(-2), drive(9, 0.1)], "A wheel takes 1 at most, not 2.", "fast"],
  ["turns a wheel too fast", [speed(0.8, 0.4), WAIT, drive(9, 0.1)], "A wheel takes 1 at most, not 1.2.", "fast"],
  ["does not wait", [speed(7, 0), print("no wait"), drive(9, 0.1)], "A wheel takes 1 at most, not 7.", "fast"],
  ["drives at full speed", [way(1)]],
  ["turns at full speed", [LEFT]],
  ["has no wait", [SET], UNUSED],
  ["has no wait after the last speed", [SET, WAIT, SET, print("done")], UNUSED],
  ["waits", [SET, WAIT, print("done")]],
  ["ends with a stop", [SET, block("robot_stop")]],
]) {
  test(`of a program that ${what}, a person reads "${text}"`, async (t) => {
    const page = await begin(t, program(blocks));
    await page.clock.pass(1000);
    assert.deepEqual([page.ends, page.run.limit], [[["", null]], text ? { text, place } : null]);
  });
}

test("the fastest speed of a robot with SI units has its unit", () => {
  const robot = { wheel_separation: 0.1, max_speed: 0.6, workshop: false };
  assert.equal(excess([2, 0], robot), "A wheel takes 0.6 m/s at most, not 2.");
  assert.equal(excess([0.6, 0], robot), "");
  assert.equal(excess([0, 20], robot), "A wheel takes 0.6 m/s at most, not 1.");
});

test("a loop without a wait is reported after a second, until the program waits again", async (t) => {
  const early = plug("logic_compare", { A: plug("robot_time"), B: 2 }, { OP: "LT" });
  const loop = block("controls_whileUntil", { BOOL: early, DO: body(set("x", 1)) }, { fields: { MODE: "WHILE" } });
  const blocks = program([loop, drive(0.5, 30)], { variables: ["x"] });
  const page = await begin(t, blocks, { delay: (clock) => clock.freeze(1) }); // each statement takes a millisecond
  const waitless = [];
  for (const ms of [840, 600, 3000]) {
    await page.clock.pass(ms);
    waitless.push(page.run.waitless);
  }
  assert.deepEqual(waitless, [false, true, false]);
});

const NEWS = [ // a run; what is said of it, and whether that is a warning
  [{ held: false, at: null }, "Starting", false],
  [{ held: false, at: "here" }, "Running", false],
  [{ held: true, at: "here" }, "Paused. Step runs what is marked.", false],
  [{ held: true, at: null }, "Paused", false],
  [{ at: "here", limit: { text: "Too fast." } }, "Running. Too fast.", true],
  [{ at: "here", waitless: true },
    "A loop runs without a wait, so the robot stands still: put a wait into it.", true],
];

for (const [run, text, warning] of NEWS) {
  test(`of a program that runs a person reads: ${text}`, () => assert.deepEqual(newsOf(run), [text, warning]));
}

// A text's engine: it drives, and then computes in a worker, of which the page hears nothing.
const COMPUTES = { repeats: false, motion: [0.5, 0], variables: new Map(), needs: { senses: true, eyes: false },
  prepare() {}, end() {},
  async *run() {
    yield { publish: true };
    await new Promise(() => {});
  } };

test("an engine that computes for long, or loads, is no interruption of the page", async (t) => {
  const later = () => new Promise((resolve) => { setTimeout(resolve, 2000); });
  const page = await begin(t, { ...COMPUTES, needs: {}, prepare: later, async *run() {
    await later();
    yield { publish: true };
  } });
  await page.clock.pass(5000);
  assert.deepEqual(page.ends, [["", null]]);
});

test("a text that computes stops its robot after a second, and can go on: its page is not interrupted", (t) => (
  perform(t, COMPUTES, {}, [800, sees({ last: 0.5 }), 400, sees({ last: 0, ends: [], waitless: true })])));

test("a text that is paused drives by none of the commands that it has given meanwhile", (t) => {
  const engine = { ...COMPUTES, async *run() {
    yield { print: "now" };
    yield { publish: true };
    yield { print: "went on" };
  } };
  return perform(t, engine, { printed: (run) => run.pause() }, [300, sees({ moved: false }), resume, 100,
    sees({ prints: ["now", "went on"], moved: true })]);
});
