// One program that the cockpit keeps: each change is sent after a second, and again until the cockpit has answered.
// It knows no page.
//
//   unchanged, kept, refused, foreign, older -- change --> waiting, or refused here
//   waiting -- a second without a change --> sending -- the cockpit's answer --> kept, refused or foreign
//   unchanged, kept -- another page has saved it --> older

import { t } from "../language.js";
import { ask, newId } from "./ask.js";
import { problemOf } from "./check.js";
import { clean } from "./names.js";
import { isTooLarge } from "./room.js";

const SAVE_AFTER = 1000; // ms after the last change
const RETRY_AFTER = 3000; // ms
const TOO_LARGE = t("Too large to be kept here. Save it as a file.");
const NEW = t("Not kept until you change it.");
const FOREIGN = t("A change waits on this device for its own class.");
const NEWER = t("There is a newer version of this program.");
export const NOT_YET = t("Not kept yet");

// What a person reads in each state; bad: as a warning; unsaved: the cockpit has another content
const STATES = {
  unchanged: { text: "" }, // since it was opened, or begun; a new one has another text
  waiting: { text: NOT_YET, unsaved: true }, // timer
  sending: { text: NOT_YET, unsaved: true }, // perhaps the cockpit has kept it, and its answer was lost
  kept: { text: t("Kept") },
  refused: { bad: true, unsaved: true }, // text: why it is not kept as it is
  foreign: { text: FOREIGN, unsaved: true }, // the cockpit has another class
  older: { text: NEWER, bad: true }, // newer: the version that another page has saved
};

/** @typedef {{ name: string, text?: string, bad?: boolean, unsaved?: boolean, timer?: number, newer?: number }} State
 */

export class Kept {
  // robot: whose program it is, null as long as there is none; version: as the cockpit has it, 0 for a new program;
  // classId: of the class that keeps it, null for one without a name; content: { name, program }, null until there is
  // something to keep; report(kept): it is in another state
  constructor(robot, { id = newId(), version = 0, classId = null, content = null }, report) {
    this.robot = robot;
    this.id = id;
    this.version = version;
    this.classId = classId;
    this.content = content;
    this.report = report;
    /** @type {State} */
    this.state = { name: "unchanged", text: version ? "" : NEW };
  }

  enter(name, data = {}) {
    clearTimeout(this.state.timer);
    this.state = { name, ...STATES[name], ...data };
    this.report(this);
  }

  change(content) {
    this.content = content;
    if (this.state.name === "sending") return this.enter("sending"); // what was sent comes first
    const problem = isTooLarge(content.program) ? TOO_LARGE : problemOf(content.program);
    if (problem) this.enter("refused", { text: problem });
    else this.enter("waiting", { timer: setTimeout(() => this.save(), SAVE_AFTER) });
  }

  belongTo(robot) {
    this.robot = robot;
    return this.save();
  }

  // Sends what waits, now.
  async save() {
    if (this.state.name !== "waiting" || this.robot === null) return;
    const { content } = this;
    this.enter("sending");
    this.enter(...await this.send(content));
    if (this.content !== content) this.change(this.content);
  }

  // Sends until the cockpit answers; returns the state after that.
  async send({ name, program }) {
    for (;;) {
      try {
        const { robot, id, version, classId } = this;
        const fields = { do: "save", class: classId, robot, id, version, name: clean(name), program };
        ({ version: this.version, class: this.classId } = await ask(fields));
        return ["kept"];
      } catch ({ message, code, again }) {
        if (code === "other_class") return ["foreign"];
        if (!again) return ["refused", { text: message }];
        this.enter("sending", { text: t("{problem} The page tries again.", { problem: message }), bad: true });
      }
      await new Promise((resolve) => { setTimeout(resolve, RETRY_AFTER); });
    }
  }

  // Takes its row of the cockpit's list, which may be a little old.
  compare({ version }) {
    if (version > this.version && !this.state.unsaved) this.enter("older", { newer: version });
  }
}
