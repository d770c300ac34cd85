// The editor of a program that is a text: CodeMirror, in the page's colours and language.

import { create } from "../dom.js";
import { t } from "../language.js";
import { toLines } from "../program/check.js";
import {
  bracketMatching, classHighlighter, closeBrackets, closeBracketsKeymap, Compartment, Decoration, defaultKeymap,
  EditorState, EditorView, highlightSpecialChars, history, historyKeymap, indentLess, indentMore, indentOnInput,
  indentUnit, keymap, lineNumbers, pythonLanguage, redo, StateEffect, StateField, syntaxHighlighting, undo,
} from "../vendor/codemirror/codemirror.js";
import { COMPLETION } from "./completions.js";
import { beBlocks } from "./question.js";

const LEAVE = t("Tab indents. Escape, then Tab, leaves the text.");
const LIKE_SPACES = /[\u00a0\u3000]/; // which Python takes for no spaces
const TOOLS = [
  { text: "↶", name: t("Undo"), does: undo }, { text: "↷", name: t("Redo"), does: redo },
  { text: "⇥", name: t("Indent"), does: indentMore }, { text: "⇤", name: t("Unindent"), does: indentLess },
];
const BACK = { text: t("Back to blocks"), id: "to-blocks", next: "edit" };
const MARGIN = 60; // px around a marked line
const KINDS = ["now", "failed"].map((name) => ({ name, decoration: Decoration.line({ class: name }) }));

const mark = StateEffect.define(); // { now, failed }: the numbers of the lines that are marked, or null
const marks = StateField.define({
  create: () => Decoration.none,
  update(shown, { changes, effects, state }) {
    const found = effects.find((each) => each.is(mark));
    return found ? marksAt(state.doc, found.value) : shown.map(changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});

const EXTENSIONS = [
  lineNumbers(), history(), indentOnInput(), bracketMatching(), closeBrackets(), COMPLETION, marks,
  highlightSpecialChars({ addSpecialChars: LIKE_SPACES }),
  pythonLanguage, syntaxHighlighting(classHighlighter), indentUnit.of("    "), EditorState.tabSize.of(8),
  keymap.of([{ key: "Tab", run: indentMore, shift: indentLess }, ...closeBracketsKeymap, ...defaultKeymap,
    ...historyKeymap]),
  EditorView.clipboardInputFilter.of((text) => toLines(text)),
  EditorView.contentAttributes.of({ "aria-label": t("Python"), "aria-description": LEAVE, tabindex: "0" }),
  EditorState.phrases.of({
    "Completions": t("Suggestions"), "Control character": t("Control character"),
    "Selection deleted": t("Selection deleted"),
  }),
];

await new Promise((resolve, reject) => {
  const style = { rel: "stylesheet", href: new URL("./editor.css", import.meta.url).href };
  document.head.append(Object.assign(create("link"), style, { onload: resolve, onerror: reject }));
});

function marksAt(doc, lines) {
  const kinds = KINDS.filter(({ name }) => lineAt(doc, lines[name]));
  return Decoration.set(kinds.map(({ name, decoration }) => decoration.range(lineAt(doc, lines[name]).from)), true);
}

function lineAt(doc, number) {
  return number >= 1 && number <= doc.lines ? doc.line(number) : null;
}

export class Editor {
  locking = new Compartment();
  marked = {}; // what is marked
  /** @type {any} */
  before = null; // shows the part that was in sight before the program ran, until the text is changed

  // target: where it is; program: the Shown whose text it is
  constructor(target, program) {
    this.program = program;
    this.view = new EditorView();
    target.replaceChildren(this.tools(), this.view.dom, create("p", "hint", LEAVE));
    beBlocks(() => program.convert(null));
    this.show(program.text ?? "");
  }

  tools() {
    const bar = create("div", "tools");
    bar.append(...TOOLS.map((each) => tool(each, () => each.does(this.view))), tool(BACK));
    return bar;
  }

  // Shows a text; its earlier changes cannot be undone.
  show(python) {
    Object.assign(this, { marked: {}, before: null });
    this.view.setState(EditorState.create({ doc: python, extensions: [
      EXTENSIONS, this.locking.of(lock(this.program.locked)),
      EditorView.updateListener.of(({ docChanged, state }) => docChanged && this.changed(state)),
    ] }));
  }

  changed({ doc }) {
    this.before = null;
    this.program.textChanged(toLines(doc.toString()));
  }

  lock(on) {
    this.view.dispatch({ effects: this.locking.reconfigure(lock(on)) });
  }

  // The person begins to edit the line with this index.
  begin(index) {
    const { from } = lineAt(this.view.state.doc, index + 1) ?? { from: 0 };
    this.view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: "start" }) });
    this.view.focus();
  }

  // Marks the line that runs and the one that has failed, and scrolls to it, or back once none is marked. Lines have
  // numbers from 1.
  mark(now, failed) {
    if (now === this.marked.now && failed === this.marked.failed) return;
    if (now && !this.marked.now) this.before = this.view.scrollSnapshot();
    this.marked = { now, failed };
    const line = lineAt(this.view.state.doc, now ?? failed);
    const scrolls = line ? EditorView.scrollIntoView(line.from, { yMargin: MARGIN }) : this.before;
    this.view.dispatch({ effects: [mark.of(this.marked), ...scrolls ? [scrolls] : []] });
  }
}

function lock(on) {
  return [EditorState.readOnly.of(on), EditorView.editable.of(!on)];
}

// Returns a button that leaves the keyboard of a tablet where it is.
function tool({ text, name = text, id = "", next = "" }, act = () => {}) {
  const made = Object.assign(create("button", "", text), { type: "button", id, title: name, ariaLabel: name });
  made.dataset.next = next;
  made.addEventListener("mousedown", (event) => event.preventDefault());
  made.addEventListener("click", act);
  return made;
}
