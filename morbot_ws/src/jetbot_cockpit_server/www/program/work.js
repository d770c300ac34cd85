// The programs of the chosen robot: each change is kept by the cockpit after a second, and until then by this device.

import { create, element, setText } from "../dom.js";
import { recall, remember, toName } from "../storage.js";
import { ask, newId, NotKept } from "./ask.js";

const SAVE_AFTER = 1000; // ms after the last change
const RETRY_AFTER = 3000; // ms
const MAX_SIZE = 64 * 1024; // bytes
const KEY = "program";
const MAX_NAME = 40; // characters
const TOO_LARGE = "Too large to be kept here, 64 kB at most. Save it as a file.";
const CHANGED = "This program was changed on another page. Open it again, or save yours as a copy.";
const WAITS = "Not kept yet: the cockpit does not answer.";

export class Work {
  robot = null; // whose programs these are
  rows = [];
  versions = new Map(); // by id, as the cockpit has them
  pending = new Map(); // what is to be kept, by id
  unanswered = null; // what was sent, and may have been kept: it is sent again before anything newer

  // show(name, program): shows a program; current(): returns { name, program }; lock(on): nobody may change the blocks
  constructor({ show, current, lock }) {
    Object.assign(this, { show, current, lock });
    this.begin();
    this.shown = null; // the first program is still to come
    element("programs").addEventListener("click", () => this.toggle());
    element("close-work").addEventListener("click", () => this.toggle(false));
    element("new").addEventListener("click", () => this.create());
    element("copy").addEventListener("click", () => this.copyShown());
  }

  // What is shown from now on is another program; it is not kept until it is changed.
  begin(id = newId(), looking = false) {
    Object.assign(this, { id, looking, touched: false, shown: JSON.stringify(this.current()) });
    element("copy").hidden = true;
    this.tell(looking ? "To look at only." : "");
    this.lock(looking);
  }

  // The person shows something else: it stays, whatever the cockpit has.
  choose() {
    this.begin();
    Object.assign(this, { shown: null, touched: true });
  }

  // Shows what this device kept when the page was left.
  restore() {
    const { robot, id, version, name, program, unsaved } = load() ?? {};
    if (typeof program !== "string" || !/^[0-9a-f]{16}$/.test(id)) return;
    Object.assign(this, { robot: robot ?? null, restored: { name: clean(name), program, unsaved: Boolean(unsaved) } });
    if (version) this.versions.set(id, version);
    this.display(clean(name), program, id);
  }

  // A state has arrived. changes: grows with each change to the robot's programs
  update(robot, changes) {
    if (!robot || changes === undefined) return;
    const { restored } = this;
    const first = this.robot === null; // what has no robot yet becomes this one's
    const other = robot !== this.robot;
    this.restored = null;
    if (other && !first) this.begin();
    if (other) Object.assign(this, { robot, changes: undefined, openNewest: true });
    if (restored) this.reopen = !restored.unsaved;
    if (restored?.unsaved && (first || !other)) this.keep(restored);
    else if (first && this.touched) this.keep(this.current());
    if (changes !== this.changes) this.refresh(robot);
    this.changes = changes;
  }

  async refresh(robot) {
    try {
      const { programs } = await ask({ do: "list", robot });
      if (robot !== this.robot) return;
      this.rows = programs;
    } catch {
      this.changes = undefined; // asks again with the next state
      return;
    }
    this.list();
    const row = this.rows.find(({ id }) => id === this.id);
    const idle = !this.pending.size && !this.saving && !this.looking;
    if (row && idle && row.version !== this.versions.get(this.id)) {
      if (this.reopen) this.open(this.id);
      else this.refuse(CHANGED);
    }
    if (!row && idle && this.versions.has(this.id)) this.keep(this.current()); // the cockpit was started again
    const newest = this.rows.find(({ deleted }) => !deleted);
    if (this.openNewest && newest && !this.touched) this.open(newest.id);
    this.openNewest = this.reopen = false;
  }

  // The blocks or the name may have changed.
  changed() {
    if (this.looking) return;
    const work = this.current();
    const text = JSON.stringify(work);
    const before = this.shown;
    this.shown = text;
    if (before === null || text === before) return;
    this.keep(work);
  }

  keep({ name, program }) {
    this.touched = true;
    store({ robot: this.robot, id: this.id, version: this.versions.get(this.id), name, program, unsaved: true });
    if (!this.robot || !element("copy").hidden) return;
    if (new TextEncoder().encode(program).length > MAX_SIZE) return this.tell(TOO_LARGE, true);
    this.pending.set(this.id, { robot: this.robot, id: this.id, name: clean(name), program });
    this.tell("Not kept yet");
    this.saveAfter(SAVE_AFTER);
  }

  saveAfter(ms) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.save(), ms);
  }

  async save() {
    const work = this.unanswered ?? [...this.pending.values()][0];
    if (this.saving || !work) return;
    this.saving = true;
    this.unanswered = work;
    const again = await this.send(work);
    this.saving = false;
    if (again || this.pending.size) this.saveAfter(again ? RETRY_AFTER : 0);
  }

  // Sends a program; returns whether it must be sent again.
  async send(work) {
    try {
      const { version } = await ask({ do: "save", version: this.versions.get(work.id) ?? 0, ...work });
      this.versions.set(work.id, version);
      this.answered(work);
      if (!this.pending.size) this.tell("Kept");
      if (work.id === this.id) store({ ...work, version, unsaved: this.pending.has(work.id) });
      return false;
    } catch (error) {
      const refused = error instanceof NotKept;
      if (refused && !error.again) this.answered(work);
      if (refused && !error.again && work.id === this.id) this.refuse(error.message);
      else this.tell(refused ? error.message : WAITS, true);
      return !refused || error.again;
    }
  }

  answered(work) {
    this.unanswered = null;
    if (this.pending.get(work.id) === work) this.pending.delete(work.id);
  }

  // The shown program is not kept as it is now; if another page has changed it, under its id no more.
  refuse(text) {
    this.pending.delete(this.id);
    this.tell(text, true);
    element("copy").hidden = text !== CHANGED;
  }

  async open(id) {
    await this.act(async () => {
      const { name, program, version, robot } = await ask({ do: "open", robot: this.robot, id });
      this.versions.set(id, version);
      this.display(name, program, id);
      store({ robot, id: this.id, version, name, program });
      this.toggle(false);
    });
  }

  // Shows a program of any robot, which is not changed.
  async look({ robot, id }) {
    await this.act(async () => {
      const { name, program } = await ask({ do: "open", robot, id });
      this.display(name, program, newId(), true);
    });
  }

  create() {
    this.display("Program", "");
    this.touched = true;
    this.toggle(false);
  }

  // What cannot be shown is not overwritten by what is shown instead.
  display(name, program, id = newId(), looking = false) {
    this.begin(id, looking);
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

  copy({ id, robot }) {
    return this.act(async () => {
      const { name, program } = await ask({ do: "open", robot, id });
      await ask({ do: "save", robot, id: newId(), version: 0, name: copyOf(name), program });
    });
  }

  // Deletes a program, or undoes that.
  remove({ id, robot, version, deleted }) {
    return this.act(async () => {
      await ask({ do: deleted ? "restore" : "delete", robot, id, version });
      if (id === this.id) this.begin();
    });
  }

  async act(action) {
    try {
      await action();
    } catch (error) {
      setText(element("work-problem"), error instanceof NotKept ? error.message : "The cockpit does not answer.");
    }
  }

  toggle(on = element("work").hidden) {
    element("work").hidden = !on;
    element("programs").setAttribute("aria-pressed", on);
    setText(element("work-problem"), "");
    this.list();
  }

  list() {
    if (!element("work").hidden) element("work-list").replaceChildren(...this.rows.map((row) => this.item(row)));
  }

  item(row) {
    const item = create("li", row.deleted ? "deleted" : "");
    const buttons = row.deleted ? [button("Undo", row.name, () => this.remove(row))] : [
      button("Copy", row.name, () => this.copy(row)), button("Delete", row.name, () => this.remove(row))];
    const name = create("button", "name", row.name);
    name.disabled = row.deleted;
    name.addEventListener("click", () => this.open(row.id));
    if (row.id === this.id) name.setAttribute("aria-current", "true");
    item.append(name, ...buttons);
    return item;
  }

  tell(text, bad = false) {
    setText(element("kept"), text);
    element("kept").dataset.level = bad ? "warning" : "";
  }
}

function button(text, name, action) {
  const made = create("button", "", text);
  made.setAttribute("aria-label", `${text}: ${name}`);
  made.addEventListener("click", action);
  return made;
}

function clean(name) {
  return toName(String(name).slice(0, MAX_NAME)) || "Program";
}

function copyOf(name) {
  return clean(`${name.slice(0, MAX_NAME - 5)} copy`);
}

function load() {
  try {
    return JSON.parse(recall(KEY));
  } catch { // nothing, or something else, is there
    return null;
  }
}

function store(work) {
  remember(KEY, JSON.stringify(work));
}
