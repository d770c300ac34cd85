// One program that the cockpit keeps: each change is sent after a second, and again until the cockpit has answered.

import { limits } from "../limits.js";
import { toName } from "../storage.js";
import { ask, newId } from "./ask.js";
import { problemOf } from "./check.js";

const SAVE_AFTER = 1000; // ms after the last change
const RETRY_AFTER = 3000; // ms
const TOO_LARGE = "Too large to be kept here. Save it as a file.";
const CONFLICT = "conflict"; // the cockpit's code for this:
const CHANGED = "This program was changed on another page. Open it again, or save yours as a copy.";

export class Kept {
  content = null; // { name, program }, as it was changed last
  unsaved = false; // whether the cockpit has another content
  waiting = null; // the content that is to be sent
  sent = null; // what may have been kept, without an answer: it is sent again before anything newer
  problem = ""; // why the content is not even sent
  foreign = false; // whether another page has changed it: this page keeps it no more

  // robot: whose program it is, null as long as there is none; version: as the cockpit has it, 0 for a new program;
  // report(kept, text, bad): what has become of the content
  constructor(robot, id, version, report) {
    Object.assign(this, { robot, id: id ?? newId(), version, report });
  }

  get pending() {
    return this.waiting !== null || this.sent !== null;
  }

  keep(content) {
    Object.assign(this, { content, unsaved: true });
    const tooLarge = new TextEncoder().encode(content.program).length > limits.program;
    this.problem = tooLarge ? TOO_LARGE : problemOf(content.program);
    if (this.problem) return this.report(this, this.problem, true);
    this.waiting = content;
    this.report(this, "Not kept yet", false);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.save(), SAVE_AFTER);
  }

  // Sends until the cockpit has kept or refused all that is waiting.
  async save() {
    if (this.saving || !this.robot) return;
    this.saving = true;
    while (this.pending) await this.send();
    this.saving = false;
  }

  async send() {
    if (!this.sent) [this.sent, this.waiting] = [this.waiting, null];
    const [{ robot, id, version }, { name, program }] = [this, this.sent];
    try {
      ({ version: this.version } = await ask({ do: "save", robot, id, version, name: clean(name), program }));
      this.sent = null;
      this.unsaved = this.pending || this.problem !== "";
      this.report(this, this.problem || (this.pending ? "Not kept yet" : "Kept"), Boolean(this.problem));
    } catch ({ message, code, again }) {
      if (!again) return this.refuse(message, code);
      this.report(this, message, true);
      await new Promise((resolve) => { setTimeout(resolve, RETRY_AFTER); });
    }
  }

  // Compares it with what the cockpit has, a row of its list. This page's next change is refused, or the other page's.
  compare({ version }) {
    if (version !== this.version) this.refuse(CHANGED, CONFLICT);
  }

  // It is not kept as it is now.
  refuse(text, code) {
    this.waiting = this.sent = null;
    this.foreign = code === CONFLICT;
    this.report(this, text, true);
  }
}

// Returns a name that the cockpit takes.
export function clean(name) {
  return toName(String(name).slice(0, limits.program_name)) || "Program";
}

export function copyOf(name) {
  return clean(`${name.slice(0, limits.program_name - 5)} copy`);
}
