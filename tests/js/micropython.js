// Python as a page runs it, with a page that a test plays: its clock is turned by the program's waits.

import { readFileSync } from "node:fs";

import { FILES } from "#www/python/modules/list.js";
import { loadMicroPython } from "#www/vendor/micropython/micropython.mjs";

const MODULES = new URL("../../morbot_ws/src/jetbot_cockpit/www/python/modules/", import.meta.url);
const FULL_SPEED = 0.6; // m/s at x = 1, of the robot that is played here; z turns it by as many rad/s
const SENSES = { pose: [0, 0, 0], line: [1, 1, 1], wheels: [0, 0] };

// What a program sees as _page. per_look: s that pass as the program asks for the time; longest: s until it is cut
class Page {
  now = 0;
  lines = [];
  curves = [];
  drives = []; // [s, x, z]
  turns = []; // s
  command = [0, 0];

  constructor({ senses = {}, perLook = 0, longest = 20 }) {
    Object.assign(this, { known: { ...SENSES, ...senses }, perLook, longest });
  }

  get module() {
    return {
      turn: (seconds) => this.turn(seconds),
      seconds: () => this.pass(this.perLook),
      drive: (x, z) => this.drives.push([this.now, ...this.command = [x, z]]),
      show: (text) => this.lines.push(text),
      curve: (name, value) => this.curves.push([name, value]),
      senses: () => JSON.stringify(this.known),
    };
  }

  turn(seconds) {
    this.turns.push(seconds);
    this.pass(seconds);
    if (this.now > this.longest) throw new Error("cut");
  }

  pass(seconds) {
    const [[x, y, yaw], [forward, left]] = [this.known.pose ?? [0, 0, 0], this.command];
    const way = forward * FULL_SPEED * seconds;
    if (way || left) this.known.pose = [x + way * Math.cos(yaw), y + way * Math.sin(yaw), yaw + left * seconds];
    return this.now = Math.round(1e6 * (this.now + seconds)) / 1e6;
  }
}

// Runs a program; returns { lines, curves, drives, turns, now, error }: why it failed, or "".
export async function runPython(text, options = {}) {
  const page = new Page(options);
  const stdout = (line) => page.lines.push(line);
  const python = await loadMicroPython({ stdout, heapsize: 1 << 20, pystack: 1 << 16 });
  for (const file of FILES) write(python.FS, file);
  python.registerJsModule("_page", page.module);
  python.runPython("import _start\n_start.start()\ndel _start");
  page.error = errorOf(() => python.runPython(text));
  page.error ||= errorOf(() => python.runPython("__import__('sys').modules['_start'].finish()"));
  return page;
}

function write(files, file) {
  const [name, ...folders] = file.split("/").reverse();
  const folder = ["/lib", ...folders].join("/");
  if (!files.analyzePath(folder).exists) files.mkdirTree(folder);
  files.writeFile(`${folder}/${name}`, readFileSync(new URL(file, MODULES)));
}

function errorOf(run) {
  try {
    run();
    return "";
  } catch (error) {
    if (process.env.TRACE) console.log(error.message);
    return error.message.trim().split("\n").at(-1);
  }
}
