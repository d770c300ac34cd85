// Which program is shown, and that nothing that a person has made is lost: not by a reload, a restart of the cockpit,
// another robot, or another page.

import assert from "node:assert/strict";
import { test } from "node:test";

import { limits } from "#www/limits.js";
import { Work } from "#www/program/work.js";

import { Clock, settled } from "./clock.js";
import { later, LOST, playCockpit, refuse } from "./cockpit.js";
import { play, sight } from "./steps.js";
import { stream } from "./stream.js";

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
const STAR = square({ id: ID.star, name: "Star", program: text("t") });

// A cockpit with these programs: { id, robot, name, program, version }; the newest change first; and with this class.
function cockpit(t, programs, classId) {
  const state = { programs, classId, online: true, refuses: null, held: null, conflicts: [] };
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
  state.asked = playCockpit(t, (fields) => {
    const { held, online, refuses } = state;
    if (held?.kind !== fields.do) return online ? refuses ?? answers[fields.do](fields) : LOST;
    state.held = null;
    return held.promise;
  });
  state.names = () => state.programs.filter(({ deleted }) => !deleted).map(({ name }) => name).sort();
  return state;
}

// A page, as it is before its robot has come; storage: what its device keeps.
class Page {
  said = "";
  newer = false;
  rows = []; // of its robot's programs
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
  }

  // A person changes what is shown.
  edit(name, program = this.program) {
    Object.assign(this, { name, program });
    this.work.changed();
  }

  // A state arrives: there are changes to this robot's programs.
  hear(robot = "/red") {
    this.work.update(robot, this.changes += 1);
    return settled();
  }
}

// Opens a page beside a cockpit with these programs and this class; listed: and lets it have its robot's first list.
async function open(t, { programs = [square()], classId = null, storage = undefined, listed = true } = {}) {
  t.mock.restoreAll(); // what an earlier page has begun
  const lesson = { t, clock: new Clock(t), state: cockpit(t, programs, classId), page: new Page(storage) };
  if (listed) await lesson.page.hear();
  return lesson;
}

// What happens in a lesson
const edit = (name, program) => ({ page }) => page.edit(name, program);
const add = (name) => ({ page }) => page.work.add(name, EMPTY);
const make = (variable, name = "my program") => ({ page }) => {
  page.work.add(name, EMPTY);
  page.edit(page.name, text(variable));
};
const addFile = (name, program) => ({ page }) => page.work.addFile(name, program);
const openProgram = (id, version) => ({ page }) => page.work.open(id, version);
const remove = ({ page }) => page.work.remove(square());
const undo = (name = "Square") => ({ page }) => page.work.undo(square({ name, deleted: true }));
const hear = (robot) => ({ page }) => page.hear(robot);
const there = (fields) => ({ state }) => Object.assign(state, fields); // in the cockpit
const offline = there({ online: false }), online = there({ online: true });
const connect = ({ page }) => page.work.connected();
const reload = (fields = {}) => async (lesson) => {
  const { t, page: { storage }, state: { programs, classId } } = lesson;
  Object.assign(lesson, await open(t, { programs, classId, storage, ...fields }));
};
const begin = (step) => (lesson) => { // does not wait for the answer
  void step(lesson);
  return settled();
};
// The next request of a kind is answered by the step answer().
const hold = (kind) => (lesson) => {
  const { promise, answer } = later();
  lesson.answer = answer;
  lesson.state.held = { kind, promise };
};
const answer = (fields) => (lesson) => lesson.answer(fields);

const NAMES = Object.fromEntries(Object.entries(ID).map(([name, id]) => [id, name]));
const device = ({ page }) => [...page.storage.values()].join();
const sees = sight({
  name: ({ page }) => page.name, program: ({ page }) => page.program, said: ({ page }) => page.said,
  newer: ({ page }) => page.newer, locked: ({ page }) => page.locked, rows: ({ page }) => page.rows,
  names: ({ state }) => state.names(), // in the cockpit
  marked: ({ page }) => page.rows.filter(({ id, version }) => page.work.isShown(id, version)).map(({ name }) => name),
  saves: ({ state }) => state.asked.filter((each) => each.do === "save")
    .map(({ robot, id, version, name }) => `${robot} ${NAMES[id] ?? "new"} ${version}: ${name}`),
  asked: ({ state }) => state.asked.map((each) => each.do).filter((each) => each !== "list"),
  has: ({ state }) => Object.fromEntries(state.programs.map(({ name, program }) => [name, program])),
});
const keepsNo = (words) => (lesson) => assert.doesNotMatch(device(lesson), words);
const teach = async (t, given, steps) => play(await open(t, given), steps);

const NO_ANSWER = "The cockpit does not answer. The page tries again.";
const UNLISTED = { listed: false };
const CLASS = { classId: "a" };
const LESSONS = {
  "a page that is opened shows the robot's newest program, which is saved once it is changed": [
    { programs: [{ ...STAR, deleted: true }, square()] }, sees({ name: "Square", program: text("s") }), 60000,
    sees({ saves: [] }), edit("Larger square"), 1000, sees({ saves: ["/red square 3: Larger square"] })],
  "what is kept stays as an earlier version of what is to replace it, unless it is not kept yet": [
    {}, edit("As text"), ({ page }) => assert.equal(page.work.keepEarlier(), "Not kept yet"), 1000,
    ({ page }) => assert.equal(page.work.keepEarlier(), ""), edit("As blocks"), 1000,
    sees({ saves: ["/red square 3: As text", "/red square 0: As blocks"] })],
  "a file that is opened is kept under a name that the cockpit takes, unless it cannot be shown": [
    {}, addFile("Bad", BAD), addFile("Square", text("f")), addFile(`${"x".repeat(39)}🙂`, text("f")), 1000,
    sees({ said: "Kept", has: { Square: text("s"), "Square 2": text("f"), ["x".repeat(39)]: text("f") } })],
  "of a new program a person reads that it is not kept, and of an opened one nothing": [
    UNLISTED, sees({ said: NEW }), hear(), sees({ said: "" }), add("Zigzag"), 60000, sees({ said: NEW, saves: [] })],
  "what could not be sent is there after a reload, and is kept then, on the version of which it was": [
    {}, offline, edit("Offline"), 600000, sees({ said: NO_ANSWER }),
    reload({ programs: [square({ version: 4, name: "Theirs" })] }), sees({ name: "Offline" }), 1000,
    sees({ saves: ["/red square 3: Offline"] })],
  "after a reload, what the cockpit has kept and is newer there is shown only until the list comes": [
    {}, edit("Mine"), 1000, reload({ ...UNLISTED, programs: [square({ version: 9, name: "Theirs" })] }),
    sees({ name: "Mine" }), hear(), sees({ name: "Theirs" })],
  "after a reload, what was deleted meanwhile is shown only until the list comes": [
    {}, edit("Mine"), 1000, reload({ ...UNLISTED, programs: [square({ version: 4, deleted: true })] }),
    sees({ name: "Mine" }), hear(), sees({ name: "my program" })],
  "a newer version of another page is named while this one is open, and shown when a person wants it": [
    {}, there({ programs: [square({ version: 5, name: "Theirs" })] }), hear(),
    sees({ name: "Square", said: "There is a newer version of this program.", newer: true }),
    ({ page: { work } }) => work.openNewer({ id: ID.square, version: work.kept.state.newer }),
    sees({ name: "Theirs", said: "", newer: false }), ({ state }) => assert.equal(state.asked.at(-1).version, 5)],
  "what is made of a version that was replaced while it was opened is saved as one of the newest": [
    { programs: [square({ version: 6 })] }, add("my program"), openProgram(ID.square, 5), edit("Larger square"), 1000,
    sees({ saves: ["/red square 6: Larger square"] })],
  "for another robot its programs are shown, and what waits for the first one is kept for that": [
    { programs: [square({ robot: "/blue" })] }, edit("Mine"), hear("/blue"), sees({ name: "Square" }),
    edit("Blue"), 1000, sees({ saves: ["/red new 0: Mine", "/blue square 3: Blue"] })],
  "what the cockpit has refused is shown again for its robot, and named while another is shown": [
    { programs: [] }, edit("Mine"), there({ refuses: NO_ROOM }), add("my program"), settled,
    sees({ said: "Mine: There is no room." }), edit("Second"), 1000, sees({ said: "There is no room." }),
    hear("/blue"), sees({ said: NEW }), there({ refuses: null }), hear("/red"), sees({ name: "Second" }), 1000,
    sees({ names: ["Second"] })],
  "what is said of a program that is not shown goes once that is kept": [
    {}, offline, edit("Mine"), add("Other"), settled, sees({ said: `Mine: ${NO_ANSWER}` }), online, 3000,
    sees({ names: ["Mine"], said: NEW })],
  "a program that comes after another robot was chosen is not shown there": [
    {}, add("my program"), hold("open"), begin(openProgram(ID.square)), hear("/blue"), answer(square()),
    sees({ name: "my program" })],
  "a list that comes after another robot was chosen is not shown there": [
    {}, add("my program"), hold("list"), hear(), hear("/blue"), answer({ programs: [square()] }), sees({ rows: [] })],
  "a list that does not come is asked for again with the next state": [
    UNLISTED, offline, hear(), online, ({ page }) => page.work.update("/red", page.changes), settled,
    sees({ name: "Square" })],
  "what cannot be shown changes neither what is shown nor where that is kept": [
    { programs: [square(), { ...STAR, program: BAD }] }, openProgram(ID.star), edit("Larger square"), 1000,
    sees({ saves: ["/red square 3: Larger square"] })],
  "what is to look at only is locked and never saved; what is shown next is not locked": [
    { programs: [square({ robot: "/blue" })] }, ({ page }) => page.work.look({ robot: "/blue", id: ID.square }),
    sees({ locked: true, said: "You can look at this program, but not change it." }), hear(), edit("Changed"), 1000,
    sees({ saves: [] }), add("my program"), sees({ locked: false })],
  "a change comes before the person's Delete, and does not bring the program back after it": [
    {}, edit("Last change"), remove, 60000, sees({ asked: ["open", "save", "delete"] }), edit("A new one"), 1000,
    sees({ saves: ["/red square 3: Last change", "/red new 0: A new one"] })],
  "for a program that is deleted the newest other one is shown, and it stays after Undo": [
    { programs: [square(), STAR] }, remove, settled, sees({ name: "Star", program: text("t"), marked: ["Star"] }),
    undo(), edit("Larger star"), 1000,
    sees({ saves: ["/red star 3: Larger star"], names: ["Larger star", "Square"] })],
  "Undo shows the only program again, and a change of it makes no second one": [
    {}, remove, sees({ name: "my program", program: EMPTY }), undo(), sees({ name: "Square", marked: ["Square"] }),
    edit("Square", text("larger")), 1000, sees({ names: ["Square"] })],
  "what has a deleted program's name keeps it, and Undo brings that one back under a free one": [
    { programs: [square({ name: "my program" })] }, remove, edit("my program", text("new")), undo("my program"), 1000,
    sees({ name: "my program", program: text("new"), has: { "my program": text("new"), "my program 2": text("s") } })],
  "a change that the cockpit has refused goes with the program when a person deletes that": [
    {}, there({ refuses: NO_ROOM }), edit("Larger square"), 1000, there({ refuses: null }), remove,
    sees({ name: "my program" }), reload(), 60000, sees({ name: "my program", names: [] })],
  "a change that was not sent waits on the device while another class has its lesson": [
    CLASS, offline, make("a"), 2000, reload({ programs: [], classId: "b" }), 60000,
    sees({ name: "my program", said: WAITS, program: EMPTY, names: [] }),
    ({ page: { storage } }) => assert.equal(new Page(storage).program, EMPTY, "also without the cockpit"),
    reload({ ...CLASS, programs: [square()] }), 60000, sees({ program: text("a"), names: ["Square", "my program"] })],
  "what waits for a class is sent once that is back; what was made meanwhile has a free name there": [
    { ...CLASS, programs: [square({ name: "Zigzag" })] }, offline, make("changed", "Zigzag"), 2000,
    there({ programs: [], classId: null, online: true }), 3000, hear(),
    sees({ name: "my program", said: WAITS, has: {} }), make("z", "Zigzag"), 1000,
    there({ ...CLASS, programs: [square({ name: "Zigzag" })] }), hear(), 1000,
    sees({ name: "Zigzag 3", program: text("z"),
      has: { Zigzag: text("s"), "Zigzag 2": text("changed"), "Zigzag 3": text("z") } }),
    keepsNo(/"unsaved":true/)],
  "what its class has once that was back is not sent again after a reload": [
    CLASS, edit("Mine"), there({ classId: null, programs: [] }), hear(), 3000,
    there({ ...CLASS, programs: [square()] }), hear(), 3000, sees({ names: ["Mine"] }),
    reload({ programs: [square({ name: "Theirs", version: 9 })] }), 60000, sees({ name: "Theirs", names: ["Theirs"] })],
  "a deleted program that has made room for others is not sent again": [
    CLASS, edit("Mine"), 1000, there({ programs: [] }), hear(), 60000, sees({ name: "Mine", has: {} })],
};
for (const [what, [given, ...steps]] of Object.entries(LESSONS)) test(what, (t) => teach(t, given, steps));

for (const [does, act, name, saves] of [
  ["opens an example", add("Zigzag"), "Zigzag", []],
  ["changes something", edit("Mine"), "Mine", ["/red new 0: Mine"]],
  ["does nothing", () => {}, "Square", []],
]) {
  test(`before the first list comes, a person ${does}: the page shows ${name}`, (t) => teach(t, UNLISTED, [
    act, hear(), 1000, sees({ name, saves })]));

  test(`while the newest program is fetched, a person ${does}: the page shows ${name}`, (t) => teach(t, UNLISTED, [
    hold("open"), hear(), act, hear(), answer(square()), sees({ name })]));
}

for (const connection of [online, offline]) {
  test(`new programs are numbered, also if the one before is not in the list yet: ${connection === online}`, (t) => (
    teach(t, { programs: [square({ name: "my program" })] }, [connection, add("my program"), make("a"), make("b"),
      make("c"), sees({ name: "my program 4" }), online, 4000,
      sees({ names: ["my program", "my program 2", "my program 3", "my program 4"] })])));
}

for (const [what, classId] of [["has nothing", null], ["has a class now", "a"]]) {
  test(`a cockpit without a class that was started again, and ${what}, gets what is shown`, (t) => teach(t, {}, [
    edit("Mine"), 1000, there({ programs: [], classId }), connect, hear(), 1000,
    sees({ names: ["Mine"], name: "Mine" }),
    ({ page }) => assert.equal([...page.storage.values()].filter((each) => each.includes("Mine")).length, 1)]));
}

for (const [what, name, next] of [
  ["stays open", "Square", () => {}], ["has changed one and stays open", "Kept", () => {}],
  ["is opened again", "Kept", reload(UNLISTED)]]) {
  test(`once a class was deleted, a page that ${what} neither shows nor sends its programs`, (t) => teach(t, CLASS, [
    edit(name), 1000, there({ programs: [], classId: "b" }), next, connect, hear(), 60000,
    sees({ name: "my program", program: EMPTY, has: {} }), keepsNo(/Kept|Square/), edit("New"), 1000,
    sees({ names: ["New"] })]));
}

// Plays a person's lesson with what is drawn; returns the cockpit's programs, and what they made last.
async function live(t, draw) {
  let { clock, state, page } = await open(t, { programs: [], classId: "a", listed: false });
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
      ({ clock, state, page } = await open(t, { ...page, programs: state.programs, classId: "a", listed: false }));
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
