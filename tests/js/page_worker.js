// A page's text runs here as in a browser: by engine.js, in worker.js; Node's workers play the browser's.

import { readFile } from "node:fs/promises";
import { Worker as Thread } from "node:worker_threads";

const BOOT = `
import { parentPort, workerData } from "node:worker_threads";
const names = "fetch XMLHttpRequest WebSocket EventSource Worker importScripts indexedDB caches navigator";
for (const name of names.split(" ")) globalThis[name] ??= {};
globalThis.postMessage = (message) => {
  parentPort.postMessage({ ...message, reach: names.split(" ").filter((name) => name in globalThis) });
};
globalThis.addEventListener = (type, listener) => parentPort.once(type, (data) => listener({ data }));
await import(workerData);
`;

class Worker {
  static reach = ["all"];

  constructor(url) {
    this.thread = new Thread(new URL(`data:text/javascript,${encodeURIComponent(BOOT)}`), { workerData: url.href });
    this.thread.on("message", ({ reach, ...data }) => {
      Worker.reach = reach; // what the program's thread still has
      this.onmessage({ data });
    });
    this.thread.on("error", (error) => this.onerror(error));
  }

  postMessage(message) {
    this.thread.postMessage(message);
  }

  terminate() {
    this.thread.terminate();
  }
}

async function fetch(url) {
  return new Response(await readFile(url));
}

Object.assign(globalThis, { Worker, fetch });
const { PythonEngine } = await import("#www/python/engine.js");
const SENSES = { pose: [0, 0, 0], line: [0.5, 0.5, 0.5], wheels: [0, 0] };

// Runs a text until its end, or until the condition says that it is enough. Waits take no time.
// Returns { prints, curves, motions, variables, sentence, line, answers, count, longest }: why it has ended, "" at its
// end; how often the page had its turn; the number of events, and of the characters of the longest text
export async function runText(text, { enough = () => false, slow = false, robot = "/" } = {}) {
  const engine = new PythonEngine(text, robot);
  const found = { prints: [], curves: [], motions: [], sentence: "", line: null, answers: 0, count: 0, longest: 0 };
  let seconds = 0;
  const state = () => {
    found.answers += 1;
    return { seconds, senses: SENSES, slow };
  };
  try {
    await engine.prepare();
    for await (const { print, name, value, publish, wait } of engine.run(state)) {
      if (print !== undefined) found.prints.push(print);
      if (name !== undefined) found.curves.push([name, value]);
      if (publish) found.motions.push(engine.motion);
      seconds += wait ?? 0;
      found.count += 1;
      found.longest = Math.max(found.longest, (print ?? name ?? "").length);
      if (enough(found)) break;
    }
  } catch (error) {
    if (error.constructor.name !== "ProgramError") throw error;
    Object.assign(found, { sentence: error.message, line: error.place });
  } finally {
    engine.end();
  }
  return { ...found, variables: engine.variables, reach: Worker.reach };
}
