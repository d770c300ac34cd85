// The page's engine of Python, without a browser: its worker is a thread of Node, whose clock computing hardly turns.

import { readFileSync } from "node:fs";
import { Worker as Thread } from "node:worker_threads";

const BEGINNING = `
const { parentPort, workerData } = require("node:worker_threads");
let listener, now = 0;
performance.now = () => now += 1e-4;
globalThis.postMessage = (data) => parentPort.postMessage(data);
globalThis.addEventListener = (_, act) => {
  listener ?? parentPort.on("message", (data) => listener({ data }));
  listener = act;
};
import(workerData);
`;

const TURN = 1e-6; // s that the page's turn takes: no clock stands while a program waits for less
let failure = null; // of the newest program, in Python's words: { type, message, line }

globalThis.fetch = async (url) => {
  const bytes = readFileSync(url);
  return { ok: true, text: () => String(bytes), arrayBuffer: () => bytes };
};

globalThis.Worker = class {
  constructor(url) {
    this.thread = new Thread(BEGINNING, { eval: true, workerData: String(url) });
    this.thread.on("message", (data) => {
      failure = data.problem;
      this.onmessage({ data });
    });
  }

  postMessage(message) {
    this.thread.postMessage(message);
  }

  terminate() {
    this.thread.terminate();
  }
};

const { PythonEngine } = await import("#www/python/engine.js");

// Runs a program whose robot senses always the same. Returns its trace of prints and commands ([ms, x, z]), which stops
// after so many s; error: the page's sentence, or ""; its line; problem: what Python says
export async function runText(text, senses, longest) {
  const [engine, trace] = [new PythonEngine(text), []];
  let [seconds, error, line, cut] = [0, "", null, false];
  failure = null;
  try {
    await engine.prepare();
    for await (const event of engine.run(() => ({ seconds: seconds += TURN, senses, slow: false }))) {
      if ("print" in event) trace.push(event.print);
      if ("publish" in event) trace.push([Math.round(1000 * seconds), ...engine.motion]);
      seconds += event.wait ?? 0;
      cut = seconds > longest;
      if (cut) break;
    }
  } catch (failed) {
    [error, line] = [failed.message, failed.place ?? null];
  }
  engine.end();
  return { trace, error, line, cut, problem: failure };
}
