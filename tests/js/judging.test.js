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
const FREE = { answers: true, driver: null, task: null, stopped: false, held: null };
const RED = { id: "/red", label: "red" };

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
    this.world = Object.assign(new World(), { chosen: "/red", me: ME, robots: [RED, { id: "/blue" }] });
    this.be({});
    this.judging = new Judging({
      world: this.world, send: (message) => this.connected && this.sent.push(message) > 0,
      say: (text) => this.read.push(text), lost: () => !this.connected,
      run: () => Object.assign(this, { runs: this.runs + 1, going: true }), end: (sentence) => this.end(sentence),
    });
  }

  // The program ends, if one runs; "" is its own end.
  end(sentence) {
    if (!this.going) return;
    this.going = false;
    this.ends.push(sentence);
    this.judging.programEnded(Boolean(sentence));
  }

  be(fields) {
    this.world.states = { "/red": { ...FREE, ...this.world.states["/red"], ...fields } };
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

// What happens from the press to the program's end, by the state after it
const WAY = {
  asked: ({ judging }) => judging.begin("/red", "metre"),
  waiting: (page) => page.accept(),
  driving: (page) => page.report({ state: "ready" }),
  ended: (page) => {
    page.report({ state: "driving" });
    page.end("");
  },
};

// Returns a page in this state, on which all that was sent has been taken.
function reach(t, name) {
  const page = new Page(t);
  for (const [state, act] of Object.entries(WAY)) {
    act(page);
    if (state === name) break;
  }
  page.sent = [];
  return page;
}

const STATES = ["waiting", "driving", "ended"];

test("the robot stands, goes to the start, the program runs once, and the score is shown", (t) => {
  const page = new Page(t);
  page.judging.begin("/red", "metre");
  assert.deepEqual(page.take(), [STAND, ASK]);
  page.state();
  page.accept();
  page.report(null);
  assert.deepEqual([page.name, page.read, page.runs], ["waiting", [STARTING], 0]);
  for (const state of ["ready", "ready", "driving"]) page.report({ state });
  page.end("");
  page.report(RESULT);
  assert.match(page.read[1], /^The judge measures until the robot has stopped/);
  assert.deepEqual([page.read.slice(2), page.runs, page.ends], [[POINTS], 1, [""]]);
  assert.deepEqual([page.name, page.take()], ["idle", []]);
});

const CANCELLED = "Judge me was cancelled.";
const OTHER_ROBOT = "Judge me was cancelled: another robot was chosen.";
const STOPPED = "Judge me was cancelled: the robot was stopped.";
const NOTHING = ""; // is said, and it goes on: so it is in a state that a row does not have
const be = (fields) => (page) => page.be(fields);
const list = (...tasks) => ({ judging }) => judging.list(tasks);
const HERE = { // what happens on this page or to the robot; what is said while it waits, drives, and has driven
  "the person cancels": [({ judging }) => judging.cancel(), CANCELLED, NOTHING, CANCELLED],
  "all are stopped here": [({ judging }) => judging.stop("You pressed STOP."),
    "You pressed STOP. Judge me was cancelled.", NOTHING, "You pressed STOP. The drive does not count."],
  "the person pauses": [({ judging }) => judging.paused(),
    NOTHING, "The drive does not count: the program was paused."],
  "the program is ended": [(page) => page.end("Stopped."), NOTHING, "The drive does not count."],
  "another program is shown": [({ judging }) => judging.forget()],
  "another robot is chosen": [({ world }) => { world.chosen = "/blue"; }, OTHER_ROBOT, NOTHING, OTHER_ROBOT],
  "all robots are stopped": [({ world }) => { world.emergency = true; }, STOPPED],
  "this robot is stopped": [be({ stopped: true }), STOPPED],
  "the robot falls silent": [be({ answers: false }), "Judge me was cancelled: the robot does not answer."],
  "a teacher takes it": [be({ held: "robot", driver: null }),
    "Judge me was cancelled: your teacher has taken the robot."],
  "another page drives it": [be({ driver: { id: 2, name: "Ada" } }), "Judge me was cancelled: Ada drives the robot."],
  "its task is offered": [list({ name: "metre", on: true })],
  "its task is off": [list({ name: "metre", on: false }),
    "Judge me was cancelled: your teacher has switched this task off."],
  "its task is off for pupils": [(page) => {
    page.world.me = { ...ME, role: "teacher" };
    list({ name: "metre", on: false })(page);
  }],
  "nobody judges its task": [list({ name: "square", on: true }),
    "Judge me was cancelled: nobody judges this task any more."],
  "20 s pass": [({ clock }) => clock.freeze(20000)],
  "more than 20 s pass": [({ clock }) => clock.freeze(20001),
    "The judge did not put the robot at its start. Try again."],
};
for (const [what, [act, ...sentences]] of Object.entries(HERE)) {
  for (const [index, name] of STATES.entries()) {
    test(`${name}, when ${what}, a person reads: ${sentences[index] || "nothing, and it goes on"}`, (t) => {
      const page = reach(t, name);
      const { read: { length }, going } = page;
      act(page);
      page.state();
      if (!sentences[index]) {
        return assert.deepEqual([page.name, page.read.slice(length), page.take(), page.going], [name, [], [], going]);
      }
      assert.deepEqual([page.name, page.read.slice(length), page.take()], ["idle", [sentences[index]], [END]]);
      Object.assign(page.world, { chosen: "/red", emergency: false });
      page.be({ ...FREE, driver: ME });
      for (const late of [{ state: "cancelled" }, { state: "ready" }, RESULT]) page.report(late);
      assert.deepEqual([page.runs, page.read.length, page.take()], [name === "waiting" ? 0 : 1, length + 1, []]);
    });
  }
}

const WHY = "The robot was put back to its start, so the drive does not count.";
const GONE = "The judge does not answer any more. Try again.";
const NO_SIMULATOR = { code: "simulator_silent", template: "The simulator does not answer.", arguments: {} };
const REPORTS = { // of the judge, and to whom; what is said in each state, and why a program that still runs is ended
  "sees a drive": [{ state: "driving" }, "one"],
  "has a result": [RESULT, "one", NOTHING, POINTS, POINTS, "The judge has seen enough."],
  "cancels": [{ state: "cancelled", text: WHY }, "one", WHY, WHY, WHY, NOT_JUDGED],
  "cannot begin": [{ state: "cancelled", text: "", sentences: [NO_SIMULATOR] }, "one",
    ...Array(3).fill("The simulator does not answer."), NOT_JUDGED],
  "is gone": [null, "", NOTHING, GONE, GONE, NOT_JUDGED],
  "is ready for somebody else": [{ state: "ready" }, "two", NOTHING, GONE, GONE, NOT_JUDGED],
  "has another result": [RESULT, "before", NOTHING, GONE, GONE, NOT_JUDGED],
  "cancels another drive": [{ state: "cancelled" }, "before", NOTHING, GONE, GONE, NOT_JUDGED],
  "is one in a terminal": [{ state: "ready" }, "", NOTHING, GONE, GONE, NOT_JUDGED],
};
for (const [what, [report, request, ...said]] of Object.entries(REPORTS)) {
  for (const [index, name] of STATES.entries()) {
    test(`${name}, when the judge ${what}, a person reads: ${said[index] || "nothing, and it goes on"}`, (t) => {
      const page = reach(t, name);
      const { read: { length }, going, ends } = page;
      page.report(report, request);
      assert.deepEqual(page.read.slice(length), said[index] ? [said[index]] : []);
      const after = said[index] ? ["idle", false, name === "driving" ? said[3] : ends[0]] : [name, going, ends[0]];
      assert.deepEqual([page.name, page.going, page.ends[0], page.take()], [...after, []]);
    });
  }
}

for (const name of STATES) {
  test(`${name}: a press begins again, and only the new drive is judged`, (t) => {
    const page = reach(t, name);
    page.judging.begin("/red", "square");
    assert.deepEqual([page.name, page.going, page.said], ["waiting", false, STARTING]);
    assert.deepEqual(page.take(), [END, STAND, { ...ASK, task: "square" }]);
    if (name === "driving") assert.equal(page.ends[0], "Judge me ended this program.");
    page.report(RESULT);
    page.refuse("The answer to what was asked before.");
    page.report(RESULT);
    page.accept("two");
    for (const report of [RESULT, { state: "ready" }]) page.report(report);
    assert.deepEqual([page.name, page.said], ["waiting", STARTING], "the last drive's reports come in meanwhile");
    page.report({ state: "ready" }, "two");
    assert.deepEqual([page.name, page.going], ["driving", true]);
  });
}

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

test("before the cockpit has answered, no judge is read, and nothing of the robot cancels", (t) => {
  const page = reach(t, "asked");
  for (const request of ["", "before"]) {
    for (const state of ["ready", "cancelled", "done"]) page.report({ ...RESULT, state }, request);
  }
  page.state({ driver: { id: 2, name: "pupil 2" } });
  assert.deepEqual([page.name, page.read, page.runs], ["waiting", [STARTING], 0]);
});

test("a refusal is shown as it is, once, and nothing is asked for", (t) => {
  const page = reach(t, "asked");
  page.refuse("pupil 2 drives red. Press Judge me again when red is free.");
  page.state();
  assert.deepEqual(page.read.slice(1), ["pupil 2 drives red. Press Judge me again when red is free."]);
  assert.deepEqual([page.name, page.take()], ["idle", []]);
});

test("after a new connection, answers to what was asked before are not waited for", (t) => {
  const page = reach(t, "asked");
  page.judging.cancel("The connection to the cockpit was lost.");
  page.judging.hello();
  page.judging.begin("/red", "metre");
  page.accept("two");
  page.report({ state: "ready" }, "two");
  assert.equal(page.runs, 1);
});

const MISSING = { // what there is not, as the page has it, without it and with it
  "red is not running.": (page, is) => { page.world.robots = [is ? RED : { id: "/blue" }]; },
  "There is no connection to the cockpit.": (page, is) => { page.connected = is; },
};
for (const [sentence, set] of Object.entries(MISSING)) {
  test(`without what it needs it waits for nothing, and says until that is there: ${sentence}`, (t) => {
    const page = new Page(t);
    set(page, false);
    page.judging.begin(page.world.chosen, "metre");
    for (const _ of [1, 2]) {
      page.state();
      assert.deepEqual([page.said, page.name, page.runs], [sentence, "idle", 0]);
    }
    set(page, true);
    page.state();
    assert.equal(page.said, "");
  });
}

test("a refusal is shown until its cause is over, also if its state came a little later", (t) => {
  const page = reach(t, "asked");
  page.refuse("Why", "stopped"); // all causes: notice.test.js
  for (const [stopped, said] of [[false, "Why"], [true, "Why"], [true, "Why"], [false, ""]]) {
    page.state({ stopped });
    assert.equal(page.said, said, String(stopped));
  }
});

const RESULTS = { // what ends a score
  "another program is shown or runs": ({ judging }) => judging.forget(),
  "the robot is put back": (page) => page.report(null),
  "the robot gets another task": (page) => page.report({ state: "ready" }, "two"),
  "another robot is chosen": ({ world }) => { world.chosen = "/blue"; },
};
for (const [what, act] of Object.entries(RESULTS)) {
  test(`a score is shown until ${what}, and no judge hears of what programs do meanwhile`, (t) => {
    const page = reach(t, "ended");
    page.report(RESULT);
    page.judging.paused();
    page.going = true;
    page.end("Stopped.");
    page.judging.cancel();
    page.state();
    assert.deepEqual([page.said, page.take()], [POINTS, []]);
    act(page);
    page.state();
    assert.equal(page.said, "");
  });
}

test("a program that ends and has not driven is said, but not before the judge can have seen its drive", (t) => {
  const page = reach(t, "driving");
  page.end("");
  page.clock.freeze(4000);
  page.report({ state: "ready" });
  assert.equal(page.name, "ended");
  page.clock.freeze(1);
  page.report({ state: "ready" });
  assert.equal(page.said, "The program has ended, and the robot did not drive: no score.");
  assert.deepEqual([page.name, page.take()], ["idle", [END]]);
});
