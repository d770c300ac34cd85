// Puts marks into a Python program, at which the page gets its turn: before each statement, and in each round of a
// loop. All lines keep their numbers. It knows no page.

const SIMPLE = /^(?!If|While|For|Try|With|Match|Decorated).*Statement$/;
const PLACES = ["Script", "Body", "StatementGroup"]; // of statements

// Returns the program with its marks. tree: of CodeMirror's parser; what that does not understand has none
export function mark(source, tree) {
  const marks = new Marks(source);
  tree.iterate({ enter: ({ node }) => {
    if (SIMPLE.test(node.name) && PLACES.includes(node.parent.name)) marks.addStatement(node);
    else HEADS[node.name]?.(marks, node);
  } });
  return marks.written();
}

// What is marked in the head of a statement: the condition, whenever it is asked; the loop, in each round
const HEADS = {
  IfStatement: markConditions, WhileStatement: markConditions,
  ForStatement(marks, node) {
    const [values, body] = [node.getChild("in")?.nextSibling, node.getChild("Body")];
    if (values && body) marks.wrap(node, "_each(%, (", values.from, body.prevSibling?.to ?? body.from, "))");
  },
};

function markConditions(marks, node) {
  for (const word of ["if", "while", "elif"].flatMap((each) => node.getChildren(each))) {
    const { nextSibling: condition } = word;
    if (condition) marks.wrap(word, "_at(%) or (", condition.from, condition.to, ")");
  }
}

class Marks {
  insertions = []; // { at, text }
  lines = new Set(); // that have a mark

  constructor(source) {
    this.source = source;
    this.ends = [...source.matchAll(/\n/g)].map(({ index }) => index);
  }

  // Returns the number of the line of this position, from 1.
  lineOf(position) {
    const index = this.ends.findIndex((end) => end >= position);
    return (index < 0 ? this.ends.length : index) + 1;
  }

  addStatement({ from }) {
    const line = this.lineOf(from);
    if (!this.lines.has(line)) this.insertions.push({ at: from, text: `_at(${line});` });
    this.lines.add(line);
  }

  wrap(node, before, from, to, after) {
    const line = this.lineOf(node.from);
    this.lines.add(line);
    this.insertions.push({ at: from, text: before.replace("%", line) }, { at: to, text: after });
  }

  written() {
    const inOrder = this.insertions.sort((one, other) => one.at - other.at);
    const parts = inOrder.map(({ at, text }, index) => this.source.slice(inOrder[index - 1]?.at ?? 0, at) + text);
    return parts.join("") + this.source.slice(inOrder.at(-1)?.at ?? 0);
  }
}
