// A page's text runs here as in a browser: by engine.js, in worker.js; Node's workers play the browser's.

import "./quick_wasm.js";

import { readFileSync } from "node:fs";
import { Worker as Thread } from "node:worker_threads";

// What a worker of a browser has; if "computing" is "free", its clock hardly turns as it computes.
const BOOT = `
import { parentPort, workerData } from "node:worker_threads";
const names = "fetch XMLHttpRequest WebSocket EventSource Worker importScripts indexedDB caches navigator";
for (const name of names.split(" ")) globalThis[name] ??= {};
if (workerData.computing === "free") {
  let now = 0;
  performance.now = () => now += 1e-4;
}
globalThis.postMessage = (message) => {
  parentPort.postMessage({ ...message, reach: names.split(" ").filter((name) => name in globalThis) });
};
globalThis.addEventListener = (type, listener) => parentPort.once(type, (data) => listener({ data }));
await import(workerData.url);
`;
const SENSES = { here: { X: 0, Y: 0, HEADING: 0 }, pose: [1, 2, 0], line: [0.25, 0.5, 1], wheels: [0, 0] };
const LONGEST = 60000; // ms until a text is ended that does not end
const TURN = 1e-6; // s that the page's turn takes: no clock stands while a program waits for less

class Worker {
  static computing = "takes time";
  static newest = {}; // answer: what Python says of a failure, and what the program's thread still has

  constructor({ href: url }) {
    const workerData = { url, computing: Worker.computing };
    this.thread = new Thread(new URL(`data:text/javascript,${encodeURIComponent(BOOT)}`), { workerData });
    this.thread.on("message", (data) => this.onmessage({ data: Worker.newest = data }));
    this.thread.on("error", (error) => this.onerror(error));
  }

  postMessage(message) {
    this.thread.postMessage(message);
  }

  terminate() {
    this.thread.terminate();
  }
}

const fetch = async (url) => new Response(readFileSync(url));
Object.assign(globalThis, { Worker, fetch });
const { PythonEngine } = await import("#www/python/engine.js");

// Takes the events of an engine, while a clock goes on as they wait.
class Page {
  seconds = 0;
  curves = [];
  seen = []; // the variables, by their names, at each wait of a second or more
  trace = []; // prints and commands ([ms, x, z]) in their order
  answers = 0; // how often the page had its turn
  count = 0; // of the events
  longest = 0; // characters of a text

  constructor(engine, slow) {
    Object.assign(this, { engine, slow });
  }

  state() {
    this.answers += 1;
    return { seconds: this.seconds += TURN, senses: SENSES, slow: this.slow };
  }

  take({ print, name, value, publish, wait = 0 }) {
    if (print !== undefined) this.trace.push(print);
    if (name !== undefined) this.curves.push([name, value]);
    if (wait >= 1) this.seen.push(Object.fromEntries(this.engine.variables));
    if (publish) this.trace.push([Math.round(1000 * this.seconds), ...this.engine.motion]);
    this.seconds += wait;
    this.count += 1;
    this.longest = Math.max(this.longest, (print ?? name ?? "").length);
  }
}

// Runs a text until its end, for so many s of its clock, or until the condition says that it is enough: then it is cut.
// Returns what Page has, { prints, motions, variables }; why it has ended, "" at its end, and on which line; the
// problem: that as Python says it; what reaches beyond the program's thread
export async function runText(text, { enough = () => false, slow = false, robot = "/", duration = Infinity,
  computing = "takes time" } = {}) {
  const engine = new PythonEngine(text, robot);
  const page = new Page(engine, slow);
  const end = { error: "", line: null, cut: false };
  Worker.computing = computing;
  const bound = setTimeout(() => {
    engine.end();
    engine.hear({ broken: "it did not end" });
  }, LONGEST);
  try {
    await engine.prepare();
    for await (const event of engine.run(() => page.state())) {
      page.take(event);
      end.cut = page.seconds > duration || enough(page);
      if (end.cut) break;
    }
  } catch (error) {
    if (error.constructor.name !== "ProgramError") throw error;
    Object.assign(end, { error: error.message, line: error.place ?? null });
  } finally {
    clearTimeout(bound);
    engine.end();
  }
  const { answers, count, longest, curves, seen, trace } = page;
  const [prints, commands] = [false, true].map((are) => trace.filter((each) => Array.isArray(each) === are));
  const { problem = null, reach } = Worker.newest;
  return { ...end, answers, count, longest, curves, seen, trace, prints,
    motions: commands.map(([, ...motion]) => motion), variables: engine.variables, problem, reach };
}
