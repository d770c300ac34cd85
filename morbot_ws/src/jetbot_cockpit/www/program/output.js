// What is shown of a program that runs: its Python, the block and the line that run, its variables, what it prints.

import { create, element, setText } from "../dom.js";
import { clearPrints, MAX_PRINTS, print } from "./prints.js";
import { shown } from "./values.js";

const MAX_VALUE = 100; // characters

let lines = new Map(); // of the Python, by the ids of the blocks
/** @type {string[]} */
let printed = []; // since the output was shown
let wasHeld = false; // the program was paused when it was shown last
let scrolled = false; // the person has scrolled the Python

for (const type of ["wheel", "pointerdown", "keydown"]) {
  element("python").addEventListener(type, () => { scrolled = true; }, { passive: true });
}
new ResizeObserver(showOwnPart).observe(element("python"));

export function showPython(python) {
  lines = python.lines;
  element("python").replaceChildren(...python.text.trimEnd().split("\n").map((line) => create("div", "", line || " ")));
  showOwnPart();
}

// Returns the index of the line in which the first function begins that has blocks of the person's: what is above it is
// alike in all programs.
export function ownLine() {
  const texts = [...element("python").children].map(({ textContent }) => textContent);
  return texts.findLastIndex((text, index) => index <= Math.min(...lines.values()) && text.startsWith("def "));
}

function showOwnPart() {
  const { children, firstChild } = element("python");
  const part = children[ownLine()];
  if (part && !scrolled) element("python").scrollTop = part.offsetTop - firstChild.offsetTop;
}

// Marks the block that runs, and its line.
export function showPlace(workspace, run) {
  const id = run?.waitless ? loopAround(workspace, run.at) : run?.at ?? null;
  workspace.highlightBlock(id);
  const line = element("python").children[lines.get(id)] ?? null;
  const before = element("python").querySelector(".now");
  if (before === line) return;
  before?.classList.remove("now");
  line?.classList.add("now");
  if (!line) return;
  line.scrollIntoView({ block: "center", inline: "nearest" });
  scrolled = false;
}

// Returns the id of the innermost loop with this block in it, or its own.
function loopAround(workspace, id) {
  let block = workspace.getBlockById(id);
  while (block && !block.getInput("DO")) block = block.getSurroundParent();
  return block?.id ?? id;
}

// Shows what a program prints with the next output: it may print much.
export function showPrint(text) {
  printed = [...printed, text].slice(-MAX_PRINTS);
}

export function clearOutput() {
  printed = [];
  clearPrints();
}

// Returns [name, value] of each variable that has one. values: by the variables' ids
export function blockVariables(workspace, values) {
  const known = workspace.getVariableMap().getAllVariables().filter((each) => values.has(each.getId()));
  return known.map((each) => [each.getName(), String(shown(values.get(each.getId())))]);
}

// Shows the variables, [name, value] of each, and what was printed last; held: the variables are in sight, to be read.
export function showOutput(variables, held) {
  const texts = variables.flatMap(([name, value]) => [name, value.slice(0, MAX_VALUE)]);
  const parts = element("variables").children;
  if (parts.length === texts.length) texts.forEach((text, index) => setText(parts[index], text));
  else element("variables").replaceChildren(...texts.map((text, index) => create(index % 2 ? "dd" : "dt", "", text)));
  for (const text of printed) print(text);
  if (printed.length || held !== wasHeld) element("output").scrollTop = held ? 0 : element("output").scrollHeight;
  [printed, wasHeld] = [[], held];
}

export function setOutcome(text, warning = false) {
  setText(element("outcome"), text);
  element("outcome").dataset.level = warning ? "warning" : "";
}
