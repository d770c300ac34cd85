// Puts marks into a Python program, at which the page gets its turn: before each statement, and in each round of a
// loop; and what MicroPython lacks. All lines keep their numbers. It knows no page.

import { DIALECT } from "./dialect.js";
import { Locals } from "./locals.js";

const SIMPLE = /^(?!If|While|For|Try|With|Match|Decorated).*Statement$/;
const PLACES = ["Script", "Body", "StatementGroup"]; // of statements

// Returns the program with its marks. tree: of CodeMirror's parser; what that does not understand has none
export function mark(source, tree) {
  const marks = new Marks(source);
  tree.iterate({
    enter({ node }) {
      marks.locals.enter(node);
      if (SIMPLE.test(node.name) && PLACES.includes(node.parent.name)) marks.addStatement(node);
      else HEADS[node.name]?.(marks, node);
      if (!node.getChild("⚠")) DIALECT[node.name]?.(marks, node); // ⚠ is what is no Python
    },
    leave: ({ node }) => marks.locals.leave(node),
  });
  return marks.written();
}

// Returns the line that has failed. line: as MicroPython says: a loop's last one where the condition fails, of
// which it makes the code last; marked: the line of the last mark
export function lineOf(source, tree, { line, marked }) {
  const marks = new Marks(source);
  let found = line;
  tree.iterate({ enter({ name, from, to }) {
    const [first, last] = [from, to].map((position) => marks.lineOf(position));
    if (name === "WhileStatement" && first === marked && line <= last) found = marked;
  } });
  return found;
}

// What is marked in the head of a statement: the condition, whenever it is asked; the loop, in each round
const HEADS = {
  IfStatement: markConditions, WhileStatement: markConditions,
  ForStatement(marks, node) {
    const [values, body] = [node.getChild("in")?.nextSibling, node.getChild("Body")];
    const end = body?.prevSibling?.to ?? body?.from;
    if (values && body) marks.wrap(node, (line) => `_each(${line}, (`, values.from, end, "))");
  },
};

function markConditions(marks, node) {
  for (const word of ["if", "while", "elif"].flatMap((each) => node.getChildren(each))) {
    const { nextSibling: condition } = word;
    if (condition) marks.wrap(word, (line) => `${marks.call(line)} or (`, condition.from, condition.to, ")");
  }
}

class Marks {
  edits = []; // { from, to, text, order }: of those at one place, first what ends there, the innermost first
  lines = new Set(); // that have a mark
  locals = new Locals((node) => this.text(node));

  constructor(source) {
    this.source = source;
    this.ends = [...source.matchAll(/\n/g)].map(({ index }) => index);
  }

  // Returns the number of the line of this position, from 1.
  lineOf(position) {
    let [low, high] = [0, this.ends.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.ends[middle] < position) low = middle + 1;
      else high = middle;
    }
    return low + 1;
  }

  text({ from, to }) {
    return this.source.slice(from, to);
  }

  insert(at, text) {
    this.edits.push({ from: at, to: at, text, order: this.edits.length + 1 });
  }

  close(at, text) {
    this.edits.push({ from: at, to: at, text, order: -this.edits.length - 1 });
  }

  replace({ from, to }, text) {
    this.edits.push({ from, to, text, order: this.edits.length + 1 });
  }

  // Returns the mark of this line, which tells the page the variables of its function.
  call(line) {
    return `_at(${[line, ...this.locals.names().map((name) => `${name}=${name}`)].join(", ")})`;
  }

  addStatement({ from }) {
    const line = this.lineOf(from);
    if (!this.lines.has(line)) this.insert(from, `${this.call(line)};`);
    this.lines.add(line);
  }

  wrap(node, before, from, to, after) {
    const line = this.lineOf(node.from);
    this.lines.add(line);
    this.insert(from, before(line));
    this.close(to, after);
  }

  // Returns the program with its marks. No word that is inserted is glued to one before it: "if(x > 2)"
  written() {
    const inOrder = this.edits.sort((one, other) => one.from - other.from || one.order - other.order);
    const parts = [""];
    let end = 0;
    for (const { from, to, text } of inOrder) {
      const before = this.source.slice(end, from) || parts[parts.length - 1];
      parts.push(this.source.slice(end, from), isWord(before.at(-1)) && isWord(text[0]) ? ` ${text}` : text);
      end = to;
    }
    return parts.join("") + this.source.slice(end);
  }
}

const isWord = (character = "") => /\w/.test(character);
