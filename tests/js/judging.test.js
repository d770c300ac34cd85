// Judge me, from the press to the score, and whatever comes between.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Judging } from "#www/program/judging.js";
import { World } from "#www/world.js";

import { Clock } from "./clock.js";

const STAND = { type: "drive", robot: "/red", forward: 0, left: 0 };
const ASK = { type: "judge", robot: "/red", task: "metre" };
const END = { type: "judge", robot: "/red", task: "" };
const KEEP = { type: "program", robot: "/red" };
const STARTING = "The robot goes to the start of the task.";
const RESULT = { state: "done", title: "One metre", score: 87.26, seconds: 3.41, text: "Largest loss: too late." };
const POINTS = "One metre: 87.3 points, 3.4 s. Largest loss: too late.";
const NOT_JUDGED = "This drive is not judged any more.";
const ME = { id: 1, name: "pupil 1", role: "pupil", robot: null };
const FREE = { answers: true, driver: null, task: null };

// A page as the judging sees it: programs run and end, messages are sent and answered, states arrive.
class Page {
  sent = []; // messages
  read = []; // what the person reads
  ends = []; // why programs were ended
  runs = 0;
  going = false; // whether a program runs
  connected = true;

  constructor(t) {
    this.clock = new Clock(t);
    this.world = Object.assign(new World(), { chosen: "/red", me: ME, robots: [{ id: "/red" }, { id: "/blue" }] });
    this.be({});
    const send = (message) => this.connected && this.sent.push(message) > 0;
    this.judging = new Judging({
      send, world: this.world, say: (text) => this.read.push(text), lost: () => !this.connected,
      run: () => {
        this.runs += 1;
        this.going = true;
      },
      end: (sentence) => this.end(sentence),
    });
  }

  // The program ends, if one runs; "" is its own end.
  end(sentence) {
    if (!this.going) return;
    this.going = false;
    this.ends.push(sentence);
    this.judging.programEnded(Boolean(sentence));
  }

  be(fields, robot = "/red") {
    this.world.states = { ...this.world.states, [robot]: { ...FREE, ...this.world.states[robot], ...fields } };
  }

  // A state arrives, with these fields of the robot.
  state(fields = {}) {
    this.be(fields);
    this.judging.update();
  }

  // The judge reports how the robot does, and what was asked for with this word.
  report(fields, request = "one") {
    this.state({ task: fields && { name: "metre", request, sentences: [], lost: null, ...fields } });
  }

  // The cockpit answers.
  accept(request = "one") {
    this.be({ driver: ME, task: null });
    this.judging.answered({ request, refusal: null });
  }

  refuse(template, code = "") {
    this.judging.answered({ request: "", refusal: { code, template, arguments: {}, text: "in English" } });
  }

  // Takes what was sent but for what keeps the robot.
  take() {
    return this.sent.splice(0).filter(({ type }) => type !== "program");
  }

  get name() {
    return this.judging.state.name;
  }

  get said() {
    return this.read.at(-1);
  }
}

function press(t) {
  const page = new Page(t);
  page.judging.begin("/red", "metre");
  return page;
}

function wait(t) {
  const page = press(t);
  page.accept();
  page.take();
  return page;
}

function drive(t) {
  const page = wait(t);
  page.report({ state: "ready" });
  page.take();
  return page;
}

function end(t) {
  const page = drive(t);
  page.report({ state: "driving" });
  page.end("");
  return page;
}

const STATES = { waiting: wait, driving: drive, ended: end };

test("the robot stands, goes to the start, the program runs once, and the score is shown", (t) => {
  const page = press(t);
  assert.deepEqual(page.take(), [STAND, ASK]);
  page.state();
  page.accept();
  page.report(null);
  assert.deepEqual([page.name, page.read, page.runs], ["waiting", [STARTING], 0]);
  page.report({ state: "ready" });
  page.report({ state: "ready" });
  page.report({ state: "driving" });
  page.end("");
  page.report({ ...RESULT });
  assert.match(page.read[1], /^The judge measures until the robot has stopped/);
  assert.deepEqual([page.read.slice(2), page.runs, page.ends], [[POINTS], 1, [""]]);
  assert.deepEqual([page.name, page.take()], ["idle", []]);
});

test("a program that runs on this page ends at the press, and starts again at the start", (t) => {
  const page = new Page(t);
  page.going = true;
  page.judging.begin("/red", "metre");
  assert.deepEqual([page.going, page.ends], [false, ["Judge me ended this program."]]);
  assert.deepEqual(page.take(), [STAND, ASK]);
  page.accept();
  page.report({ state: "ready" });
  assert.deepEqual([page.going, page.runs, page.name], [true, 1, "driving"]);
});

test("a program that drives from elsewhere is named, and kept waiting until the judge is done", (t) => {
  const page = new Page(t);
  page.be({ program: "my_metre", state: "driving" });
  page.judging.begin("/red", "metre");
  assert.equal(page.said, `${STARTING} my_metre waits until the end.`);
  page.accept();
  page.sent.splice(0);
  const kept = (seconds) => Array.from({ length: seconds }, () => {
    page.clock.freeze(1001);
    page.state();
    return page.sent.splice(0);
  });
  assert.deepEqual(kept(3), [[KEEP], [KEEP], [KEEP]]);
  page.report({ state: "ready" });
  assert.deepEqual(kept(2), [[], []], "the program does it");
  page.report({ state: "driving" });
  page.end("");
  assert.deepEqual(kept(2), [[KEEP], [KEEP]]);
});

test("what another judge reports starts no program, and is not read, nor what this one said before", (t) => {
  const page = press(t);
  for (const [state, request] of [["ready", ""], ["ready", "before"], ["cancelled", "before"], ["done", ""]]) {
    page.report({ ...RESULT, state }, request);
  }
  page.accept();
  for (const [state, request] of [["ready", ""], ["ready", "before"], ["cancelled", "before"], ["done", ""]]) {
    page.report({ ...RESULT, state }, request);
  }
  assert.deepEqual([page.name, page.read, page.runs], ["waiting", [STARTING], 0]);
});

test("a refusal is shown as it is, once, and nothing is asked for", (t) => {
  const page = press(t);
  page.take();
  page.state({ driver: { id: 2, name: "pupil 2" } });
  page.refuse("pupil 2 drives red. Press Judge me again when red is free.");
  page.state();
  assert.deepEqual(page.read.slice(1), ["pupil 2 drives red. Press Judge me again when red is free."]);
  assert.deepEqual([page.name, page.take()], ["idle", []]);
});

test("of presses and cancels in a row, only the answer to the last press counts", (t) => {
  const page = press(t);
  page.judging.cancel();
  page.judging.begin("/red", "metre");
  page.refuse("The first one is refused.");
  page.accept("");
  assert.deepEqual([page.name, page.said], ["waiting", STARTING]);
  page.accept("two");
  page.report({ state: "ready" }, "one");
  assert.equal(page.runs, 0);
  page.report({ state: "ready" }, "two");
  assert.deepEqual([page.runs, page.name], [1, "driving"]);
});

test("after a new connection, answers to what was asked before are not waited for", (t) => {
  const page = press(t);
  page.judging.cancel("The connection to the cockpit was lost.");
  page.judging.hello();
  page.judging.begin("/red", "metre");
  page.accept("two");
  page.report({ state: "ready" }, "two");
  assert.equal(page.runs, 1);
});

test("without a robot or a connection it says so, and waits for nothing", (t) => {
  const page = new Page(t);
  page.world.list({ robots: [{ id: "/blue", label: "blue" }] });
  page.judging.begin("/red", "metre");
  assert.deepEqual([page.said, page.name, page.sent], ["red is not running.", "idle", []]);
  page.world.list({ robots: [] });
  page.world.chosen = null;
  page.judging.begin(null, "metre");
  assert.equal(page.said, "No robot is running.");
  page.world.list({ robots: [{ id: "/red", label: "red" }] });
  page.world.chosen = "/red";
  page.connected = false;
  page.judging.begin("/red", "metre");
  assert.deepEqual([page.said, page.name], ["There is no connection to the cockpit.", "idle"]);
});

const CAUSES = { // why Judge me is refused, until when
  "the emergency stop": ["all_stopped", ({ world }, on) => { world.emergency = on; }],
  "the robot's own stop": ["stopped", (page, on) => page.be({ stopped: on })],
  "a teacher": ["taken", (page, on) => page.be({ held: on ? "robot" : null })],
  "another driver": ["judge_driven", (page, on) => page.be({ driver: on ? { id: 2, name: "Zoë" } : null })],
  "a judge in a terminal": ["judged_elsewhere", (page, on) => page.be({ task: { state: on ? "ready" : "done" } })],
};
for (const [what, [code, be]] of Object.entries(CAUSES)) {
  test(`a refusal is shown until its cause is over, also if its state came a little later: ${what}`, (t) => {
    const page = press(t);
    page.refuse("Why", code);
    for (const on of [false, true, true]) {
      be(page, on);
      page.state();
      assert.equal(page.said, "Why", String(on));
    }
    be(page, false);
    page.state();
    assert.equal(page.said, "");
  });
}

test("that no robot runs, or that there is no connection, is shown until it is back", (t) => {
  const page = new Page(t);
  page.world.list({ robots: [] });
  page.judging.begin("/red", "metre");
  page.state();
  assert.equal(page.said, "red is not running.");
  page.world.list({ robots: [{ id: "/red", label: "red" }] });
  page.state();
  assert.equal(page.said, "");
  page.connected = false;
  page.judging.begin("/red", "metre");
  page.connected = true;
  page.state();
  assert.equal(page.said, "");
});

const RESULTS = { // what ends a score
  "another program is shown or runs": (page) => page.judging.forget(),
  "the robot is put back": (page) => page.report(null),
  "the robot gets another task": (page) => page.report({ state: "ready" }, "two"),
  "another robot is chosen": (page) => {
    page.world.chosen = "/blue";
    page.state();
  },
};
for (const [what, act] of Object.entries(RESULTS)) {
  test(`a score is shown until ${what}`, (t) => {
    const page = end(t);
    page.report({ ...RESULT });
    page.state();
    assert.equal(page.said, POINTS);
    act(page);
    assert.equal(page.said, "");
  });
}

test("another program that is shown takes nothing back of what is judged now", (t) => {
  for (const begin of Object.values(STATES)) {
    const page = begin(t);
    const { name, said } = page;
    page.judging.forget();
    assert.deepEqual([page.name, page.said], [name, said]);
    t.mock.restoreAll();
  }
});

test("while it waits, a task that is not offered any more cancels it, and it is said who ended it", (t) => {
  for (const [tasks, role, sentence] of [
    [[{ name: "metre", on: false }], "pupil", "Judge me was cancelled: your teacher has switched this task off."],
    [[{ name: "square", on: true }], "pupil", "Judge me was cancelled: nobody judges this task any more."],
    [[{ name: "metre", on: true }], "pupil", STARTING], [[{ name: "metre", on: false }], "teacher", STARTING]]) {
    const page = wait(t);
    page.world.me = { ...ME, role };
    page.judging.list(tasks);
    assert.equal(page.said, sentence);
    t.mock.restoreAll();
  }
});

test("a stop is said with what it means for the score", (t) => {
  for (const [begin, sentence] of [[wait, "Judge me was cancelled."], [end, "The drive does not count."]]) {
    const page = begin(t);
    page.judging.stop("All robots were stopped.");
    assert.equal(page.said, `All robots were stopped. ${sentence}`);
    t.mock.restoreAll();
  }
});

const LOST = {
  "the person cancels": ["Judge me was cancelled.", (page) => page.judging.cancel()],
  "another robot is chosen": ["Judge me was cancelled: another robot was chosen.",
    (page) => { page.world.chosen = "/blue"; }],
  "all robots are stopped": ["Judge me was cancelled: the robot was stopped.",
    ({ world }) => { world.emergency = true; }],
  "this robot is stopped": ["Judge me was cancelled: the robot was stopped.", (page) => page.be({ stopped: true })],
  "the robot falls silent": ["Judge me was cancelled: the robot does not answer.",
    (page) => page.be({ answers: false })],
  "a teacher takes it": ["Judge me was cancelled: your teacher has taken the robot.",
    (page) => page.be({ held: "robot", driver: null })],
  "another page drives it": ["Judge me was cancelled: Ada drives the robot.",
    (page) => page.be({ driver: { id: 2, name: "Ada" } })],
};
for (const [what, [sentence, lose]] of Object.entries(LOST)) {
  test(`before the start, when ${what}, it says so, the judge ends it, and the program never runs`, (t) => {
    const page = wait(t);
    lose(page);
    page.state();
    assert.deepEqual([page.said, page.name, page.take()], [sentence, "idle", [END]]);
    Object.assign(page.world, { chosen: "/red", emergency: false });
    page.be({ stopped: false, answers: true, driver: ME, held: null });
    page.report({ state: "ready" });
    assert.deepEqual([page.runs, page.read.length], [0, 2]);
  });
}

test("when the judge cannot begin, its reason is read at once", (t) => {
  const page = wait(t);
  const said = { code: "simulator_silent", template: "The simulator does not answer.", arguments: {} };
  page.report({ state: "cancelled", text: "", sentences: [said] });
  assert.deepEqual([page.said, page.name, page.runs], ["The simulator does not answer.", "idle", 0]);
});

test("after 20 s without the robot at its start it ends", (t) => {
  const page = wait(t);
  page.clock.freeze(20000);
  page.state();
  assert.equal(page.name, "waiting");
  page.clock.freeze(1);
  page.state();
  assert.equal(page.said, "The judge did not put the robot at its start. Try again.");
  assert.deepEqual([page.name, page.take()], ["idle", [END]]);
});

test("a pause, or an end before the program's own, gives no score, and is said once", (t) => {
  for (const [stop, sentence] of [
    [(page) => page.judging.paused(), "The drive does not count: the program was paused."],
    [(page) => page.end("Stopped."), "The drive does not count."]]) {
    const page = drive(t);
    stop(page);
    assert.deepEqual([page.said, page.name, page.take()], [sentence, "idle", [END]]);
    page.report({ state: "cancelled", text: "The drive does not count: its program was stopped." });
    assert.equal(page.said, sentence);
    t.mock.restoreAll();
  }
});

test("once the judge has a result, a program that still runs ends, and its score counts", (t) => {
  const page = drive(t);
  page.report({ state: "driving" });
  page.report({ ...RESULT });
  assert.deepEqual([page.said, page.ends, page.take()], [POINTS, ["The judge has seen enough."], []]);
});

for (const [state, begin] of Object.entries({ driving: drive, ended: end })) {
  test(`${state}: what the judge cancels is said, and no program drives on`, (t) => {
    const page = begin(t);
    page.report({ state: "cancelled", text: "The robot was put back to its start, so the drive does not count." });
    assert.equal(page.said, "The robot was put back to its start, so the drive does not count.");
    assert.deepEqual([page.name, page.ends], ["idle", [state === "driving" ? NOT_JUDGED : ""]]);
  });

  test(`${state}: a judge that ends is said, and no program drives on`, (t) => {
    for (const task of [null, { request: "", state: "driving" }, { request: "two", state: "ready" }]) {
      const page = begin(t);
      page.report(task, task?.request);
      assert.deepEqual([page.said, page.name, page.going],
        ["The judge does not answer any more. Try again.", "idle", false]);
      t.mock.restoreAll();
    }
  });
}

for (const [state, begin] of Object.entries(STATES)) {
  test(`${state}: a press begins again, and only the new drive is judged`, (t) => {
    const page = begin(t);
    page.take();
    page.judging.begin("/red", "square");
    assert.deepEqual([page.name, page.going, page.said], ["waiting", false, STARTING]);
    assert.deepEqual(page.take(), [END, STAND, { ...ASK, task: "square" }]);
    page.report({ ...RESULT });
    page.accept("");
    page.report({ ...RESULT });
    page.accept("two");
    page.report({ ...RESULT });
    assert.deepEqual([page.name, page.said], ["waiting", STARTING], "the last result comes in meanwhile");
    page.report({ state: "ready" }, "two");
    assert.deepEqual([page.name, page.going], ["driving", true]);
  });
}

test("once the program has ended, a new start of it or another robot cancels, and no score is shown", (t) => {
  for (const lose of [(page) => page.judging.cancel(), (page) => { page.world.chosen = "/blue"; }]) {
    const page = end(t);
    page.take();
    lose(page);
    page.state();
    assert.deepEqual([page.name, page.take()], ["idle", [END]]);
    page.world.chosen = "/red";
    page.report({ ...RESULT });
    assert.match(page.said, /^Judge me was cancelled/);
    t.mock.restoreAll();
  }
});

test("nothing that is said meanwhile cancels a drive", (t) => {
  const page = drive(t);
  page.judging.cancel("Somebody has come.");
  assert.deepEqual([page.name, page.going, page.take()], ["driving", true, []]);
});

test("a program that ends and has not driven is said, but not before the judge can have seen its drive", (t) => {
  const page = drive(t);
  page.end("");
  page.clock.freeze(4000);
  page.report({ state: "ready" });
  assert.equal(page.name, "ended");
  page.clock.freeze(1);
  page.report({ state: "ready" });
  assert.equal(page.said, "The program has ended, and the robot did not drive: no score.");
  assert.deepEqual([page.name, page.take()], ["idle", [END]]);
});

test("without Judge me, programs end and pause, and no judge hears of it", (t) => {
  const page = end(t);
  page.report({ ...RESULT });
  page.take();
  page.judging.paused();
  page.going = true;
  page.end("Stopped.");
  page.judging.cancel();
  page.state();
  assert.deepEqual([page.take(), page.said], [[], POINTS]);
});
