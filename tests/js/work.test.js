// Which program is shown, and that nothing that a person has made is lost: not by a reload, a restart of the cockpit,
// another robot, or another page.

import assert from "node:assert/strict";
import { test } from "node:test";

import { limits } from "#www/limits.js";
import { Work } from "#www/program/work.js";

import { Clock, settled } from "./clock.js";
import { later, LOST, playCockpit, refuse } from "./cockpit.js";
import { stream } from "./random_programs.js";

Object.assign(limits, { program: 1000, program_name: 40 });

const EMPTY = JSON.stringify({ blocks: { blocks: [] } });
const text = (variable) => JSON.stringify({ blocks: { blocks: [] }, variables: [{ name: variable, id: "x" }] });
const ID = { square: "5".repeat(16), star: "6".repeat(16) };
const BAD = "not to be shown";
const NEW = "Not kept until you change it.";
const WAITS = "A change waits on this device for its own class.";
const NO_ROOM = refuse(409, "There is no room.");

const square = (fields) => ({ id: ID.square, robot: "/red", name: "Square", program: text("s"), version: 3,
  deleted: false, ...fields });

// A cockpit with these programs: { id, robot, name, program, version }; the newest change first; and with this class.
function cockpit(t, programs, classId) {
  const state = { programs, classId, online: true, refuses: null, conflicts: [] };
  const find = (id) => state.programs.find((each) => each.id === id);
  const put = (changed) => {
    state.programs = [changed, ...state.programs.filter(({ id }) => id !== changed.id)];
    return changed;
  };
  const answers = {
    list: ({ robot }) => ({ class: state.classId, programs: state.programs.filter((each) => each.robot === robot) }),
    open: ({ id }) => (find(id) ? { class: state.classId, ...find(id) } : refuse(409, "This program is gone.")),
    save: ({ version, do: _, ...fields }) => {
      if (![null, undefined, state.classId].includes(fields.class)) return refuse(409, "Another class.", "other_class");
      if (version < find(fields.id)?.version) state.conflicts.push(fields.name);
      return put({ ...fields, class: state.classId, version: version + 1, deleted: false });
    },
    delete: ({ id }) => put({ ...find(id), deleted: true }),
    restore: ({ id }) => put({ ...find(id), deleted: false }),
  };
  state.asked = playCockpit(t, (fields) => (!state.online ? LOST : state.refuses ?? answers[fields.do](fields)));
  state.saves = (...keys) => state.asked.filter((each) => each.do === "save")
    .map((each) => keys.map((key) => each[key]));
  state.names = () => state.programs.filter(({ deleted }) => !deleted).map(({ name }) => name).sort();
  return state;
}

// A page, as it is before its robot has come; storage: what its device keeps.
class Page {
  said = "";
  newer = false;
  rows = []; // of its robot's programs
  marked = []; // the names of those that are shown
  locked = false;
  changes = 0; // to the robots' programs

  constructor(storage = new Map()) {
    this.storage = storage;
    const [getItem, setItem] = [(key) => storage.get(key) ?? null, (key, value) => storage.set(key, value)];
    globalThis.localStorage = { getItem, setItem };
    this.work = new Work({
      show: (name, program) => this.show(name, program), current: () => ({ name: this.name, program: this.program }),
      lock: (locked) => Object.assign(this, { locked }), list: (rows) => this.list(rows),
      say: (said, bad, newer) => Object.assign(this, { said, newer }),
    });
    this.work.restore("my program", EMPTY);
  }

  show(name, program) {
    if (program === BAD) return false;
    Object.assign(this, { name, program });
    this.work.changed(); // as the page does while it shows them
    return true;
  }

  list(rows) {
    this.rows = rows;
    this.marked = rows.filter(({ id, version }) => this.work.isShown(id, version)).map(({ name }) => name);
  }

  get shown() {
    return [this.name, this.program];
  }

  // A person changes what is shown.
  edit(name, program = this.program) {
    Object.assign(this, { name, program });
    this.work.changed();
  }

  // A person begins a program, and puts blocks into it.
  make(program, name = "my program") {
    this.work.add(name, EMPTY);
    this.edit(this.name, program);
  }

  // A state arrives: there are changes to this robot's programs.
  hear(robot = "/red") {
    this.work.update(robot, this.changes += 1);
    return settled();
  }
}

// Opens a page beside a cockpit with these programs and this class; listed: and lets it have its robot's first list.
async function open(t, { has = [square()], classId = null, storage = undefined, listed = true } = {}) {
  t.mock.restoreAll(); // what an earlier page has begun
  const lesson = { clock: new Clock(t), state: cockpit(t, has, classId), page: new Page(storage) };
  if (listed) await lesson.page.hear();
  return lesson;
}

test("a page that is opened shows the robot's newest program, which is saved once it is changed", async (t) => {
  const { clock, state, page } = await open(t, { has: [square({ id: ID.star, deleted: true }), square()] });
  assert.deepEqual(page.shown, ["Square", text("s")]);
  await clock.pass(60000);
  assert.deepEqual(state.saves(), [], "what is only shown is not saved");
  page.edit("Larger square");
  await clock.pass(1000);
  assert.deepEqual(state.saves("id", "version", "name"), [[ID.square, 3, "Larger square"]]);
});

test("what is kept stays as an earlier version of what is to replace it, unless it is not kept yet", async (t) => {
  const { clock, state, page } = await open(t);
  page.edit("As text");
  assert.equal(page.work.keepEarlier(), "Not kept yet");
  await clock.pass(1000);
  assert.equal(page.work.keepEarlier(), "");
  page.edit("As blocks");
  await clock.pass(1000);
  assert.deepEqual(state.saves("id", "version", "name"), [[ID.square, 3, "As text"], [ID.square, 0, "As blocks"]]);
});

for (const [does, act, name, saved] of [
  ["opens an example", ({ work }) => work.add("Zigzag", EMPTY), "Zigzag", []],
  ["changes something", (page) => page.edit("Mine"), "Mine", [["Mine"]]],
  ["does nothing", () => {}, "Square", []],
]) {
  test(`before the first list comes, a person ${does}: the page shows ${name}`, async (t) => {
    const { clock, state, page } = await open(t, { listed: false });
    act(page);
    await page.hear();
    await clock.pass(1000);
    assert.deepEqual([page.name, state.saves("name")], [name, saved]);
  });

  test(`while the newest program is fetched, a person ${does}: the page shows ${name}`, async (t) => {
    const { state, page } = await open(t, { listed: false });
    const { promise, answer } = later();
    const listed = page.hear();
    state.refuses = promise;
    await listed;
    state.refuses = null;
    act(page);
    await page.hear();
    await answer(square());
    assert.equal(page.name, name);
  });
}

test("a file that is opened is kept under a name that the cockpit takes, unless it cannot be shown", async (t) => {
  const { clock, state, page } = await open(t);
  page.work.addFile("Bad", BAD);
  for (const name of ["Square", `${"x".repeat(39)}🙂`]) page.work.addFile(name, text("f"));
  await clock.pass(1000);
  assert.deepEqual(state.saves("name", "program"), [["Square 2", text("f")], ["x".repeat(39), text("f")]]);
  assert.equal(page.said, "Kept");
});

test("of a new program a person reads that it is not kept, and of an opened one nothing", async (t) => {
  const { clock, state, page } = await open(t, { listed: false });
  assert.equal(page.said, NEW);
  await page.hear();
  assert.equal(page.said, "");
  page.work.add("Zigzag", EMPTY);
  await clock.pass(60000);
  assert.deepEqual([page.said, state.saves()], [NEW, []]);
});

for (const online of [true, false]) {
  test(`new programs are numbered, also if the one before is not in the list yet: online ${online}`, async (t) => {
    const { clock, state, page } = await open(t, { has: [square({ name: "my program" })] });
    state.online = online;
    page.work.add("my program", EMPTY);
    for (const variable of ["a", "b", "c"]) page.make(text(variable));
    assert.equal(page.name, "my program 4", "one that is not changed is not kept, and has no name of its own");
    state.online = true;
    await clock.pass(4000);
    assert.deepEqual(state.names(), ["my program", "my program 2", "my program 3", "my program 4"]);
  });
}

test("what could not be sent is there after a reload, and is kept then, on the version of which it was", async (t) => {
  const { clock, state, page } = await open(t);
  state.online = false;
  page.edit("Offline");
  await clock.pass(600000);
  assert.equal(page.said, "The cockpit does not answer. The page tries again.");
  const again = await open(t, { storage: page.storage, has: [square({ version: 4, name: "Theirs" })] });
  assert.equal(again.page.name, "Offline");
  await again.clock.pass(1000);
  assert.deepEqual(again.state.saves("id", "version", "name"), [[ID.square, 3, "Offline"]]);
});

for (const [what, theirs, name] of [["is newer there", { version: 9, name: "Theirs" }, "Theirs"],
  ["was deleted meanwhile", { version: 4, name: "Mine", deleted: true }, "my program"]]) {
  test(`after a reload, what the cockpit has kept and ${what} is shown only until the list comes`, async (t) => {
    const { clock, page } = await open(t);
    page.edit("Mine");
    await clock.pass(1000);
    const { page: again } = await open(t, { storage: page.storage, has: [square(theirs)], listed: false });
    assert.equal(again.name, "Mine");
    await again.hear();
    assert.equal(again.name, name);
  });
}

test("a newer version of another page is named while this one is open, and shown when a person wants it", async (t) => {
  const { state, page } = await open(t);
  state.programs = [square({ version: 5, name: "Theirs" })];
  await page.hear();
  assert.deepEqual([page.name, page.said, page.newer], ["Square", "There is a newer version of this program.", true]);
  await page.work.openNewer({ id: ID.square, version: page.work.kept.state.newer });
  assert.deepEqual([page.name, page.said, page.newer, state.asked.at(-1).version], ["Theirs", "", false, 5]);
});

test("what is made of a version that was replaced while it was opened is saved as one of the newest", async (t) => {
  const { clock, state, page } = await open(t, { has: [square({ version: 6 })] });
  page.work.add("my program", EMPTY);
  await page.work.open(ID.square, 5);
  page.edit("Larger square");
  await clock.pass(1000);
  assert.deepEqual(state.saves("version"), [[6]]);
});

for (const [what, classId] of [["has nothing", null], ["has a class now", "a"]]) {
  test(`a cockpit without a class that was started again, and ${what}, gets what is shown`, async (t) => {
    const { clock, state, page } = await open(t);
    page.edit("Mine");
    await clock.pass(1000);
    Object.assign(state, { programs: [], classId });
    page.work.connected();
    await page.hear();
    await clock.pass(1000);
    assert.deepEqual([state.names(), page.name], [["Mine"], "Mine"]);
    assert.equal([...page.storage.values()].filter((each) => each.includes("Mine")).length, 1);
  });
}

test("for another robot its programs are shown, and what waits for the first one is kept for that", async (t) => {
  const { clock, state, page } = await open(t, { has: [square({ robot: "/blue" })] });
  page.edit("Mine");
  await page.hear("/blue");
  assert.equal(page.name, "Square");
  page.edit("Blue");
  await clock.pass(1000);
  assert.deepEqual(state.saves("robot", "name"), [["/red", "Mine"], ["/blue", "Blue"]]);
});

test("what the cockpit has refused is shown again for its robot, and named while another is shown", async (t) => {
  const { clock, state, page } = await open(t, { has: [] });
  page.edit("Mine");
  state.refuses = NO_ROOM;
  page.work.add("my program", EMPTY);
  await settled();
  assert.equal(page.said, "Mine: There is no room.");
  page.edit("Second");
  await clock.pass(1000);
  assert.equal(page.said, "There is no room.");
  await page.hear("/blue");
  assert.equal(page.said, NEW, "and not beside another robot's");
  state.refuses = null;
  await page.hear("/red");
  assert.equal(page.name, "Second");
  await clock.pass(1000);
  assert.deepEqual(state.names(), ["Second"]);
});

test("what is said of a program that is not shown goes once that is kept", async (t) => {
  const { clock, state, page } = await open(t);
  state.online = false;
  page.edit("Mine");
  page.work.add("Other", EMPTY);
  await settled();
  assert.equal(page.said, "Mine: The cockpit does not answer. The page tries again.");
  state.online = true;
  await clock.pass(3000);
  assert.deepEqual([state.saves("name").at(-1), page.said], [["Mine"], NEW]);
});

for (const [what, ask] of [["program", ({ work }) => work.open(ID.square)], ["list", (page) => page.hear()]]) {
  test(`a ${what} that comes after another robot was chosen is not shown there`, async (t) => {
    const { state, page } = await open(t);
    page.work.add("my program", EMPTY);
    const { promise, answer } = later();
    state.refuses = promise;
    const asked = ask(page);
    await settled();
    state.refuses = null;
    await page.hear("/blue");
    await answer({ ...square(), programs: [square()] });
    await asked;
    assert.deepEqual([page.name, page.rows], ["my program", []]);
  });
}

test("a list that does not come is asked for again with the next state", async (t) => {
  const { state, page } = await open(t, { listed: false });
  state.online = false;
  await page.hear();
  state.online = true;
  page.work.update("/red", page.changes);
  await settled();
  assert.equal(page.name, "Square");
});

test("what cannot be shown changes neither what is shown nor where that is kept", async (t) => {
  const { clock, state, page } = await open(t, { has: [square(), square({ id: ID.star, program: BAD })] });
  await page.work.open(ID.star);
  page.edit("Larger square");
  await clock.pass(1000);
  assert.deepEqual(state.saves("id", "name"), [[ID.square, "Larger square"]]);
});

test("what is to look at only is locked and never saved; what is shown next is not locked", async (t) => {
  const { clock, state, page } = await open(t, { has: [square({ robot: "/blue" })] });
  await page.work.look({ robot: "/blue", id: ID.square });
  assert.deepEqual([page.locked, page.said], [true, "You can look at this program, but not change it."]);
  await page.hear();
  page.edit("Changed");
  await clock.pass(1000);
  assert.deepEqual(state.saves(), []);
  page.work.add("my program", EMPTY);
  assert.equal(page.locked, false);
});

test("a change comes before the person's Delete, and does not bring the program back after it", async (t) => {
  const { clock, state: { asked }, page } = await open(t);
  page.edit("Last change");
  await page.work.remove(square());
  await clock.pass(60000);
  assert.deepEqual(asked.map((each) => each.do).filter((each) => each !== "list").slice(-2), ["save", "delete"]);
  page.edit("A new one");
  await clock.pass(1000);
  assert.notEqual(asked.at(-1).id, ID.square);
});

test("for a program that is deleted the newest other one is shown, and it stays after Undo", async (t) => {
  const { clock, state, page } = await open(t, {
    has: [square(), square({ id: ID.star, name: "Star", program: text("t") })] });
  await page.work.remove(square());
  await settled();
  assert.deepEqual([page.shown, page.marked], [["Star", text("t")], ["Star"]]);
  await page.work.undo(square({ deleted: true }));
  page.edit("Larger star");
  await clock.pass(1000);
  assert.deepEqual([state.saves("id", "name"), state.names()],
    [[[ID.star, "Larger star"]], ["Larger star", "Square"]]);
});

test("Undo shows the only program again, and a change of it makes no second one", async (t) => {
  const { clock, state, page } = await open(t);
  await page.work.remove(square());
  assert.deepEqual(page.shown, ["my program", EMPTY]);
  await page.work.undo(square({ deleted: true }));
  assert.deepEqual([page.name, page.marked], ["Square", ["Square"]]);
  page.edit("Square", text("larger"));
  await clock.pass(1000);
  assert.deepEqual(state.names(), ["Square"]);
});

test("what has a deleted program's name keeps it, and Undo brings that one back under a free one", async (t) => {
  const { clock, state, page } = await open(t, { has: [square({ name: "my program" })] });
  await page.work.remove(square());
  page.edit("my program", text("new"));
  await page.work.undo(square({ name: "my program", deleted: true }));
  await clock.pass(1000);
  assert.deepEqual(page.shown, ["my program", text("new")]);
  assert.deepEqual(state.names(), ["my program", "my program 2"]);
  assert.equal(state.programs.find(({ id }) => id === ID.square).program, text("s"));
});

test("a change that the cockpit has refused goes with the program when a person deletes that", async (t) => {
  const { clock, state, page } = await open(t);
  state.refuses = NO_ROOM;
  page.edit("Larger square");
  await clock.pass(1000);
  state.refuses = null;
  await page.work.remove(square());
  const again = await open(t, { storage: page.storage, has: state.programs });
  await again.clock.pass(60000);
  assert.deepEqual([page.name, again.page.name, again.state.names()], ["my program", "my program", []]);
});

for (const [what, name, reopen] of [["stays open", "Square", async (page) => page],
  ["has changed one and stays open", "Kept", async (page) => page],
  ["is opened again", "Kept", async ({ storage }) => new Page(storage)]]) {
  test(`once a class was deleted, a page that ${what} neither shows nor sends its programs`, async (t) => {
    const { clock, state, page } = await open(t, { classId: "a" });
    page.edit(name);
    await clock.pass(1000);
    Object.assign(state, { programs: [], classId: "b" });
    const after = await reopen(page);
    after.work.connected();
    after.work.update("/red", page.changes);
    await clock.pass(60000);
    assert.deepEqual([after.shown, state.programs], [["my program", EMPTY], []]);
    assert.doesNotMatch([...after.storage.values()].join(), /Kept|Square/, "nor does the device keep them");
    after.edit("New");
    await clock.pass(1000);
    assert.deepEqual(state.names(), ["New"]);
  });
}

test("a change that was not sent waits on the device while another class has its lesson", async (t) => {
  const { clock, state, page: { work, storage }, page } = await open(t, { classId: "a" });
  state.online = false;
  work.add("my program", EMPTY);
  page.edit("Before the bell");
  await clock.pass(2000);
  const other = await open(t, { storage, has: [], classId: "b" });
  await other.clock.pass(60000);
  assert.deepEqual([other.page.name, other.page.said, other.state.names()], ["my program", WAITS, []]);
  assert.equal(new Page(storage).name, "my program", "also without the cockpit");
  const own = await open(t, { storage, classId: "a" });
  await own.clock.pass(60000);
  assert.deepEqual([own.page.name, own.state.names()], ["Before the bell", ["Before the bell", "Square"]]);
});

test("what waits for a class is sent once that is back; what was made meanwhile has a free name there", async (t) => {
  const { clock, state, page } = await open(t, { has: [square({ name: "Zigzag" })], classId: "a" });
  const own = state.programs;
  state.online = false;
  page.make(text("changed"), "Zigzag");
  await clock.pass(2000);
  Object.assign(state, { programs: [], classId: null, online: true });
  await clock.pass(3000);
  await page.hear();
  assert.deepEqual([page.name, page.said, state.programs], ["my program", WAITS, []]);
  page.make(text("z"), "Zigzag");
  await clock.pass(1000);
  Object.assign(state, { programs: own, classId: "a" });
  await page.hear();
  await clock.pass(1000);
  assert.deepEqual(state.programs.map(({ name, program }) => [name, program]).sort(),
    [["Zigzag 2", text("changed")], ["Zigzag 3", text("z")], ["Zigzag", text("s")]]);
  assert.deepEqual(page.shown, ["Zigzag 3", text("z")]);
  assert.doesNotMatch([...page.storage.values()].join(), /"unsaved":true/, "nothing waits any more");
});

test("what its class has once that was back is not sent again after a reload", async (t) => {
  const { clock, state, page } = await open(t, { classId: "a" });
  page.edit("Mine");
  for (const [classId, programs] of [[null, []], ["a", state.programs]]) {
    Object.assign(state, { classId, programs });
    await page.hear();
    await clock.pass(3000);
  }
  assert.deepEqual(state.names(), ["Mine"]);
  const again = await open(t, { storage: page.storage, has: [square({ name: "Theirs", version: 9 })], classId: "a" });
  await again.clock.pass(60000);
  assert.deepEqual([again.page.name, again.state.names()], ["Theirs", ["Theirs"]]);
});

test("a deleted program that has made room for others is not sent again", async (t) => {
  const { clock, state, page } = await open(t, { classId: "a" });
  page.edit("Mine");
  await clock.pass(1000);
  state.programs = [];
  await page.hear();
  await clock.pass(60000);
  assert.deepEqual([page.name, state.programs], ["Mine", []]);
});

// Plays a person's lesson with what is drawn; returns the cockpit's programs, and what they made last.
async function live(t, draw) {
  let { clock, state, page } = await open(t, { has: [], classId: "a", listed: false });
  let robot = null;
  const [made, conflicts] = [new Map(), []];
  const acts = {
    edit() {
      page.edit(page.name, text(`change ${made.size} ${draw(1e9)}`));
      made.set(page.work.kept.id, page.program);
    },
    add: () => page.work.add("my program", EMPTY),
    wait: () => clock.pass(draw(5000)),
    lose: () => { state.online = !state.online; },
    hear: () => page.hear(robot ??= "/red"),
    choose: () => page.hear(robot &&= ["/red", "/blue"][draw(2)]),
    async reload() {
      await settled();
      conflicts.push(...state.conflicts);
      ({ clock, state, page } = await open(t, { ...page, has: state.programs, classId: "a", listed: false }));
    },
  };
  for (let step = 0; step < 30; step += 1) await Object.values(acts)[draw(7)]();
  state.online = true;
  for (const each of ["/red", "/blue"]) {
    await page.hear(each);
    await clock.pass(5000);
  }
  return [state.programs, made, [...conflicts, ...state.conflicts]];
}

test("what a person makes, also without a network or a robot, and reloads, the cockpit has in the end", async (t) => {
  for (let seed = 1; seed <= 40; seed += 1) {
    const random = stream(seed);
    const [programs, made, conflicts] = await live(t, (below) => Math.floor(random() * below));
    const kept = new Map(programs.map(({ id, program }) => [id, program]));
    assert.deepEqual([...made].filter(([id, program]) => kept.get(id) !== program), [], `seed ${seed}`);
    assert.deepEqual(conflicts, [], `seed ${seed}: each change is of the version before it`);
  }
});

test("whatever lies on the device, the page opens", (t) => {
  new Clock(t);
  cockpit(t, [], null);
  for (const left of ["", "x", "null", "[]", '{"program": 7}', '{"program": "{}", "id": "../x"}']) {
    assert.equal(new Page(new Map([["last program", "program /red"], ["program /red", left]])).name, "my program");
  }
  assert.equal(new Page(new Map([["unsaved programs", '[null, 7, {"program": 7}]']])).name, "my program");
});
