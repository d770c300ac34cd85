// The program that is shown: its blocks, with what they are in Python, or a text, whose editor is loaded when it is
// needed first.

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { parseProgram } from "./check.js";
import { currentProgram, limitProgram, openEditor, showProgram, textOf } from "./editor.js";
import { Interpreter } from "./interpreter.js";
import { packageName } from "./names.js";
import { ownLine, setOutcome, showPython } from "./output.js";
import { toPython } from "./python.js";

const DEFAULTS = { workshop: true, wheel_separation: 2, max_speed: 1 };

export class Shown {
  /** @type {string | null} */
  text = null; // null: the program is its blocks
  python = ""; // what it is in Python
  locked = false; // whether nobody may change it
  /** @type {any} */
  failed = null; // the line of the text where it has failed, until it is changed
  changing = 0; // timer of the next look at what was changed
  /** @type {any} */
  editor = null;
  /** @type {Promise<void> | null} */
  loading = null;
  /** @type {any} */
  question = null; // whether the program is to become a text

  // page: robot(): the chosen one, or undefined; changed(differs): the program, or only how it looks; replaces(isText):
  // another one is shown from now on; keepText(): the next change is to replace no text, returns why it would, or "";
  // say(text); notLoaded()
  constructor(page) {
    this.page = page;
    this.workspace = openEditor(element("blocks"), () => this.blocksChanged());
    element("edit").addEventListener("click", () => this.question ?? this.ask());
  }

  // The text by which the program is kept
  get program() {
    return textOf(this.workspace, this.text ?? undefined);
  }

  // Returns what runs the program, or promises it.
  engine(robot) {
    const { text, loading } = this; // WebKit may refuse a module that is asked for again while it is loaded
    return text === null ? new Interpreter(currentProgram(this.workspace), robot)
      : Promise.resolve(loading).then(() => import("../python/engine.js"))
        .then(({ PythonEngine }) => new PythonEngine(text, robot.id));
  }

  // Shows a program from elsewhere; throws a Refusal.
  open(program) {
    const parsed = parseProgram(program);
    showProgram(this.workspace, parsed);
    this.show(parsed.python ?? null);
  }

  // The program is this text from now on; null: its blocks again, below which the text stays as an earlier version.
  convert(text) {
    const problem = text === null && this.page.keepText();
    if (problem) return this.page.say(problem);
    this.show(text);
    this.write();
  }

  show(text) {
    this.page.replaces(text !== null);
    Object.assign(this, { text, failed: null });
    element("text").hidden = text === null;
    if (this.editor) this.editor.show(text ?? "");
    else if (text !== null) this.loading = this.load(text);
  }

  load(text) {
    setText(element("text"), text);
    return Promise.all([import("../python/editor.js"), import("../python/engine.js")]).then(([{ Editor }]) => {
      this.editor ??= new Editor(element("text"), this);
    }, this.page.notLoaded);
  }

  // Asks whether the program is to become a text.
  ask() {
    void import("../python/question.js").then(({ beText }) => {
      this.question ??= beText(async () => {
        const line = ownLine();
        this.convert(this.python);
        await this.loading;
        this.editor?.begin(line);
      });
      this.question.toggle(true);
    }, this.page.notLoaded);
  }

  lock(on) {
    this.locked = element("edit").disabled = on;
    this.workspace.setIsReadOnly(on);
    this.editor?.lock(on);
  }

  // Marks the line of the text that runs, or null, and the one that has failed. Lines have numbers from 1.
  mark(now) {
    this.editor?.mark(now, this.failed);
  }

  // Blockly reports each part of a change, also a little later; where a block lies is no change of the program.
  blocksChanged() {
    this.changing ||= setTimeout(() => {
      this.changing = 0;
      limitProgram(this.workspace, this.page.say);
      this.write();
    });
  }

  textChanged(text) {
    if (this.failed) setOutcome(t("Press Run.")); // what failed is another text
    Object.assign(this, { text, failed: null });
    this.write();
  }

  // Writes the program in Python.
  write() {
    const before = this.python;
    if (this.text === null) {
      const written = toPython(this.workspace, packageName(element("title").value), this.page.robot() ?? DEFAULTS);
      showPython(written);
      this.python = written.text;
    } else this.python = this.text;
    this.page.changed(this.python !== before);
  }
}
