// Which variables the function has whose statement comes next, as a Python program is read from its beginning to its
// end. It knows no page.

const MOST = 20; // variables, those that got their values last

export class Locals {
  blocks = []; // around the statement, the innermost last: { owner: node, names: [] }

  // text(node): of the program
  constructor(text) {
    this.text = text;
  }

  enter(node) {
    if (node.name === "Body") this.blocks.push({ owner: node.parent, names: first(node.parent).map(this.text) });
  }

  leave(node) {
    if (node.name === "Body") this.blocks.pop();
    const operators = node.name === "AssignStatement" ? node.getChildren("AssignOp") : [];
    if (operators.length) this.blocks.at(-1)?.names.push(...variables(node, operators.at(-1)).map(this.text));
  }

  // Returns those that have a value for sure, whatever ran before; none outside of functions.
  names() {
    const start = this.blocks.findLastIndex(({ owner }) => /^(Function|Class)Definition$/.test(owner.name));
    const outermost = this.blocks[start];
    if (outermost?.owner.name !== "FunctionDefinition") return [];
    const all = this.blocks.slice(start).flatMap(({ names }) => names);
    const lost = outermost.lost ??= removed(outermost.owner).map(this.text);
    return [...new Set(all)].filter((name) => !name.startsWith("_") && !lost.includes(name)).slice(-MOST);
  }
}

// The variables with which a block begins: the parameters of its function, but not their defaults; those of its loop
function first(owner) {
  if (owner.name === "ForStatement") return variables(owner, owner.getChild("in"));
  const list = owner.name === "FunctionDefinition" && owner.getChild("ParamList");
  return list ? list.getChildren("VariableName").filter(({ prevSibling }) => prevSibling.name !== "AssignOp") : [];
}

// The variables among the parts of a statement before this one
function variables(node, end) {
  return node.getChildren("VariableName").filter(({ to }) => to <= end.from);
}

// What has no value any more behind "del x" or "except ... as x"
function removed(owner) {
  const found = [];
  owner.cursor().iterate(({ node }) => {
    if (node.name === "DeleteStatement") found.push(...node.getChildren("VariableName"));
    if (node.name === "TryStatement") found.push(...node.getChildren("as").map(({ nextSibling }) => nextSibling));
  });
  return found;
}
