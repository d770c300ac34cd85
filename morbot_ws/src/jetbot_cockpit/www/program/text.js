// A program that is a text: what it holds, and its editor, which is loaded when it is needed first.

import { element, setText } from "../dom.js";

export class Text {
  /** @type {string | null} */
  python = null; // null: the program is its blocks
  locked = false; // whether nobody may change it
  /** @type {any} */
  failed = null; // the line where it has failed, until it is changed
  /** @type {any} */
  editor = null;
  /** @type {Promise<void> | null} */
  loading = null;
  /** @type {any} */
  question = null; // whether the program is to become a text

  // page: convert(python): the program is this text from now on, or its blocks; changed(): a person has changed it;
  // python(): what the blocks are in Python; notLoaded()
  constructor(page) {
    this.page = page;
    element("edit").addEventListener("click", () => this.question ?? this.ask());
  }

  ask() {
    import("../python/question.js").then(({ beText }) => {
      this.question ??= beText(() => this.begin());
      this.question.toggle(true);
    }, this.page.notLoaded);
  }

  // The person edits the Python from now on.
  async begin() {
    this.page.convert(this.page.python());
    await this.loading;
    this.editor?.focus();
  }

  // Shows a text in place of the blocks; null: the blocks.
  show(python) {
    this.python = python;
    this.failed = null;
    element("text").hidden = python === null;
    if (this.editor) this.editor.show(python ?? "");
    else if (python !== null) this.loading = this.load(python);
  }

  load(python) {
    setText(element("text"), python);
    return import("../python/editor.js").then(({ Editor }) => { this.editor ??= new Editor(element("text"), this); },
      this.page.notLoaded);
  }

  change(python) {
    this.python = python;
    this.failed = null;
    this.page.changed();
  }

  lock(on) {
    this.locked = element("edit").disabled = on;
    this.editor?.lock(on);
  }

  // Marks the line that runs, or null, and the one that has failed. Lines have numbers from 1.
  mark(now) {
    this.editor?.mark(now, this.failed);
  }
}
