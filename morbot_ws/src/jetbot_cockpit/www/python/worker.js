// Runs one Python program, in a thread of its own: so the page can always end it. The page answers each message, with
// which the program goes on: { seconds: the program's clock, senses: what the robot senses, slow: whether each line is
// to wait for the page }.

import { Machine } from "./machine.js";

const SLICE = 8; // ms that a program computes before the page has its turn
const MOST_EVENTS = 50; // at a time
const VARIABLES_EVERY = 100; // ms
const LONGEST = 10000; // characters of a print
const REACHING = ["fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "WebTransport", "EventSource", "Worker",
  "SharedWorker", "BroadcastChannel", "importScripts", "indexedDB", "caches", "navigator", "Notification"];

const machine = new Machine();
let state = { seconds: 0, senses: {}, slow: true };
let answeredAt = 0; // as performance.now() counts
let [line, told] = [0, 0]; // that runs, and as the page knows it
let events = []; // since the last turn
let unfinished = ""; // line that Python has written
let problem = null; // why the program has failed first
let shownAt = -Infinity; // when the page got the variables

// What Python's module _page has
const page = {
  at(number) {
    line = toNumber(number);
    if (state.slow || performance.now() - answeredAt > SLICE) return turn({ step: line });
  },
  turn(seconds) {
    if (told !== line) events.push({ step: line });
    return turn({ wait: toNumber(seconds) });
  },
  seconds: () => state.seconds + (performance.now() - answeredAt) / 1000 + 1e-9, // a whole number would be an int
  senses: () => JSON.stringify(state.senses),
  digits: (number) => number.toExponential(),
  upper: (text) => toText(text).toUpperCase(),
  lower: (text) => toText(text).toLowerCase(),
  drive(x, z) { // at once: the program may compute next
    events.push({ motion: [toNumber(x), toNumber(z)] });
    return turn({ breathe: true });
  },
  show: (text) => add({ print: toText(text) }),
  curve: (name, value) => add({ name: toText(name), value: toNumber(value) }),
  fail(type, message, trace) {
    const lines = [...trace.matchAll(/"program\.py", line (\d+)/g)].map(([, each]) => Number(each));
    problem ??= { type: toText(type), message: toText(message), line: lines.at(-1) ?? line, marked: line };
  },
};

function toNumber(value) {
  if (["number", "bigint", "boolean"].includes(typeof value)) return Number(value);
  throw new TypeError(`A program gives the page no number: ${typeof value}`);
}

function toText(value) {
  if (typeof value === "string") return value.slice(0, LONGEST);
  throw new TypeError(`A program gives the page no text: ${typeof value}`);
}

function add(event) {
  events.push(event);
  if (events.length > MOST_EVENTS) return turn({ breathe: true });
}

// Takes what a program writes beside print(): it cannot wait there, so what is too much is not shown.
function write(text) {
  const lines = (unfinished + text).split("\n");
  unfinished = toText(lines.pop());
  const room = Math.max(0, MOST_EVENTS - events.length);
  events.push(...lines.slice(0, room).map((line) => ({ print: line.slice(0, LONGEST) })));
}

// Returns what gives the page its turn, and ends with its answer.
function turn(event) {
  return async () => {
    told = line;
    const shows = performance.now() - shownAt > VARIABLES_EVERY || state.slow;
    if (shows) shownAt = performance.now();
    postMessage({ events: [...events, event], variables: shows ? variables() : null });
    events = [];
    state = await answer();
  };
}

// Returns the program's variables; null: there is no room for that, so deep is the program.
function variables() {
  try {
    return machine.evaluate("variables");
  } catch (error) {
    if (error.name === "PythonError") return null;
    throw error;
  }
}

// Returns the page's next message.
async function answer() {
  const { data } = await new Promise((resolve) => {
    addEventListener("message", resolve, { once: true });
  });
  answeredAt = performance.now();
  return data;
}

// Removes what reaches beyond this thread: the program's own policy refuses most of it, too.
function forget() {
  for (let of = globalThis; of; of = Object.getPrototypeOf(of)) {
    for (const name of REACHING) Reflect.deleteProperty(of, name);
  }
}

async function main() {
  const { wasm, files, program, robot } = await answer();
  const functions = { ...page, program: () => program, namespace: () => robot };
  await machine.load({ wasm, files, page: functions, written: write });
  forget();
  postMessage({ events, variables: null }); // it is ready
  state = await answer();
  await machine.run();
  if (unfinished) events.push({ print: unfinished });
  postMessage({ events, variables: variables(), over: true, problem });
}

main().catch((error) => postMessage({ events, variables: null, broken: String(error) }));
