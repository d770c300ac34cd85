// Runs one Python program, in a thread of its own: so the page can always end it. The page answers each message, with
// which the program goes on: { seconds: the program's clock, senses: what the robot senses, slow: whether each line is
// to wait for the page }.

import { Machine } from "./machine.js";

const SLICE = 8; // ms that a program computes before the page has its turn
const MOST_EVENTS = 50; // at a time
const VARIABLES_EVERY = 100; // ms
const LONGEST = 10000; // characters of a print

const machine = new Machine();
let state = { seconds: 0, senses: {}, slow: true };
let answeredAt = 0; // as performance.now() counts
let [line, told] = [0, 0]; // that runs, and as the page knows it
let events = []; // since the last turn
let problem = null; // why the program has failed first
let shownAt = -Infinity; // when the page got the variables

// What Python's module _page has
const page = {
  at(number) {
    line = number;
    if (state.slow || performance.now() - answeredAt > SLICE) return turn({ step: line });
  },
  turn(seconds) {
    if (told !== line) events.push({ step: line });
    return turn({ wait: seconds });
  },
  seconds: () => state.seconds + (performance.now() - answeredAt) / 1000 + 1e-9, // a whole number would be an int
  senses: () => JSON.stringify(state.senses),
  drive: (x, z) => add({ motion: [x, z] }),
  show: (text) => add({ print: text.slice(0, LONGEST) }),
  curve: (name, value) => add({ name: name.slice(0, LONGEST), value }),
  fail(type, message, trace) {
    const lines = [...trace.matchAll(/"program\.py", line (\d+)/g)].map(([, each]) => Number(each));
    problem ??= { type, message, line: lines.at(-1) ?? line };
  },
};

function add(event) {
  events.push(event);
  if (events.length > MOST_EVENTS) return turn({ breathe: true });
}

// Gives the page its turn, and ends with its answer.
async function turn(event) {
  told = line;
  const shows = performance.now() - shownAt > VARIABLES_EVERY || state.slow;
  if (shows) shownAt = performance.now();
  postMessage({ events: [...events, event], variables: shows ? machine.evaluate("variables") : null });
  events = [];
  await answer();
}

async function answer() {
  state = await new Promise((resolve) => {
    addEventListener("message", ({ data }) => resolve(data), { once: true });
  });
  answeredAt = performance.now();
}

async function main() {
  await answer(); // what is to be run
  const { wasm, files, program } = state;
  const given = { ...page, program: () => program };
  await machine.load({ wasm, files, page: given, written: (text) => add({ print: text }) });
  await machine.run();
  postMessage({ events, variables: machine.evaluate("variables"), over: true, problem });
}

main().catch((error) => postMessage({ events, variables: null, broken: String(error) }));
