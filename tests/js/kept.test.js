// What becomes of a change: it waits, is sent until the cockpit answers, and is kept, or the person reads why not.

import assert from "node:assert/strict";
import { test } from "node:test";

import { limits } from "#www/limits.js";
import { Kept } from "#www/program/kept.js";
import { clean, freeName } from "#www/program/names.js";

import { Clock } from "./clock.js";
import { later, LOST, playCockpit, refuse } from "./cockpit.js";

Object.assign(limits, { program: 1000, program_name: 40 });

const EMPTY = JSON.stringify({ blocks: { blocks: [] } });
const named = (name, program = EMPTY) => ({ name, program });
const kept = ({ version }) => ({ version: version + 1 });

// Returns a new program of this robot, the clock, what is asked, and the sentences that a person reads.
function begin(t, answer = kept, robot = "/red", which = {}) {
  const state = { clock: new Clock(t), asked: playCockpit(t, answer), read: [] };
  state.kept = new Kept(robot, which, ({ state: { text } }) => state.read.push(text));
  return state;
}

test("a change is sent once nothing has changed for a second, and then it is kept", async (t) => {
  const { kept: program, clock, asked, read } = begin(t);
  program.change(named("A"));
  await clock.pass(900);
  program.change(named("AB"));
  await clock.pass(999);
  assert.equal(asked.length, 0);
  await clock.pass(1);
  assert.deepEqual(asked, [
    { do: "save", class: null, robot: "/red", id: program.id, version: 0, name: "AB", program: EMPTY }]);
  assert.deepEqual(read, ["Not kept yet", "Not kept yet", "Not kept yet", "Kept"]);
  assert.equal(program.version, 1);
});

test("without an answer the same is sent again every 3 s, and the person reads that until it is kept", async (t) => {
  const { kept: program, clock, asked, read } = begin(t, (fields, times) => (times < 3 ? LOST : kept(fields)));
  program.change(named("A"));
  await clock.pass(1000 + 3000);
  assert.equal(read.at(-1), "The cockpit does not answer. The page tries again.");
  assert.equal(program.state.unsaved, true);
  await clock.pass(3000);
  assert.deepEqual(asked, Array(3).fill(asked[0]));
  assert.equal(read.at(-1), "Kept");
});

for (const [what, status] of [["no code yet", 403], ["a disk that is busy", 503], ["a full disk", 507]]) {
  test(`after ${what} the same is sent again, and the person reads the cockpit's sentence meanwhile`, async (t) => {
    const { kept: program, clock, read } = begin(t, (fields, times) => (
      times < 2 ? refuse(status, "Not now.") : kept(fields)));
    program.change(named("A"));
    await clock.pass(1000);
    assert.deepEqual([program.state.text, program.state.bad], ["Not now. The page tries again.", true]);
    await clock.pass(3000);
    assert.equal(read.at(-1), "Kept");
  });
}

test("what is changed while an answer is awaited is sent after it, on the new version", async (t) => {
  const answers = [later(), later()];
  const { kept: program, clock, asked } = begin(t, (fields, times) => answers[times - 1].promise);
  program.change(named("A"));
  await clock.pass(1000);
  program.change(named("B"));
  await clock.pass(5000);
  assert.equal(asked.length, 1);
  await answers[0].answer({ version: 7 });
  assert.equal(program.state.name, "waiting");
  await clock.pass(1000);
  assert.deepEqual(asked.map(({ name, version }) => [name, version]), [["A", 0], ["B", 7]]);
});

test("what was sent without an answer is sent again before anything newer", async (t) => {
  const { kept: program, clock, asked } = begin(t, (fields, times) => (times < 2 ? LOST : kept(fields)));
  program.change(named("A"));
  await clock.pass(1000);
  program.change(named("B"));
  await clock.pass(5000);
  assert.deepEqual(asked.map(({ name, version }) => [name, version]), [["A", 0], ["A", 0], ["B", 1]]);
});

test("what the cockpit refuses is not sent again, but the next change is", async (t) => {
  const { kept: program, clock, asked, read } = begin(t, (fields, times) => (
    times < 2 ? refuse(409, "There is no room.", "full") : kept(fields)));
  program.change(named("A"));
  await clock.pass(60000);
  assert.equal(asked.length, 1);
  assert.deepEqual([program.state.name, read.at(-1)], ["refused", "There is no room."]);
  program.change(named("B"));
  await clock.pass(1000);
  assert.equal(read.at(-1), "Kept");
});

test("what is changed while the cockpit refuses the one before is sent", async (t) => {
  const first = later();
  const { kept: program, clock, asked } = begin(t, (fields, times) => (times < 2 ? first.promise : kept(fields)));
  program.change(named("A"));
  await clock.pass(1000);
  program.change(named("B"));
  await first.answer(refuse(409, "This is no program."));
  await clock.pass(1000);
  assert.deepEqual([asked.length, program.state.name], [2, "kept"]);
});

for (const [what, text, sentence] of [
  ["too large", JSON.stringify({ blocks: { blocks: [] }, pad: "ä".repeat(500) }), /^Too large to be kept here/],
  ["no program", '{"blocks":{"blocks":[{"type":"alien"}]}}', /does not know the block alien/],
]) {
  test(`what is ${what} is not even sent, and not called kept when the one before is`, async (t) => {
    const first = later();
    const { kept: program, clock, asked } = begin(t, () => first.promise);
    program.change(named("A"));
    await clock.pass(1000);
    program.change(named("A", text));
    await first.answer({ version: 1 });
    await clock.pass(5000);
    assert.equal(asked.length, 1);
    assert.match(program.state.text, sentence);
    assert.deepEqual([program.state.bad, program.state.unsaved], [true, true]);
  });
}

test("a change before there is a robot is sent when there is one", async (t) => {
  const { kept: program, clock, asked } = begin(t, kept, null);
  program.change(named("A"));
  await clock.pass(60000);
  assert.equal(asked.length, 0);
  await program.belongTo("/blue");
  assert.deepEqual(asked.map(({ robot, name }) => [robot, name]), [["/blue", "A"]]);
});

test("a name is sent as the cockpit takes it", async (t) => {
  const { kept: program, clock, asked } = begin(t);
  for (const name of [" a\nb\u202e ", "", "\u200d", "👩‍👧 می‌خواهم", "x".repeat(50)]) {
    program.change(named(name));
    await clock.pass(1000);
  }
  assert.deepEqual(asked.map(({ name }) => name), ["ab", "Program", "Program", "👩‍👧 می‌خواهم", "x".repeat(40)]);
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
  const { kept: program, clock, asked, read } = begin(t, () => ({ version: 9 }), "/red", { version: 3 });
  program.compare({ version: 8 });
  assert.deepEqual([read.at(-1), program.state.newer], ["There is a newer version of this program.", 8]);
  program.change(named("Mine"));
  await clock.pass(1000);
  assert.deepEqual([asked[0].version, program.state.name, program.version], [3, "kept", 9]);
});

test("a list that is older than what was kept, or that comes before a change is kept, says nothing", async (t) => {
  const { kept: program, clock } = begin(t, kept, "/red", { version: 3 });
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
