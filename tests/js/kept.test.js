// What becomes of a change: it waits, is sent until the cockpit answers, and is kept, or the person reads why not.

import assert from "node:assert/strict";
import { test } from "node:test";

import { limits } from "#www/limits.js";
import { Kept } from "#www/program/kept.js";
import { clean, freeName } from "#www/program/names.js";

import { Clock } from "./clock.js";
import { LOST, playCockpit, refuse } from "./cockpit.js";

Object.assign(limits, { program: 1000, program_name: 40 });

const EMPTY = JSON.stringify({ blocks: { blocks: [] } });
const named = (name, program = EMPTY) => ({ name, program });
const kept = ({ version }) => ({ version: version + 1 });

// Returns a new program of this robot, the clock, what is asked, and the sentences that a person reads. answers: to the
// first requests, each at once or after so many ms; what follows them is kept
function begin(t, answers = [], robot = "/red", which = {}) {
  const state = { clock: new Clock(t), read: [] };
  state.asked = playCockpit(t, async (fields, times) => {
    const [answer, ms = 0] = answers[times - 1] ?? [kept(fields)];
    if (ms) await new Promise((resolve) => { setTimeout(resolve, ms); });
    return answer;
  });
  state.kept = new Kept(robot, which, ({ state: { text } }) => state.read.push(text));
  return state;
}

// Begins, and lets happen what follows: the ms that pass, and the names to which a person changes it, or its content.
async function play(t, answers, ...steps) {
  const page = begin(t, answers);
  for (const step of steps) {
    if (typeof step === "number") await page.clock.pass(step);
    else page.kept.change(step.name ? step : named(step));
  }
  return page;
}

const NO_ROOM = refuse(409, "There is no room.", "full");
const KEPT = ["Kept", undefined, undefined];
const NOT_YET = ["Not kept yet", undefined, true];
const again = (problem) => [`${problem} The page tries again.`, true, true];

const A = ["A", 1000];
for (const [what, answers, steps, asked, state] of [ // names and versions; the text, whether that is bad, and unsaved
  ["nothing is sent until nothing has changed for a second", [], ["A", 900, "B", 999], "", NOT_YET],
  ["what has not changed for a second is sent and kept", [], ["A", 900, "B", 1000], "B0", KEPT],
  ["without an answer the same is sent again every 3 s, and the person reads that",
    [[LOST], [LOST]], ["A", 4000], "A0 A0", again("The cockpit does not answer.")],
  ["without an answer the same is sent until it is kept", [[LOST], [LOST]], ["A", 7000], "A0 A0 A0", KEPT],
  ...Object.entries({ "no code yet": 403, "a disk that is busy": 503, "a full disk": 507 }).flatMap(([why, status]) => [
    [`after ${why} a person reads why`, [[refuse(status, "Not now.")]], A, "A0", again("Not now.")],
    [`after ${why} the same is sent again`, [[refuse(status, "Not now.")]], ["A", 4000], "A0 A0", KEPT],
  ]),
  ["what is changed while an answer is awaited waits for it, and a second more",
    [[{ version: 7 }, 4000]], [...A, "B", 4999], "A0", NOT_YET],
  ["what is changed while an answer is awaited is sent on the new version",
    [[{ version: 7 }, 4000]], [...A, "B", 5000], "A0 B7", KEPT],
  ["what was sent without an answer is sent again before anything newer",
    [[LOST]], [...A, "B", 5000], "A0 A0 B1", KEPT],
  ["what the cockpit refuses is not sent again", [[NO_ROOM]], ["A", 60000], "A0", ["There is no room.", true, true]],
  ["the next change after a refusal is sent", [[NO_ROOM]], ["A", 60000, "B", 1000], "A0 B0", KEPT],
  ["what is changed while the cockpit refuses the one before is sent",
    [[NO_ROOM, 500]], [...A, "B", 1500], "A0 B0", KEPT],
  ["a name is sent as the cockpit takes it", [], [" a\nb\u202e ", 1000, "\u200d", 1000, "👩‍👧 می‌خواهم", 1000],
    "ab0 Program1 👩‍👧 می‌خواهم2", KEPT],
]) {
  test(what, async (t) => {
    const page = await play(t, answers, ...steps);
    const { text, bad, unsaved } = page.kept.state;
    assert.equal(page.asked.map(({ name, version }) => name + version).join(" "), asked);
    const sent = [page.kept.id, EMPTY, "/red"];
    for (const { id, program, robot } of page.asked) assert.deepEqual([id, program, robot], sent);
    assert.deepEqual([text, bad, unsaved], state);
  });
}

for (const [what, content, sentence] of [
  ["too large", { blocks: { blocks: [] }, pad: "ä".repeat(500) }, /^Too large to be kept here/],
  ["no program", { blocks: { blocks: [{ type: "alien" }] } }, /does not know the block alien/],
]) {
  test(`what is ${what} is not even sent, and not called kept when the one before is`, async (t) => {
    const wrong = named("A", JSON.stringify(content));
    const { kept: { state }, asked } = await play(t, [[{ version: 1 }, 500]], "A", 1000, wrong, 5500);
    assert.equal(asked.length, 1);
    assert.match(state.text, sentence);
    assert.deepEqual([state.bad, state.unsaved], [true, true]);
  });
}

test("a change before there is a robot is sent when there is one", async (t) => {
  const { kept: program, clock, asked } = begin(t, [], null);
  program.change(named("A"));
  await clock.pass(60000);
  assert.equal(asked.length, 0);
  await program.belongTo("/blue");
  assert.deepEqual(asked.map(({ robot, name }) => [robot, name]), [["/blue", "A"]]);
});

const FAMILY = "👩‍👩‍👧‍👦"; // 11 UTF-16 units

for (const [where, Segmenter, cut] of [["a browser", Intl.Segmenter, ""],
  ["one that knows only code points", undefined, "👩‍👩‍👧"]]) {
  test(`in ${where}, a long name ends with a whole character`, (t) => {
    const before = Intl.Segmenter;
    t.after(() => { Intl.Segmenter = before; });
    Intl.Segmenter = Segmenter;
    assert.equal(clean("x".repeat(31) + FAMILY), "x".repeat(31) + cut);
    assert.equal(clean("x".repeat(29) + FAMILY), `${"x".repeat(29)}${FAMILY}`);
    assert.equal(clean(`${"x".repeat(39)}\u200d`), "x".repeat(39));
    const name = "x".repeat(29) + FAMILY;
    assert.equal(freeName(name, [{ name }]), `${"x".repeat(29)}${cut} 2`);
  });
}

test("a newer version of another page is said, and the next change is made of the version that is shown", async (t) => {
  const { kept: program, clock, asked, read } = begin(t, [[{ version: 9 }]], "/red", { version: 3 });
  program.compare({ version: 8 });
  assert.deepEqual([read.at(-1), program.state.newer], ["There is a newer version of this program.", 8]);
  program.change(named("Mine"));
  await clock.pass(1000);
  assert.deepEqual([asked[0].version, program.state.name, program.version], [3, "kept", 9]);
});

test("a list that is older than what was kept, or that comes before a change is kept, says nothing", async (t) => {
  const { kept: program, clock } = begin(t, [], "/red", { version: 3 });
  program.compare({ version: 2 });
  program.compare({ version: 3 });
  assert.equal(program.state.name, "unchanged");
  program.change(named("A"));
  program.compare({ version: 5 });
  assert.equal(program.state.name, "waiting");
  await clock.pass(1000);
  assert.equal(program.state.name, "kept");
});

test("a new program has a name that no other one of the robot has", () => {
  const rows = ["my program", "Square", "Square 2", "Lesson 7", "x".repeat(40)].map((name) => ({ name }));
  const names = ["Circle", "my program", "Square", "Square 2", "Lesson 7", "x".repeat(40)];
  assert.deepEqual(names.map((name) => freeName(name, rows)),
                   ["Circle", "my program 2", "Square 3", "Square 3", "Lesson 8", `${"x".repeat(38)} 2`]);
  assert.equal(freeName("my program", [{ name: "my program", deleted: true }]), "my program", "that one is gone");
});
