// Runs a Python program behind a Run: in a worker, with MicroPython. It knows no page.

import { pythonLanguage } from "../vendor/codemirror/codemirror.js";
import { t } from "../language.js";
import { ProgramError } from "../program/program_error.js";
import { checked } from "./answers.js";
import { mark } from "./marks.js";
import { explain } from "./mistakes.js";
import { FILES } from "./modules/list.js";
import { syntaxProblem } from "./syntax.js";

const LOOKS = /["'][\w/]*\bline["']/; // at the line sensor
const BROKEN = t("Python broke off. Run the program again.");
const NOT_LOADED = t("Python could not be loaded. Try again. If that does not help, reload the page.");

let loaded = null; // promises what a worker needs

export class PythonEngine {
  repeats = false; // the robot gets a command when the program publishes one
  motion = [0, 0]; // x, z: in the units of the robot's commands
  variables = new Map(); // texts by names
  /** @type {((message: any) => void) | null} */
  heard = null; // takes the worker's answer
  ended = false;

  /** @type {any} */
  worker = null;

  /** @param {string} text of the program @param {string} robot its namespace, "/" or "/jetbot_01" */
  constructor(text, robot = "/") {
    Object.assign(this, { text, robot });
    this.needs = { senses: true, eyes: LOOKS.test(text) };
  }

  // Loads Python, and reads the program. Throws a ProgramError if it is none.
  async prepare() {
    const problem = syntaxProblem(this.text);
    if (problem) this.fail(problem);
    const program = mark(this.text, pythonLanguage.parser.parse(this.text));
    loaded ??= load();
    this.given = { ...await loaded.catch(fail), program, robot: this.robot };
    if (this.ended) return;
    this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = this.worker.onmessageerror = () => this.hear({ broken: "the worker failed" });
  }

  // Yields the program's events, as Interpreter does. state(): { seconds, senses, slow } as worker.js explains them
  async *run(state) {
    for (let answer = { ...this.given, ...state() }; ; answer = state()) {
      const { events, variables, over, problem, broken } = checked(await this.ask(answer));
      if (variables) this.variables = variables;
      for (const event of events) yield this.toEvent(event);
      if (broken) console.error(broken);
      if (broken) throw new ProgramError(BROKEN);
      if (problem) this.fail(explain(problem, this.text));
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

  ask(answer) {
    return new Promise((resolve) => {
      if (this.ended) return resolve({ broken: "the worker has ended" });
      this.heard = resolve;
      this.worker.postMessage(answer);
    });
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
