// The program that is shown: which one it is, whether the cockpit keeps it, and until then this device.
// It knows no page.

import { recall, remember } from "../storage.js";
import { ask } from "./ask.js";
import { clean, Kept } from "./kept.js";

const LAST = "last program"; // the key of the one that was shown last
const LOOKING = "You can look at this program, but not change it.";

export class Work {
  /** @type {string | null} */
  robot = null; // whose programs these are
  changes = undefined; // to the robot's programs, as far as the last list shows them
  /** @type {any} */
  kept = null; // the Kept that is shown
  begun = []; // before there is a robot: they become the first one's
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

  // Shows this program, or what this device kept when the page was left.
  restore(name, program) {
    this.display(name, program, "arriving");
    const left = load(recall(LAST));
    if (!left) return;
    this.robot = left.robot ?? null;
    this.goOn(left);
  }

  // Shows a new program; returns whether it can.
  add(name, program) {
    return this.display(name, program, "editing");
  }

  // Shows a version of one of the robot's programs, or what has replaced it. Throws a NotKept.
  async open(id, version) {
    const { robot } = this;
    const { name, program, version: opened } = await ask({ do: "open", robot, id, version });
    if (robot !== this.robot) return;
    this.display(name, program, "editing", { id, version: opened, content: { name, program } });
  }

  // The same, for which nobody waits.
  async openNewer({ id, version }) {
    await this.open(id, version).catch(({ message }) => this.view.say(message, true, false));
  }

  // Shows a program of any robot, which is not changed. Throws a NotKept.
  async look({ robot, id }) {
    const { name, program } = await ask({ do: "open", robot, id });
    this.display(name, program, "looking");
  }

  // Deletes a program of the list, or undoes that. Throws a NotKept.
  async remove({ id, robot, deleted }) {
    if (this.isShown(id)) await this.kept.save(); // so that it is not brought back, and Undo shows the newest
    await ask({ do: deleted ? "restore" : "delete", robot, id });
    if (this.isShown(id)) this.begin("editing");
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
    if (changes !== this.changes) this.refresh(robot);
    this.changes = changes;
  }

  changeRobot(robot) {
    const first = this.robot === null;
    Object.assign(this, { robot, changes: undefined });
    for (const each of this.begun.splice(0)) each.belongTo(robot);
    if (first) return;
    this.begin("arriving");
    const left = load(keyOf(robot));
    if (left?.unsaved) this.goOn(left);
  }

  async refresh(robot) {
    const answer = await ask({ do: "list", robot }).catch(() => null);
    if (robot !== this.robot) return;
    if (answer) this.compare(answer.programs);
    else this.changes = undefined; // asks again with the next state
  }

  // Compares what is shown with what the cockpit has.
  compare(rows) {
    this.view.list(rows);
    const { kept, state: { name, baseline } } = this;
    if (name === "looking") return;
    const arriving = name === "arriving";
    this.state = { name: "editing", baseline };
    const row = rows.find(({ id }) => id === kept.id);
    const newest = rows.find(({ deleted }) => !deleted);
    if (row && arriving && row.version > kept.version) this.openNewer(row);
    else if (row) kept.compare(row);
    else if (kept.version) this.keep(); // the cockpit was started again
    else if (arriving && newest) this.openNewer(newest);
  }

  // Shows what this device kept.
  goOn({ id, version, name, program, unsaved }) {
    const content = { name: clean(name), program };
    if (this.display(content.name, program, "arriving", { id, version, content }) && unsaved) this.keep();
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
    this.kept?.save();
    this.kept = new Kept(this.robot, which, (kept) => this.report(kept));
    if (this.robot === null) this.begun.push(this.kept);
    this.state = { name: state, baseline: JSON.stringify(this.view.current()) };
    this.view.lock(state === "looking");
    this.report(this.kept);
  }

  keep() {
    const content = this.view.current();
    this.state = { name: "editing", baseline: JSON.stringify(content) };
    this.kept.change(content);
  }

  // Says what has become of a program, of another one only while it is bad; keeps the shown one on this device.
  report(kept) {
    const { robot, id, version, content, state: { name, text, bad, unsaved } } = kept;
    if (kept !== this.kept && bad) return this.view.say(`${content.name}: ${text}`, true, false);
    if (kept !== this.kept) return this.report(this.kept);
    this.view.say(this.state.name === "looking" ? LOOKING : text, bad, name === "older");
    if (!content) return;
    remember(keyOf(robot), JSON.stringify({ robot, id, version, ...content, unsaved }));
    remember(LAST, keyOf(robot));
  }
}

// Returns what is kept under this key, or null.
function load(key) {
  try {
    const left = JSON.parse(recall(key));
    return typeof left.program === "string" && /^[0-9a-f]{16}$/.test(left.id) ? left : null;
  } catch { // nothing, or something else, is there
    return null;
  }
}

function keyOf(robot) {
  return `program ${robot}`;
}
