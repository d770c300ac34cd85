// Python as a page runs it, with a page that a test plays: its clock is turned by the program's waits.

import "./quick_wasm.js";

import { readFileSync } from "node:fs";

import { mark } from "#www/python/marks.js";
import { FILES } from "#www/python/modules/list.js";
import { pythonLanguage } from "#www/vendor/codemirror/codemirror.js";
import { loadMicroPython } from "#www/vendor/micropython/micropython.mjs";

const MODULES = new URL("../../morbot_ws/src/jetbot_cockpit/www/python/modules/", import.meta.url);
const FULL_SPEED = 0.6; // m/s at x = 1, of the robot that is played here; z turns it by as many rad/s
const SENSES = { pose: [0, 0, 0], line: [1, 1, 1], wheels: [0, 0] };
const CUT = "cut";
const IT_DOES_NOT = { type: "", message: "it does not fail", line: 0 };

// Runs a text, and returns how it fails
const FAIL = `
import io, json, sys

def each(line, values):
    for value in values:
        yield value

def fail(text):
    try:
        exec(compile(text, "program.py", "exec"), {"__name__": "__main__", "_at": lambda *_, **__: None, "_each": each})
    except BaseException as problem:
        trace = io.StringIO()
        sys.print_exception(problem, trace)
        return json.dumps([type(problem).__name__, str(problem), trace.getvalue()])
`;

// What a program sees as _page. perLook: s that pass as the program asks for the time; perLine: s for each statement;
// longest: s until it is cut; more: other things of _page
class Page {
  now = 0;
  lines = [];
  curves = [];
  drives = []; // [s, x, z]
  turns = []; // s
  command = [0, 0];
  error = ""; // why the program has failed

  constructor(text, { senses = {}, perLook = 1e-5, perLine = 0, longest = 20, more = {} }) {
    Object.assign(this, { text, known: { ...SENSES, ...senses }, perLook, perLine, longest, more });
  }

  get module() {
    return {
      namespace: () => "/",
      program: () => mark(this.text, pythonLanguage.parser.parse(this.text)),
      at: () => this.pass(this.perLine) && null,
      turn: (seconds) => this.turn(seconds),
      seconds: () => this.pass(this.perLook),
      drive: (x, z) => this.drives.push([this.now, ...this.command = [x, z]]),
      show: (text) => this.lines.push(text),
      digits: (number) => number.toExponential(),
      upper: (text) => text.toUpperCase(),
      lower: (text) => text.toLowerCase(),
      curve: (name, value) => this.curves.push([name, value]),
      senses: () => JSON.stringify(this.known),
      fail: (type, message) => {
        this.error ||= `${type}: ${message}`;
      },
      ...this.more,
    };
  }

  turn(seconds) {
    this.turns.push(seconds);
    this.pass(seconds);
  }

  pass(seconds) {
    const [[x, y, yaw], [forward, left]] = [this.known.pose ?? [0, 0, 0], this.command];
    const way = forward * FULL_SPEED * seconds;
    if (way || left) this.known.pose = [x + way * Math.cos(yaw), y + way * Math.sin(yaw), yaw + left * seconds];
    this.now = Math.round(1e6 * (this.now + seconds)) / 1e6;
    if (this.now > this.longest) throw new Error(CUT);
    return this.now + 1e-9; // a whole number would be an int
  }
}

// Runs a program; returns a Page.
export async function runPython(text, options = {}) {
  const page = new Page(text, options);
  const stdout = (line) => page.lines.push(line);
  const python = await loadMicroPython({ stdout, heapsize: 1 << 20, pystack: 1 << 16 });
  for (const file of FILES) write(python.FS, file);
  python.registerJsModule("_page", page.module);
  try {
    python.runPython("import _run\n_run.run()");
  } catch (error) {
    page.error = error.message;
  }
  return page;
}

// Returns how a program fails, as explain() takes it.
export async function failureInPage(text) {
  let failure = IT_DOES_NOT;
  await runPython(text, { more: { fail: (...said) => { failure = toFailure(...said); } } });
  return failure;
}

const python = await loadMicroPython({ pystack: 1 << 16, stdout: () => {} });
python.runPython(FAIL);
const fail = python.globals.get("fail");

// The same without the page's modules, and quickly.
export function failureOf(text) {
  const answer = fail(mark(text, pythonLanguage.parser.parse(text)));
  return answer ? toFailure(...JSON.parse(answer)) : IT_DOES_NOT;
}

function toFailure(type, message, trace) {
  return { type, message, line: Number([...trace.matchAll(/"program\.py", line (\d+)/g)].at(-1)?.[1] ?? 0) };
}

function write(files, file) {
  const path = `/lib/${file}`;
  files.mkdirTree(path.replace(/\/[^/]*$/, ""));
  files.writeFile(path, readFileSync(new URL(file, MODULES)));
}
