// The program that is shown: which one it is, whether the cockpit keeps it, and until then this device.

import { element, setText } from "../dom.js";
import { recall, remember } from "../storage.js";
import { ask } from "./ask.js";
import { EMPTY } from "./examples.js";
import { clean, copyOf, Kept } from "./kept.js";
import { Shelf } from "./shelf.js";

const LAST = "last program"; // the key of the one that was shown last

export class Work {
  robot = null; // whose programs these are
  touched = false; // whether the person has chosen or changed what is shown: it stays, whatever the cockpit has

  // show(name, program): shows a program, returns whether it can; current(): returns { name, program };
  // lock(on): nobody may change the blocks
  constructor({ show, current, lock }) {
    Object.assign(this, { show, current, lock });
    this.shelf = new Shelf({
      open: (id) => this.open(id), isShown: (id) => id === this.kept.id,
      deleted: (id) => id === this.kept.id && this.begin(),
    });
    element("new").addEventListener("click", () => {
      this.choose();
      this.show("my program", EMPTY);
      this.shelf.sheet.toggle(false);
    });
    element("copy").addEventListener("click", () => this.copyShown());
    this.begin();
    this.shown = null; // the first program is still to come
  }

  // What is shown from now on is another program; it is not kept until it is changed.
  begin({ id, version = 0, looking = false } = {}) {
    this.kept?.save();
    this.kept = new Kept(this.robot, id, version, (...what) => this.report(...what));
    Object.assign(this, { looking, touched: false, shown: JSON.stringify(this.current()) });
    this.report(this.kept, looking ? "To look at only." : "", false);
    this.lock(looking);
  }

  // The person shows something else.
  choose() {
    this.begin();
    Object.assign(this, { shown: null, touched: true });
  }

  // Shows what this device kept when the page was left.
  restore() {
    const left = load(recall(LAST));
    if (!left) return;
    Object.assign(this, { robot: left.robot ?? null, arriving: true });
    this.goOn(left);
  }

  // Shows what this device kept.
  goOn({ id, version, name, program, unsaved }) {
    this.display(clean(name), program, { id, version });
    if (unsaved) this.keep({ name: clean(name), program });
  }

  // A state has arrived. changes: grows with each change to the robot's programs
  update(robot, changes) {
    if (!robot || changes === undefined) return;
    if (robot !== this.robot) this.changeRobot(robot);
    if (changes !== this.changes) this.refresh(robot);
    this.changes = changes;
  }

  // What has had no robot yet becomes this one's.
  changeRobot(robot) {
    const first = this.robot === null;
    Object.assign(this, { robot, changes: undefined, arriving: true });
    if (first) {
      this.kept.robot = robot;
      if (this.touched) this.keep(this.current());
      return;
    }
    this.begin();
    const left = load(keyOf(robot));
    if (left?.unsaved) this.goOn(left);
  }

  async refresh(robot) {
    try {
      const { programs } = await ask({ do: "list", robot });
      if (robot === this.robot) this.compare(programs);
    } catch {
      this.changes = undefined; // asks again with the next state
    }
  }

  // Compares what is shown with what the cockpit has.
  compare(rows) {
    this.shelf.list(rows);
    const { kept, arriving, touched } = this;
    const row = rows.find(({ id }) => id === kept.id);
    const newest = rows.find(({ deleted }) => !deleted);
    this.arriving = false;
    if (this.looking || kept.pending) return;
    if (row && (!arriving || row.version === kept.version)) kept.compare(row);
    else if (row) this.open(row.id);
    else if (kept.version) this.keep(this.current()); // the cockpit was started again
    else if (arriving && newest && !touched) this.open(newest.id);
  }

  // The blocks or the name may have changed.
  changed() {
    const work = this.current();
    const before = this.shown;
    this.shown = JSON.stringify(work);
    if (!this.looking && before !== null && this.shown !== before) this.keep(work);
  }

  keep(work) {
    this.touched = true;
    this.kept.keep(work);
  }

  // Says what has become of a program, of another one only if it is bad; keeps the shown one on this device.
  report(kept, text, bad) {
    const { robot, id, version, content, foreign, unsaved } = kept;
    const isShown = kept === this.kept;
    if (isShown || bad) setText(element("kept"), isShown ? text : `${content.name}: ${text}`);
    if (isShown || bad) element("kept").dataset.level = bad ? "warning" : "";
    if (!isShown) return;
    element("copy").hidden = !foreign;
    if (!content) return;
    remember(keyOf(robot), JSON.stringify({ robot, id, version, ...content, unsaved }));
    remember(LAST, keyOf(robot));
  }

  open(id) {
    return this.shelf.act(async () => {
      const { name, program, version } = await ask({ do: "open", robot: this.robot, id });
      this.display(name, program, { id, version });
      this.kept.content = { name, program };
      this.report(this.kept, "", false);
      this.shelf.sheet.toggle(false);
    });
  }

  // Shows a program of any robot, which is not changed; throws a NotKept.
  async look({ robot, id }) {
    const { name, program } = await ask({ do: "open", robot, id });
    this.display(name, program, { looking: true });
  }

  // What cannot be shown is not overwritten by what is shown instead.
  display(name, program, which) {
    this.begin(which);
    this.shown = null; // the blocks come back a little different
    if (!this.show(name, program)) this.begin();
  }

  // What is shown becomes a program of its own.
  copyShown() {
    const { name, program } = this.current();
    this.begin();
    this.shown = "";
    this.show(copyOf(name), program);
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
