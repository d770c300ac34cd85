// Writes what the page does with programs, and their Python. Which: examples; given, an object of them in JSON;
// random FROM TO, those of these seeds; smaller, what the given one becomes if a block is taken out; texts, given as
// an object, which run in the page; marked, texts with their marks.

import "./last_digits.js";

import { readFileSync } from "node:fs";

import { parseProgram } from "#www/program/check.js";
import { shown } from "#www/program/values.js";
import { mark } from "#www/python/marks.js";
import { syntaxProblem } from "#www/python/syntax.js";
import { pythonLanguage } from "#www/vendor/codemirror/codemirror.js";

import { write } from "./blockly.js";
import { runText } from "./page_worker.js";
import { interpret } from "./programs.js";
import { randomProgram } from "./random_programs.js";
import { smallerPrograms } from "./smaller_programs.js";

const MOST = 5000; // events of blocks
const SECONDS = 10; // of a text's clock
const SENSES = { here: { X: 0, Y: 0, HEADING: 0 }, line: [0.25, 0.5, 1], wheels: [0, 0] }; // program_node.py's
const { EXAMPLES } = await import("#www/program/examples.js");
const standardInput = () => JSON.parse(readFileSync(0, "utf8"));

const CHOICES = {
  examples: () => Object.entries(EXAMPLES).map(([name, text]) => [name, JSON.parse(text)]),
  given: () => Object.entries(standardInput()),
  random: (from, to) => Array.from({ length: to - from }, (_, index) => [+from + index, randomProgram(+from + index)]),
  smaller: () => Object.entries(smallerPrograms(standardInput())),
};

// Returns draws from a stream of random numbers in [0, 1) that program_node.py has too: Park and Miller's
function dice() {
  let state = 1234567;
  return () => {
    state = state * 16807 % 2147483647;
    return state / 2147483647;
  };
}

// Gives each block an id, as Blockly does.
function identified(program) {
  let last = 0;
  const number = (_, each) => (each?.type ? { id: `block ${last += 1}`, ...each } : each);
  return JSON.parse(JSON.stringify(program), number);
}

function translate(given) {
  const saved = identified(given);
  const program = parseProgram(JSON.stringify(saved));
  Math.random = dice();
  const { prints, commands, trace, cut, exact, error, block } = interpret(program, SENSES, MOST);
  const { text, lines } = write(program);
  return { prints, commands, trace, cut, exact, error, block, python: text, lines: [...lines], program: saved };
}

// Translates one of the programs that become smaller: Blockly refuses some of them.
function tried([name, program]) {
  try {
    return [[name, translate(program)]];
  } catch {
    return [];
  }
}

// Whether there is more to do than to translate programs of blocks: texts are run or marked.
const TEXTS = {
  texts: (text) => runText(text, { duration: SECONDS, computing: "free" }),
  marked: (text) => ({ marked: mark(text, pythonLanguage.parser.parse(text)), problem: syntaxProblem(text) }),
};

async function translated(choice, numbers) {
  if (choice === "smaller") return CHOICES.smaller().flatMap(tried);
  const act = TEXTS[choice] ?? translate;
  const done = [];
  for (const [name, program] of (CHOICES[choice] ?? CHOICES.given)(...numbers)) done.push([name, await act(program)]);
  return done;
}

const [, , choice, ...numbers] = process.argv;
const finite = (_, value) => (typeof value === "number" && !Number.isFinite(value) ? shown(value) : value);
console.log(JSON.stringify(Object.fromEntries(await translated(choice, numbers)), finite));
