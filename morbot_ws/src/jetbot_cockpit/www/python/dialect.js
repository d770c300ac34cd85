// What Python has and MicroPython lacks, put into a program by functions of modules/_dialect.py. All lines keep their
// numbers, and no quotation mark is added, as a text in an f-string may not hold those around it. It knows no page.

const METHODS = ["capitalize", "center", "is_integer", "ljust", "lower", "removeprefix", "removesuffix", "rjust",
  "swapcase", "title", "upper", "zfill"];

// What is rewritten, by the kind of the node; edits: insert(at, text), close(at, text), replace(node, text)
/** @type {Record<string, (edits: any, node: any) => void>} */
export const DIALECT = {
  CallExpression(edits, node) {
    const [callee, given] = [node.firstChild, node.getChild("ArgList")];
    const name = callee.getChild("PropertyName");
    if (["str", "repr"].includes(edits.text(callee))) edits.replace(callee, `_py_${edits.text(callee)}`);
    if (callee.name !== "MemberExpression" || !name || !METHODS.includes(edits.text(name))) return;
    edits.insert(node.from, `_py_${edits.text(name)}(`);
    for (const each of [before(name), name]) edits.replace(each, "");
    edits.replace(given.firstChild, ",");
  },
  MemberExpression(edits, node) { // [start:end:step]
    const colons = node.getChildren(":");
    if (colons.length < 2 || isTarget(node)) return;
    edits.insert(node.from, "_py_step(");
    edits.replace(node.getChild("["), ",");
    for (const each of colons) edits.replace(each, "[:".includes(edits.text(before(each))) ? "None," : ",");
    edits.replace(node.lastChild, edits.text(before(node.lastChild)) === ":" ? "None)" : ")");
  },
  ArrayExpression: (edits, node) => display(edits, node, "_py_list("),
  TupleExpression: (edits, node) => display(edits, node, "_py_tuple("),
  SetExpression: (edits, node) => display(edits, node, "_py_set("),
  DictionaryExpression(edits, node) {
    if (!node.getChild("**")) return;
    edits.replace(node.firstChild, "_py_dict(");
    for (const each of node.getChildren("**")) edits.replace(each, "");
    for (const each of node.getChildren(":")) {
      edits.insert(before(each).from, "{");
      edits.close(after(each).to, "}");
    }
    edits.replace(node.lastChild, ")");
  },
  ParamList(edits, node) { // f(a, *, b)
    const star = node.getChildren("*").find((each) => after(each)?.name === ",");
    if (star) edits.replace(star, "*_py_rest");
  },
  FormatReplacement(edits, node) { // {x} in an f-string
    const value = node.firstChild.nextSibling;
    if (value.nextSibling !== null && edits.text(value.nextSibling) !== "}") return;
    edits.insert(value.from, "_py_str(");
    edits.close(value.to, ")");
  },
  RaiseStatement(edits, node) { // raise ... from error
    const from = node.getChild("from");
    if (["VariableName", "None"].includes(from?.nextSibling.name)) {
      for (const each of [from, from.nextSibling]) edits.replace(each, "");
    }
  },
};

// Returns what is beside a node; comments are not.
function before({ prevSibling: found }) {
  return found?.name === "Comment" ? before(found) : found;
}

function after({ nextSibling: found }) {
  return found?.name === "Comment" ? after(found) : found;
}

// Whether this gets a value, or is deleted.
function isTarget({ parent, to }) {
  const operator = parent.getChildren("AssignOp").at(-1) ?? parent.getChild("UpdateOp");
  return parent.name === "DeleteStatement" || operator && to <= operator.from;
}

// [*a, b]
function display(edits, node, call) {
  if (!node.getChild("*") || !"[({".includes(edits.text(node.firstChild)) || isTarget(node)) return;
  edits.replace(node.firstChild, call);
  edits.replace(node.lastChild, ")");
}
