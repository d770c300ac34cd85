// What is shown of a program that runs: its Python, the block and the line that run, its variables, what it prints.

import { create, element, setText } from "../dom.js";
import { print } from "./prints.js";
import { shown } from "./values.js";

const MAX_VALUE = 100; // characters

let lines = new Map(); // of the Python, by the ids of the blocks
let printed = false; // since it was shown
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

// Scrolls to the first function that has blocks of the person's: what is above it is alike in all programs.
function showOwnPart() {
  const box = element("python");
  let part = box.children[Math.min(...lines.values())];
  while (part && !part.textContent.startsWith("def ")) part = part.previousElementSibling;
  if (part && !scrolled) box.scrollTop = part.offsetTop - box.firstChild.offsetTop;
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

export function showPrint(text) {
  print(text);
  printed = true;
}

// Shows the values of the variables, by their ids, and what was printed last.
export function showOutput(workspace, values) {
  const known = workspace.getVariableMap().getAllVariables().filter((each) => values.has(each.getId()));
  const texts = known.flatMap((each) => [each.getName(), String(shown(values.get(each.getId()))).slice(0, MAX_VALUE)]);
  const parts = element("variables").children;
  if (parts.length === texts.length) texts.forEach((text, index) => setText(parts[index], text));
  else element("variables").replaceChildren(...texts.map((text, index) => create(index % 2 ? "dd" : "dt", "", text)));
  if (printed) element("output").scrollTop = element("output").scrollHeight;
  printed = false;
}

export function setOutcome(text, warning = false) {
  setText(element("outcome"), text);
  element("outcome").dataset.level = warning ? "warning" : "";
}
