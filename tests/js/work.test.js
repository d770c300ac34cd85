// Which program is shown, and that nothing that a person has made is lost: not by a reload, a restart of the cockpit,
// another robot, or another page.

import assert from "node:assert/strict";
import { test } from "node:test";

import { limits } from "#www/limits.js";
import { Work } from "#www/program/work.js";

import { Clock, settled } from "./clock.js";
import { later, LOST, playCockpit, refuse } from "./cockpit.js";

Object.assign(limits, { program: 1000, program_name: 40 });

const EMPTY = JSON.stringify({ blocks: { blocks: [] } });
const text = (variable) => JSON.stringify({ blocks: { blocks: [] }, variables: [{ name: variable, id: "x" }] });
const ID = { square: "5".repeat(16), star: "6".repeat(16) };
const BAD = "not to be shown";
const NEW = "Not kept until you change it.";
const WAITS = "A change waits on this device for its own class.";

// A cockpit with these programs: { id, robot, name, program, version }; the newest change first; and with this class.
function cockpit(t, programs = [], classId = null) {
  const state = { programs, classId, online: true, refuses: null };
  const answers = {
    list: ({ robot }) => ({ class: state.classId, programs: state.programs.filter((each) => each.robot === robot) }),
    open: ({ id }) => {
      const found = state.programs.find((each) => each.id === id);
      return found ? { class: state.classId, ...found } : refuse(409, "This program is gone.");
    },
    save: ({ version, do: _, ...fields }) => {
      if (![null, undefined, state.classId].includes(fields.class)) return refuse(409, "Another class.", "other_class");
      const saved = { ...fields, class: state.classId, version: version + 1, deleted: false };
      state.programs = [saved, ...state.programs.filter(({ id }) => id !== fields.id)];
      return saved;
    },
    delete: ({ id }) => change(id, { deleted: true }),
    restore: ({ id }) => change(id, { deleted: false }),
  };
  const change = (id, fields) => {
    const changed = { ...state.programs.find((each) => each.id === id), ...fields };
    state.programs = [changed, ...state.programs.filter((each) => each.id !== id)];
    return changed;
  };
  state.asked = playCockpit(t, (fields) => (!state.online ? LOST : state.refuses ?? answers[fields.do](fields)));
  state.saves = () => state.asked.filter((each) => each.do === "save");
  state.saved = () => state.saves().map(({ id, name }) => [id, name]);
  state.names = () => state.programs.filter(({ deleted }) => !deleted).map(({ name }) => name).sort();
  return state;
}

// A page, as it is after the first robot has come; storage: what its device keeps.
function openPage(storage = new Map(), robot = "/red") {
  const [getItem, setItem] = [(key) => storage.get(key) ?? null, (key, value) => storage.set(key, value)];
  globalThis.localStorage = { getItem, setItem };
  const page = { storage, said: "", newer: false, rows: [], locked: false, name: "", program: "", changes: 0 };
  page.work = new Work({
    show(name, program) {
      if (program === BAD) return false;
      Object.assign(page, { name, program });
      page.work.changed(); // as the page does while it shows them
      return true;
    },
    current: () => ({ name: page.name, program: page.program }),
    lock: (on) => { page.locked = on; },
    list(rows) {
      const marked = rows.filter(({ id, version }) => page.work.isShown(id, version)).map(({ name }) => name);
      Object.assign(page, { rows, marked });
    },
    say: (said, bad, newer) => Object.assign(page, { said, newer }),
  });
  page.edit = (name) => {
    page.name = name;
    page.work.changed();
  };
  page.hear = (of = robot) => {
    page.work.update(of, page.changes += 1);
    return settled();
  };
  page.work.restore("my program", EMPTY);
  return page;
}

const square = (fields) => ({ id: ID.square, robot: "/red", name: "Square", program: text("s"), version: 3,
  deleted: false, ...fields });

test("a page that is opened shows the robot's newest program, which is saved once it is changed", async (t) => {
  const clock = new Clock(t);
  const { saved, saves } = cockpit(t, [square({ id: ID.star, deleted: true }), square()]);
  const page = openPage();
  await page.hear();
  assert.deepEqual([page.name, page.program], ["Square", text("s")]);
  await clock.pass(60000);
  assert.deepEqual(saved(), [], "what is only shown is not saved");
  page.edit("Larger square");
  await clock.pass(1000);
  assert.deepEqual(saved(), [[ID.square, "Larger square"]]);
  assert.equal(saves()[0].version, 3);
});

test("what is kept stays as an earlier version of what is to replace it, unless it is not kept yet", async (t) => {
  const clock = new Clock(t);
  const { saves } = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  page.edit("As text");
  assert.equal(page.work.keepEarlier(), "Not kept yet");
  await clock.pass(1000);
  assert.equal(page.work.keepEarlier(), "");
  page.edit("As blocks");
  await clock.pass(1000);
  assert.deepEqual(saves().map(({ id, version, name }) => [id, version, name]),
    [[ID.square, 3, "As text"], [ID.square, 0, "As blocks"]]);
});

test("what a person has begun before the first list comes stays", async (t) => {
  const clock = new Clock(t);
  const { saved } = cockpit(t, [square()]);
  const page = openPage();
  page.edit("Mine");
  await page.hear();
  await clock.pass(1000);
  assert.equal(page.name, "Mine");
  assert.deepEqual(saved(), [[page.work.kept.id, "Mine"]]);
});

test("an example that was opened before the first list comes stays", async (t) => {
  cockpit(t, [square()]);
  const page = openPage();
  page.work.add("Zigzag", EMPTY);
  await page.hear();
  assert.equal(page.name, "Zigzag");
});

for (const [does, act, name] of [
  ["opens", ({ work }) => work.addFile("Zigzag", EMPTY), "Zigzag"],
  ["changes", (page) => page.edit("Mine"), "Mine"],
  ["does nothing", () => {}, "Square"],
]) test(`while the newest program is fetched, a person ${does}: the page shows ${name}`, async (t) => {
  new Clock(t);
  const { promise, answer } = later();
  const state = cockpit(t, [square()]);
  const page = openPage();
  const listed = page.hear();
  state.refuses = promise;
  await listed;
  state.refuses = null;
  act(page);
  await page.hear();
  await answer(square());
  assert.equal(page.name, name);
});

test("a file that is opened is kept, unless it cannot be shown", async (t) => {
  const clock = new Clock(t);
  const { saves } = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  page.work.addFile("Bad", BAD);
  page.work.addFile("Square", text("f"));
  await clock.pass(1000);
  assert.deepEqual(saves().map(({ name, program }) => [name, program]), [["Square 2", text("f")]]);
  assert.equal(page.said, "Kept");
});

test("of a new program a person reads that it is not kept, and of an opened one nothing", async (t) => {
  const clock = new Clock(t);
  const { saved } = cockpit(t, [square()]);
  const page = openPage();
  assert.equal(page.said, NEW);
  await page.hear();
  assert.equal(page.said, "");
  page.work.add("Zigzag", EMPTY);
  await clock.pass(60000);
  assert.deepEqual([page.said, saved()], [NEW, []]);
});

test("all that was made before there is a robot is kept for the first one", async (t) => {
  const clock = new Clock(t);
  const { saved } = cockpit(t);
  const page = openPage();
  page.edit("One");
  page.work.add("my program", EMPTY);
  page.edit("Two");
  await page.hear();
  await clock.pass(1000);
  assert.deepEqual(saved().map(([, name]) => name), ["One", "Two"]);
});

test("new programs are numbered, also while the one before is not in the list yet", async (t) => {
  const clock = new Clock(t);
  const { saved } = cockpit(t, [square({ name: "my program" })]);
  const page = openPage();
  await page.hear();
  page.work.add("my program", EMPTY);
  page.work.add("my program", EMPTY);
  assert.equal(page.name, "my program 2", "one that is not changed is not kept");
  page.program = text("a");
  page.work.changed();
  page.work.add("my program", EMPTY);
  page.program = text("b");
  page.work.changed();
  await clock.pass(1000);
  assert.deepEqual(saved().map(([, name]) => name), ["my program 2", "my program 3"]);
});

test("what could not be sent is there after a reload, and is kept then", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  state.online = false;
  page.edit("Offline");
  await clock.pass(10000);
  assert.equal(page.said, "The cockpit does not answer. The page tries again.");
  t.mock.restoreAll();
  const [next, again] = [new Clock(t), cockpit(t, [square({ version: 4, name: "Theirs" })])];
  const reloaded = openPage(page.storage);
  await reloaded.hear();
  assert.equal(reloaded.name, "Offline");
  await next.pass(1000);
  assert.deepEqual(again.saves().map(({ id, version, name }) => [id, version, name]),
                   [[ID.square, 3, "Offline"]], "on the version of which it was made");
});

test("after a reload, what another page has made newer is shown if nothing here is unsaved", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  page.edit("Mine");
  await clock.pass(1000);
  state.programs = [square({ version: 9, name: "Theirs" })];
  const reloaded = openPage(page.storage);
  assert.equal(reloaded.name, "Mine");
  await reloaded.hear();
  assert.equal(reloaded.name, "Theirs");
});

test("a newer version of another page is named while this one is open, and shown when a person wants it", async (t) => {
  new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  state.programs = [square({ version: 5, name: "Theirs" })];
  await page.hear();
  assert.deepEqual([page.name, page.said, page.newer], ["Square", "There is a newer version of this program.", true]);
  await page.work.openNewer({ id: ID.square, version: page.work.kept.state.newer });
  assert.deepEqual([page.name, page.said, page.newer, state.asked.at(-1).version], ["Theirs", "", false, 5]);
});

test("what is made of a version that was replaced while it was opened is saved as one of the newest", async (t) => {
  const clock = new Clock(t);
  const { saves } = cockpit(t, [square({ version: 6 })]);
  const page = openPage();
  page.work.add("my program", EMPTY);
  await page.hear();
  await page.work.open(ID.square, 5);
  page.edit("Larger square");
  await clock.pass(1000);
  assert.equal(saves()[0].version, 6);
});

test("a cockpit that was started again, and has nothing, gets what is shown", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  state.programs = [];
  await page.hear();
  await clock.pass(1000);
  assert.deepEqual(state.saved(), [[ID.square, "Square"]]);
});

test("for another robot its programs are shown, and what waits for the first one is kept for that", async (t) => {
  const clock = new Clock(t);
  const { saves } = cockpit(t, [square({ robot: "/blue" })]);
  const page = openPage();
  await page.hear();
  page.edit("Mine");
  await page.hear("/blue");
  assert.equal(page.name, "Square");
  page.edit("Blue");
  await clock.pass(1000);
  assert.deepEqual(saves().map(({ robot, name }) => [robot, name]), [["/red", "Mine"], ["/blue", "Blue"]]);
});

test("what the cockpit has refused is shown again for its robot, and named while another is shown", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t);
  const page = openPage();
  await page.hear();
  page.edit("Mine");
  state.refuses = refuse(409, "There is no room.");
  page.work.add("my program", EMPTY);
  await settled();
  assert.equal(page.said, "Mine: There is no room.");
  page.edit("Second");
  await clock.pass(1000);
  state.refuses = null;
  await page.hear("/blue");
  await page.hear("/red");
  assert.equal(page.name, "Second");
  await clock.pass(1000);
  assert.deepEqual(state.programs.map(({ name }) => name), ["Second"]);
});

test("what the cockpit refuses of one robot's programs is not said beside another robot's", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t);
  const page = openPage();
  await page.hear();
  state.refuses = refuse(409, "There is no room.");
  page.edit("Mine");
  await clock.pass(1000);
  assert.equal(page.said, "There is no room.");
  await page.hear("/blue");
  const again = openPage();
  await again.hear("/blue");
  await clock.pass(1000);
  assert.deepEqual([page.said, again.said], [NEW, NEW]);
});

test("what is said of a program that is not shown goes once that is kept", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  state.online = false;
  page.edit("Mine");
  page.work.add("Other", EMPTY);
  await settled();
  assert.equal(page.said, "Mine: The cockpit does not answer. The page tries again.");
  state.online = true;
  await clock.pass(3000);
  assert.deepEqual([state.saves().at(-1).name, page.said], ["Mine", NEW]);
});

test("a program of which the answer comes after another robot was chosen is not shown there", async (t) => {
  new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  page.work.add("my program", EMPTY);
  const { promise, answer } = later();
  state.refuses = promise;
  const opened = page.work.open(ID.square);
  state.refuses = null;
  await page.hear("/blue");
  await answer(square());
  await opened;
  assert.equal(page.name, "my program");
});

test("what cannot be shown changes neither what is shown nor where that is kept", async (t) => {
  const clock = new Clock(t);
  const { saved } = cockpit(t, [square(), square({ id: ID.star, program: BAD })]);
  const page = openPage();
  await page.hear();
  await page.work.open(ID.star);
  page.edit("Larger square");
  await clock.pass(1000);
  assert.deepEqual(saved(), [[ID.square, "Larger square"]]);
});

test("what is to look at only is locked and never saved; what is shown next is not locked", async (t) => {
  const clock = new Clock(t);
  const { saved } = cockpit(t, [square({ robot: "/blue" })]);
  const page = openPage();
  await page.hear();
  await page.work.look({ robot: "/blue", id: ID.square });
  assert.deepEqual([page.locked, page.said], [true, "You can look at this program, but not change it."]);
  await page.hear();
  page.edit("Changed");
  await clock.pass(1000);
  assert.deepEqual(saved(), []);
  page.work.add("my program", EMPTY);
  assert.equal(page.locked, false);
});

test("a change comes before the person's Delete, and does not bring the program back after it", async (t) => {
  const clock = new Clock(t);
  const { asked } = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  page.edit("Last change");
  await page.work.remove(square());
  await clock.pass(60000);
  assert.deepEqual(asked.map((each) => each.do).filter((each) => each !== "list").slice(-2), ["save", "delete"]);
  page.edit("A new one");
  await clock.pass(1000);
  assert.notEqual(asked.at(-1).id, ID.square);
});

test("for a program that is deleted the newest other one is shown, and it stays after Undo", async (t) => {
  const clock = new Clock(t);
  const { saved, names } = cockpit(t, [square(), square({ id: ID.star, name: "Star", program: text("t") })]);
  const page = openPage();
  await page.hear();
  await page.work.remove(square());
  await settled();
  assert.deepEqual([page.name, page.program, page.marked], ["Star", text("t"), ["Star"]]);
  await page.work.undo(square({ deleted: true }));
  page.edit("Larger star");
  await clock.pass(1000);
  assert.deepEqual([saved(), names()], [[[ID.star, "Larger star"]], ["Larger star", "Square"]]);
});

test("Undo shows the only program again, and a change of it makes no second one", async (t) => {
  const clock = new Clock(t);
  const { names } = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  await page.work.remove(square());
  assert.deepEqual([page.name, page.program], ["my program", EMPTY]);
  await page.work.undo(square({ deleted: true }));
  assert.deepEqual([page.name, page.marked], ["Square", ["Square"]]);
  page.program = text("larger");
  page.work.changed();
  await clock.pass(1000);
  assert.deepEqual(names(), ["Square"]);
});

test("what has a deleted program's name keeps it, and Undo brings that one back under a free one", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square({ name: "my program" })]);
  const page = openPage();
  await page.hear();
  await page.work.remove(square());
  page.program = text("new");
  page.work.changed();
  await page.work.undo(square({ name: "my program", deleted: true }));
  await clock.pass(1000);
  assert.deepEqual([page.name, page.program], ["my program", text("new")]);
  assert.deepEqual(state.names(), ["my program", "my program 2"]);
  assert.equal(state.programs.find(({ id }) => id === ID.square).program, text("s"));
});

test("a change that the cockpit has refused goes with the program when a person deletes that", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  await page.hear();
  state.refuses = refuse(409, "There is no room.");
  page.edit("Larger square");
  await clock.pass(1000);
  state.refuses = null;
  await page.work.remove(square());
  const reloaded = openPage(page.storage);
  await reloaded.hear();
  await clock.pass(60000);
  assert.deepEqual([page.name, reloaded.name, state.names()], ["my program", "my program", []]);
});

test("a list that does not come is asked for again, and one of another robot is not shown", async (t) => {
  new Clock(t);
  const state = cockpit(t, [square()]);
  const page = openPage();
  state.online = false;
  await page.hear();
  state.online = true;
  page.work.update("/red", page.changes);
  await settled();
  assert.equal(page.name, "Square");
  const { promise, answer } = later();
  state.refuses = promise;
  await page.hear();
  state.refuses = null;
  await page.hear("/blue");
  await answer({ programs: [square()] });
  assert.deepEqual(page.rows, []);
});

// A page of class A on which this program was opened and, if there is a name, renamed.
async function openInClassA(clock, state, name) {
  const page = openPage();
  await page.hear();
  if (name) page.edit(name);
  await clock.pass(1000);
  assert.equal(page.name, name || "Square");
  return page;
}

for (const [what, name, again] of [["stays open", "", (page) => page],
  ["has changed one and stays open", "Kept", (page) => page],
  ["is opened again", "Kept", (page) => openPage(page.storage)]]) {
  test(`once a class was deleted, a page that ${what} neither shows nor sends its programs`, async (t) => {
    const clock = new Clock(t);
    const state = cockpit(t, [square()], "a");
    const page = await openInClassA(clock, state, name);
    Object.assign(state, { programs: [], classId: "b" });
    const after = again(page);
    after.work.connected();
    after.work.update("/red", page.changes);
    await settled();
    await clock.pass(60000);
    assert.deepEqual([after.name, after.program, state.programs], ["my program", EMPTY, []]);
    assert.doesNotMatch([...after.storage.values()].join(), /Kept|Square/, "nor does the device keep them");
    after.edit("New");
    await clock.pass(1000);
    assert.deepEqual(state.programs.map(({ name }) => name), ["New"]);
  });
}

// The page is closed, and opened again a minute later, with a cockpit that has these programs and this class.
async function reopen(t, page, programs, classId) {
  t.mock.restoreAll();
  const [clock, state] = [new Clock(t), cockpit(t, programs, classId)];
  const opened = openPage(page.storage);
  await opened.hear();
  await clock.pass(60000);
  return [opened, state.programs.map(({ name }) => name), state.saves().length];
}

test("a change that was not sent waits on the device while another class has its lesson", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()], "a");
  const page = await openInClassA(clock, state);
  state.online = false;
  page.work.add("my program", EMPTY);
  page.edit("Before the bell");
  await clock.pass(2000);
  const [other, theirs] = await reopen(t, page, [], "b");
  assert.deepEqual([other.name, other.said, theirs], ["my program", WAITS, []]);
  assert.equal(openPage(other.storage).name, "my program", "also without the cockpit");
  const [own, ours] = await reopen(t, other, [square()], "a");
  assert.deepEqual([own.name, ours], ["Before the bell", ["Before the bell", "Square"]]);
});

test("what waits for a class is sent once that is back; what was made meanwhile has a free name there", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square({ name: "Zigzag" })], "a");
  const page = await openInClassA(clock, state, "Zigzag");
  const own = state.programs;
  state.online = false;
  page.work.add("Zigzag", text("own"));
  page.program = text("changed");
  page.work.changed();
  await clock.pass(2000);
  Object.assign(state, { programs: [], classId: null, online: true });
  await clock.pass(3000);
  await page.hear();
  assert.deepEqual([page.name, page.said, state.programs], ["my program", WAITS, []]);
  page.work.add("Zigzag", EMPTY);
  page.program = text("z");
  page.work.changed();
  await clock.pass(1000);
  Object.assign(state, { programs: own, classId: "a" });
  await page.hear();
  await clock.pass(1000);
  assert.deepEqual(state.programs.map(({ name, program }) => [name, program]).sort(),
                   [["Zigzag 2", text("changed")], ["Zigzag 3", text("z")], ["Zigzag", text("s")]]);
  assert.deepEqual([page.name, page.program], ["Zigzag 3", text("z")]);
  assert.doesNotMatch([...page.storage.values()].join(), /"unsaved":true/, "nothing waits any more");
});

test("what its class has once that was back is not sent again after a reload", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()], "a");
  const page = await openInClassA(clock, state);
  page.edit("Mine");
  for (const [classId, programs] of [[null, []], ["a", state.programs]]) {
    Object.assign(state, { classId, programs });
    await page.hear();
    await clock.pass(3000);
  }
  assert.deepEqual(state.names(), ["Mine"]);
  const [again, names] = await reopen(t, page, [square({ name: "Theirs", version: 9 })], "a");
  assert.deepEqual([again.name, names], ["Theirs", ["Theirs"]]);
});

test("new programs are numbered, also while none can be sent", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t);
  const page = openPage();
  await page.hear();
  state.online = false;
  for (const variable of ["a", "b", "c"]) {
    page.work.add("my program", EMPTY);
    page.program = text(variable);
    page.work.changed();
  }
  state.online = true;
  await clock.pass(4000);
  assert.deepEqual(state.names(), ["my program", "my program 2", "my program 3"]);
});

test("ten minutes without a network, and a reload, lose nothing", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()], "a");
  const page = await openInClassA(clock, state);
  state.online = false;
  page.edit("Offline");
  await clock.pass(600000);
  const [again, names] = await reopen(t, page, [square()], "a");
  assert.deepEqual([again.name, names], ["Offline", ["Offline"]]);
});

test("without a network, programs that are left for others are all sent after a reload", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()], "a");
  const page = await openInClassA(clock, state);
  state.online = false;
  page.edit("Larger square");
  for (const name of ["Two", "Three"]) {
    page.work.add("my program", EMPTY);
    page.edit(name);
  }
  await clock.pass(10000);
  const [again, names, saves] = await reopen(t, page, [square()], "a");
  assert.deepEqual([again.name, names.sort(), saves], ["Three", ["Larger square", "Three", "Two"], 3]);
  const [, later] = await reopen(t, again, [square({ name: "Theirs", version: 9 })], "a");
  assert.deepEqual(later, ["Theirs"], "what the cockpit has is not sent again");
});

test("before there is a robot, programs that are left for others are all kept after a reload", async (t) => {
  new Clock(t);
  cockpit(t);
  const page = openPage();
  page.edit("One");
  page.work.add("my program", EMPTY);
  page.edit("Two");
  const [again, names] = await reopen(t, page, [], null);
  assert.deepEqual([again.name, names.sort()], ["Two", ["One", "Two"]]);
});

test("a program from a file has a name that the cockpit takes", (t) => {
  new Clock(t);
  cockpit(t);
  const page = openPage();
  page.work.add(`${"x".repeat(39)}🙂`, EMPTY);
  assert.equal(page.name, "x".repeat(39));
});

test("what was made in a cockpit without a class goes into the class with which it is started again", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()]);
  const page = await openInClassA(clock, state, "Mine");
  Object.assign(state, { programs: [], classId: "a" });
  page.work.connected();
  await page.hear();
  await clock.pass(1000);
  assert.deepEqual(state.programs.map(({ name }) => name), ["Mine"]);
  assert.deepEqual([...page.storage.values()].filter((text) => text.includes("Mine")).length, 1);
});

test("a deleted program that has made room for others is not sent again", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()], "a");
  const page = await openInClassA(clock, state, "Mine");
  state.programs = [];
  await page.hear();
  await clock.pass(60000);
  assert.deepEqual([page.name, state.programs], ["Mine", []]);
});

test("a program that was deleted while the page was away is not shown again", async (t) => {
  const clock = new Clock(t);
  const state = cockpit(t, [square()], "a");
  const page = await openInClassA(clock, state, "Mine");
  state.programs = [square({ name: "Mine", deleted: true, version: 4 })];
  const reloaded = openPage(page.storage);
  await reloaded.hear();
  assert.equal(reloaded.name, "my program");
});

test("whatever lies on the device, the page opens", (t) => {
  new Clock(t);
  cockpit(t);
  assert.equal(openPage(new Map([["unsaved programs", '[null, 7, {"program": 7}]']])).name, "my program");
  for (const left of ["", "x", "null", "[]", '{"program": 7}', '{"program": "{}", "id": "../x"}']) {
    assert.equal(openPage(new Map([["last program", "program /red"], ["program /red", left]])).name, "my program");
  }
});
