// Runs a Python program behind a Run: in a worker, with MicroPython. It knows no page.

import { pythonLanguage } from "../vendor/codemirror/codemirror.js";
import { t } from "../language.js";
import { ProgramError } from "../program/program_error.js";
import { checked } from "./answers.js";
import { lineOf, mark } from "./marks.js";
import { explain } from "./mistakes.js";
import { FILES } from "./modules/list.js";
import { syntaxProblem } from "./syntax.js";

const LOOKS = /["'][\w/]*\bline["']/; // at the line sensor
const BROKEN = t("Python stopped unexpectedly. Run the program again.");
const NOT_LOADED = t("Python could not be loaded. Try again. If that does not help, reload the page.");

/** @type {Promise<object> | null} */
let loaded = load(); // promises what a worker needs: a text that is shown will soon run
loaded.catch(() => {});

export class PythonEngine {
  repeats = false; // the robot gets a command when the program publishes one
  motion = [0, 0]; // x, z: in the units of the robot's commands
  variables = new Map(); // texts by names
  /** @type {((message: any) => void) | null} */
  heard = null; // takes the worker's answer
  ended = false;

  /** @type {any} */
  worker = null;
  /** @type {any} */
  tree = null; // of the text

  /** @param {string} text of the program @param {string} robot its namespace, "/" or "/jetbot_01" */
  constructor(text, robot = "/") {
    this.text = text;
    this.robot = robot;
    this.needs = { senses: true, eyes: LOOKS.test(text) };
  }

  // Loads Python, and reads the program. Throws a ProgramError if it is none.
  async prepare() {
    const problem = syntaxProblem(this.text);
    if (problem) this.fail(problem);
    this.tree = pythonLanguage.parser.parse(this.text);
    loaded ??= load();
    const needed = await loaded.catch(fail);
    if (this.ended) return;
    this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = this.worker.onmessageerror = () => this.hear({ broken: "the worker failed" });
    await this.ask({ ...needed, program: mark(this.text, this.tree), robot: this.robot });
  }

  // Yields the program's events, as Interpreter does. state(): { seconds, senses, slow } as worker.js explains them
  async *run(state) {
    for (;;) {
      const { events, variables, over, problem } = await this.ask(state());
      if (variables) this.variables = variables;
      for (const event of events) yield this.toEvent(event);
      if (problem) {
        const line = lineOf(this.text, this.tree, problem);
        this.fail(explain({ ...problem, line }, this.text));
      }
      if (over) return;
    }
  }

  fail({ text, line }) {
    throw new ProgramError(text, line);
  }

  toEvent(event) {
    if (!event.motion) return event;
    this.motion = event.motion;
    return { publish: true };
  }

  // Returns the worker's answer to this.
  async ask(message) {
    const answer = checked(await new Promise((resolve) => {
      if (this.ended) return resolve({ broken: "the worker has ended" });
      this.heard = resolve;
      this.worker.postMessage(message);
    }));
    if (answer.broken) console.error(answer.broken);
    if (answer.broken) throw new ProgramError(BROKEN);
    return answer;
  }

  // Takes the worker's answer. What comes unasked ends it: a program's worker only answers.
  hear(message) {
    if (!this.heard) this.end();
    this.heard?.(message);
    this.heard = null;
  }

  // Ends the program, whatever it does.
  end() {
    this.ended = true;
    this.worker?.terminate();
  }
}

async function load() {
  const [wasm, ...texts] = await Promise.all([
    get("../vendor/micropython/micropython.wasm").then((answer) => answer.arrayBuffer()),
    ...FILES.map((name) => get(`modules/${name}`).then((answer) => answer.text())),
  ]);
  return { wasm, files: Object.fromEntries(FILES.map((name, index) => [name, texts[index]])) };
}

async function get(name) {
  const answer = await fetch(new URL(name, import.meta.url));
  if (!answer.ok) throw new TypeError(`${name}: ${answer.status}`);
  return answer;
}

function fail() {
  loaded = null; // is tried again
  throw new ProgramError(NOT_LOADED);
}
