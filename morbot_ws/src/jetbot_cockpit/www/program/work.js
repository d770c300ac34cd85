// The program that is shown: which one it is, whether the cockpit keeps it, and until then this device.
// It knows no page.

import { t } from "../language.js";
import { ask } from "./ask.js";
import * as device from "./device.js";
import { Kept } from "./kept.js";
import { clean, freeName } from "./names.js";

const LOOKING = t("You can look at this program, but not change it.");

export class Work {
  /** @type {string | null} */
  robot = null; // whose programs these are
  classId = undefined; // of the class that the cockpit has, null for one without a name
  changes = undefined; // to the robot's programs, as far as the last list shows them
  /** @type {Kept} */
  kept = /** @type {any} */ (null); // that is shown
  /** @type {Kept[]} */
  unsaved = []; // that are not shown, some saved by now; those without a robot become the first one's
  rows = []; // the last list of the robot's programs
  /** @type {[string, string]} */
  empty = ["", ""]; // the program that is shown where there is no other
  // showing: the blocks are being replaced: that is no change of the person's
  // arriving: what is shown gives way to what the robot has, once its first list has come
  // editing: what is shown stays, and its changes are kept
  // looking: it is another robot's, and cannot be changed
  // baseline: what was shown, when it was looked at last, in the states in which it may be changed
  /** @type {{ name: string, baseline?: string }} */
  state = { name: "showing" };

  // view: show(name, program): shows a program, returns whether it can; current(): returns { name, program };
  // lock(on): nobody may change the blocks; list(rows); say(text, bad, newer): newer: whether there is a newer version
  constructor(view) {
    this.view = view;
  }

  // Shows what this device kept when the page was left, or an empty program: this one.
  restore(name, program) {
    this.empty = [name, program];
    this.display(...this.empty, "arriving");
    const left = device.keptLast();
    this.robot = left?.robot ?? null;
    if (left) this.goOn(left);
    for (const each of device.keptAside()) this.sendAgain(each);
  }

  // What was not shown last, and is not kept yet.
  sendAgain({ robot, name, program, ...which }) {
    const kept = this.unsent(which.id) ?? new Kept(robot, which, (each) => this.report(each));
    this.unsaved = [...this.unsaved.filter((each) => each !== kept), kept];
    kept.change({ name, program });
  }

  // Shows a new program, by a name of its own; returns whether it can.
  add(name, program) {
    return this.display(this.freeName(clean(name), this.shown()), program, "editing");
  }

  // The same with what a person has made elsewhere: it is kept.
  addFile(name, program) {
    if (this.add(name, program)) this.keep();
  }

  shown() {
    return this.kept?.content ? [this.view.current()] : []; // perhaps not in the list yet
  }

  // Returns a name that no program of the robot has, nor one that this device has yet to send, nor these others.
  freeName(name, others = []) {
    const unsent = device.keptAside().filter(({ robot }) => robot === this.robot);
    return freeName(name, [...this.rows, ...unsent, ...others]);
  }

  // Shows a version of one of the robot's programs, or what has replaced it, if it is still wanted. Throws a NotKept.
  async open(id, version, isWanted = () => true) {
    const { robot } = this;
    const { name, program, version: opened } = await ask({ do: "open", robot, id, version });
    if (robot !== this.robot || !isWanted()) return;
    this.display(name, program, "editing", { id, version: opened, content: { name, program } });
    this.view.list(this.rows); // of which another one is shown
  }

  // The same, for which nobody waits: what a person has opened or changed meanwhile stays.
  async openNewer({ id, version }) {
    const { state } = this;
    const opened = this.open(id, version, () => state === this.state);
    await opened.catch(({ message }) => this.view.say(message, true, false));
  }

  // Shows a program of any robot, which is not changed. Throws a NotKept.
  async look({ robot, id }) {
    const { name, program } = await ask({ do: "open", robot, id });
    this.display(name, program, "looking");
  }

  // Deletes a program of the list; if it is shown, the newest other one is shown instead. Throws a NotKept.
  async remove({ id, robot }) {
    if (this.isShown(id)) await this.kept.save(); // so that it is not brought back, and Undo shows the newest
    await ask({ do: "delete", robot, id });
    if (!this.isShown(id)) return;
    this.kept.enter("unchanged");
    this.leave();
    await this.refresh(robot);
  }

  // Undoes that, under a free name; shows the program again unless there is another. Throws a NotKept.
  async undo({ id, robot, name, version }) {
    const free = this.freeName(name, this.shown());
    if (free === name) await ask({ do: "restore", robot, id });
    else {
      const { program } = await ask({ do: "open", robot, id });
      await ask({ do: "save", robot, id, version, name: free, program });
    }
    if (!this.kept.content) await this.open(id);
  }

  isShown(id, version = this.kept.version) {
    return id === this.kept.id && version === this.kept.version;
  }

  // The blocks or the name may have changed.
  changed() {
    const { name, baseline } = this.state;
    if (name !== "arriving" && name !== "editing") return;
    if (JSON.stringify(this.view.current()) !== baseline) this.keep();
  }

  // A state has arrived. changes: grows with each change to the robot's programs
  update(robot, changes) {
    if (!robot || changes === undefined) return;
    if (robot !== this.robot) this.changeRobot(robot);
    if (changes !== this.changes) void this.refresh(robot);
    this.changes = changes;
  }

  changeRobot(robot) {
    const first = this.robot === null;
    Object.assign(this, { robot, changes: undefined, rows: [] });
    for (const each of [...this.unsaved, this.kept]) if (each.robot === null) void each.belongTo(robot);
    if (first) return;
    this.begin("arriving");
    this.goOnUnsaved();
  }

  // A connection begins, perhaps to another cockpit.
  connected() {
    this.changes = undefined;
  }

  async refresh(robot) {
    const answer = await ask({ do: "list", robot }).catch(() => null);
    if (robot !== this.robot) return;
    if (answer) this.compare(answer);
    else this.changes = undefined; // asks again with the next state
  }

  // Compares what is shown with what the cockpit has.
  compare({ programs: rows, class: classId = null }) {
    this.rows = rows;
    this.view.list(rows);
    if (this.state.name === "looking") return;
    this.enterClass(classId);
    if (this.isGone(rows)) this.leave();
    if (this.state.name === "arriving" && !this.kept.content) this.goOnUnsaved();
    const { kept } = this;
    const arriving = this.state.name === "arriving";
    this.state.name = "editing";
    const row = rows.find(({ id }) => id === kept.id);
    const newest = rows.find(({ deleted }) => !deleted);
    if (row && arriving && row.version > kept.version) void this.openNewer(row);
    else if (row) kept.compare(row);
    else if (kept.version && !kept.classId) this.join(); // a cockpit that keeps no class was started again
    else if (arriving && newest && !kept.version) void this.openNewer(newest);
  }

  // The cockpit has this class. What waits for one that was away is sent.
  enterClass(classId) {
    const before = this.classId;
    this.classId = classId;
    if (before === undefined || before === classId) return;
    for (const each of device.keptAside()) if (each.classId === classId) this.sendAgain(each);
  }

  // Keeps what is shown beside the programs that the cockpit has, under a free name.
  join() {
    const { name, program } = this.view.current();
    const free = this.freeName(name);
    if (free !== name) this.view.show(free, program);
    this.keep();
  }

  // Returns whether what is shown is another class's, or was deleted while this page was away.
  isGone(rows) {
    const { id, classId, state: { unsaved } } = this.kept;
    const isDeleted = rows.some((row) => row.id === id && row.deleted);
    return (classId && classId !== this.classId) || (isDeleted && this.state.name === "arriving" && !unsaved);
  }

  // Shows the empty program instead; this device keeps only what is unsaved, until its class is there again.
  leave() {
    const { kept } = this;
    this.display(...this.empty, "arriving");
    device.leave(kept);
    this.report(kept);
  }

  // Shows what this device has of this robot, and the cockpit has not.
  goOnUnsaved() {
    const left = device.keptFor(this);
    if (left?.unsaved) this.goOn(left);
  }

  // Shows what this device kept. What is still being sent is the same program, not a second one that overtakes it.
  goOn({ name, program, unsaved, ...which }) {
    const kept = this.unsent(which.id) ?? { ...which, content: { name: clean(name), program } };
    if (this.display(clean(name), program, "arriving", kept) && unsaved) this.keep();
  }

  unsent(wanted) {
    return this.unsaved.find(({ id }) => id === wanted);
  }

  // What cannot be shown changes nothing.
  display(name, program, next, which) {
    const { state } = this;
    this.state = { name: "showing" };
    const shown = this.view.show(name, program);
    if (shown) this.begin(next, which);
    else this.state = state;
    return shown;
  }

  // What is shown is another program from now on; a new one is not kept until it is changed.
  begin(state, which = {}) {
    const before = this.kept;
    void before?.save();
    this.kept = which instanceof Kept ? which
      : new Kept(this.robot, { classId: this.classId, ...which }, (kept) => this.report(kept));
    this.unsaved = [...this.unsaved, before].filter((each) => each?.state.unsaved && each !== this.kept);
    if (before) device.keepAside(before);
    this.state = { name: state, baseline: JSON.stringify(this.view.current()) };
    this.view.lock(state === "looking");
    this.report(this.kept);
  }

  keep() {
    const content = this.view.current();
    this.state = { name: "editing", baseline: JSON.stringify(content) };
    this.kept.change(content);
  }

  // Lets the version that is kept stay, as an earlier one, once the next change is. Returns why it cannot, or "".
  keepEarlier() {
    if (this.kept.state.unsaved) return this.kept.state.text;
    this.kept.version = 0;
    return "";
  }

  // Says what has become of a program, of another one of this robot only what is bad, or that it waits for its class,
  // without its name; keeps the shown one on this device.
  report(kept) {
    const { content, state: { name, text, bad } } = kept;
    if (kept !== this.kept) {
      device.keepAside(kept);
      if (name === "foreign") return this.view.say(text, false, false);
      const told = bad && kept.robot === this.robot;
      return told ? this.view.say(`${content.name}: ${text}`, true, false) : this.report(this.kept);
    }
    this.view.say(this.state.name === "looking" ? LOOKING : text, bad, name === "older");
    if (content) device.keepShown(kept);
  }
}
