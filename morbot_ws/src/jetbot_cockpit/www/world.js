// What the cockpit has sent: who this page is, which robots there are, and how each one is; and which one was chosen.

/** @import { Incoming, Robot, RobotState } from "./messages.js" */
/** @typedef {Omit<RobotState, "programs"> & { programs?: number }} State without programs: nothing is known yet */

import { forPupils } from "./causes.js";
import { prepareShapes } from "./drawing.js";
import { limits } from "./limits.js";
import { OBSTACLES } from "./refusals.js";

const STOPS = ["emergency_stop", "own_emergency_stop", "board", "guard"]; // causes: it has heard of a stop, or cannot
const ASK = "Tell your teacher.";
const TAKEN = "robot"; // what a teacher holds, not its programs alone

/** @type {State} */
const UNKNOWN = {
  status: "", state: "", cause: "", holds: [], waiting: [], fake: false, warning: false, answers: true, stopped: false,
  pose: null, speed: null, command: null, wheels: null, program: "",
  driver: null, resumes: null, held: null, stalls: 0, task: null, pictures: null,
};

export class World {
  /** @type {{ id: number | null, name: string, role: string, robot: string | null, codes?: boolean }} */
  me = { id: null, name: "", role: "pupil", robot: null };
  /** @type {any} */
  chosen = null; // id of the robot that this page shows and drives, null for none
  /** @type {Robot[]} */
  robots = []; // in the order of the cockpit
  /** @type {Robot[]} */
  missing = []; // those that have gone
  listed = false; // whether their list has come
  /** @type {Record<string, State>} */
  states = {};
  trails = new Map();
  starts = new Map(); // [x, y, yaw] of each trail's beginning
  scenes = new Map(); // shapes, by the robot around which they are
  emergency = false;
  pupilsRelease = false; // whether a pupil may end that stop

  get teacher() {
    return this.me.role === "teacher";
  }

  // The robots from which this person may choose: a pupil who belongs to a robot drives that one only.
  get allowed() {
    const own = this.me.robot;
    return own ? this.robots.filter(({ id }) => id === own) : this.robots;
  }

  // The robots whose place is known, each with its state.
  /** @returns {{ robot: Robot, state: any }[]} */
  get placed() {
    return this.robots.map((robot) => ({ robot, state: this.state(robot.id) })).filter(({ state }) => state.pose);
  }

  // A connection begins: everything is sent again.
  /** @param {Extract<Incoming, { type: "hello" }>} message */
  hello(message) {
    this.me = message;
    Object.assign(limits, message.limits);
    Object.assign(this, { listed: false, robots: [], missing: [] });
    Object.assign(this, { trails: new Map(), starts: new Map(), scenes: new Map() });
  }

  // Takes the list of robots; returns which have come and gone since the last one, in a sentence, or "".
  /** @param {{ robots: Robot[] }} message */
  list({ robots }) {
    const isNew = ({ id }) => !this.robot(id);
    const isGone = ({ id }) => !robots.some((robot) => robot.id === id);
    const come = this.robots.length ? robots.filter(isNew) : [];
    const gone = this.robots.filter(isGone);
    for (const { id } of gone) {
      this.trails.delete(id);
      this.starts.delete(id);
      this.scenes.delete(id);
    }
    this.missing = [...this.missing, ...gone].filter(isGone);
    Object.assign(this, { robots, listed: true });
    return [sentence(gone, "not running any more"), sentence(come, "running")].filter(Boolean).join(" ");
  }

  /** @param {Extract<Incoming, { type: "state" }>} message */
  update({ emergency, pupils_release: pupilsRelease, robots }) {
    Object.assign(this, { emergency, pupilsRelease });
    this.states = robots;
    for (const [id, { pose }] of Object.entries(robots)) if (pose) this.append(id, pose);
  }

  /** @param {Extract<Incoming, { type: "trail" }>} message */
  trail({ robot, start, points }) {
    this.trails.set(robot, points);
    this.starts.set(robot, start);
  }

  append(id, /** @type {number[]} */ pose) {
    const [x, y] = pose;
    if (!this.starts.get(id)) this.starts.set(id, pose);
    const points = this.trails.get(id) ?? [];
    const [lastX, lastY] = points[points.length - 1] ?? [Infinity, Infinity];
    if (Math.hypot(x - lastX, y - lastY) < limits.trail_step) return;
    points.push([x, y]);
    if (points.length > limits.trail) points.shift();
    this.trails.set(id, points);
  }

  // Takes what is drawn around a robot; returns whether its course is another one.
  /** @param {Extract<Incoming, { type: "scene" }>} message */
  scene({ robot, shapes }) {
    const before = String(this.courseOf(robot));
    this.scenes.set(robot, prepareShapes(shapes));
    return String(this.courseOf(robot)) !== before;
  }

  // The points of what is drawn around a robot.
  pointsOf(id, isWanted = () => true) {
    return (this.scenes.get(id) ?? []).filter(isWanted).flatMap(({ points }) => points);
  }

  courseOf(id) {
    return this.pointsOf(id, ({ kind }) => kind === "course" || kind === "goal");
  }

  // Where the robot is, as place.js takes it.
  placeOf(id) {
    const [goal] = this.pointsOf(id, ({ kind }) => kind === "goal");
    const others = this.placed.filter(({ robot }) => robot.id !== id).length;
    return { pose: this.state(id).pose, start: this.starts.get(id), goal, others };
  }

  // Whether the robot's course is gone, or it drives on after its task.
  isTaskOver(id) {
    const { task, state } = this.state(id);
    return !this.courseOf(id).length || (task?.state === "done" && state === "driving");
  }

  // What the names of all robots begin with if only numbers follow, as in a class, else "".
  get commonName() {
    const [first, ...others] = this.robots.map(({ label }) => label.match(/^(.*?)\d+$/)?.[1]);
    return others.length && others.every((other) => other === first) ? first ?? "" : "";
  }

  /** @param {string | null} id */
  robot(id) {
    return this.robots.find((robot) => robot.id === id);
  }

  /** @param {string | null} id */
  state(id) {
    return this.states[id ?? ""] ?? UNKNOWN;
  }

  // Whether this page's person cannot end the stop that holds all robots, or the chosen one.
  get mustWait() {
    const { emergency, pupilsRelease } = this;
    return !this.teacher && (emergency ? !pupilsRelease : this.state(this.chosen).stopped);
  }

  // Whether this page's person drives the robot.
  isMine(id) {
    return this.state(id).driver?.id === this.me.id;
  }

  // Whether a teacher has taken the robot from this page's person.
  isTaken(id) {
    return !this.teacher && this.state(id).held === TAKEN;
  }

  // Returns what keeps this page's person from driving the robot now, as a code of notices.py, or "".
  obstacle(id) {
    return Object.keys(OBSTACLES).find((code) => OBSTACLES[code](this, id, false)) ?? "";
  }

  isBlocked(id) {
    return Boolean(this.obstacle(id));
  }

  // Whether there is somebody from whom a teacher can take the robot, also a program that pauses.
  mayTake(id) {
    const { driver, held, program, resumes } = this.state(id);
    if (driver) return !this.isMine(id);
    return held !== TAKEN && Boolean(program || resumes || this.nameDriver(id));
  }

  // Returns what a person needs to know about the robot now: a sentence, and how urgent it is.
  summarize(id) {
    const { state, cause, warning, answers, stopped } = this.state(id);
    const status = this.teacher ? this.state(id).status : forPupils(this.state(id));
    const label = this.robot(id)?.label ?? "The robot";
    if (!answers) return { text: this.teacher ? status : `${label} does not answer. ${ASK}`, level: "warning" };
    if (this.emergency && this.mustWait) return { text: "Your teacher stopped all robots.", level: "stopped" };
    if (this.emergency || stopped) {
      return { text: STOPS.includes(cause) ? status : "stopped: emergency stop", level: "stopped" };
    }
    if (this.isTaken(id)) {
      return { text: `Your teacher has taken ${label}. Wait until a teacher presses Go on.`, level: "stopped" };
    }
    const level = warning ? "warning" : state === "driving" ? "driving" : "waiting";
    return { text: status || "waiting for its status", level };
  }

  // Returns that there is no robot that this page's person may drive: a sentence.
  describeAbsence(is = "is") {
    const own = this.me.robot ?? this.chosen;
    return own ? `${own.slice(1) || "The robot"} ${is} not running.` : `No robot ${is} running.`;
  }

  // Returns the same of the chosen robot, which may not run.
  get status() {
    if (this.robot(this.chosen)) return this.summarize(this.chosen);
    const text = this.listed ? `${this.describeAbsence()} This page shows it as soon as it runs.` : "Connecting";
    return { text, level: "waiting" };
  }

  // Returns who drives the robot, or "" if nobody does.
  nameDriver(id) {
    const { driver, program, state, answers } = this.state(id);
    if (driver) return this.isMine(id) ? "You drive it" : `${driver.name} drives it`;
    return answers && state === "driving" ? `${program || "A program"} drives` : "";
  }

  // Returns what waits until a teacher presses Go on, or "".
  nameWaiting(id) {
    const { held, waiting } = this.state(id);
    if (held === TAKEN) return "Pupils and programs wait";
    return held && waiting.length ? "The program waits" : "";
  }

  // Returns who drives the robot or will do so by itself, and what this page's person can do.
  describeDriver(id) {
    const [{ resumes }, waiting] = [this.state(id), this.nameWaiting(id)];
    if (waiting) return `${waiting} until a teacher presses Go on`;
    if (resumes) return `The program drives on in ${resumes} s`;
    const name = this.nameDriver(id);
    if (this.isBlocked(id)) return name || "Nobody drives it";
    if (!name) return "Free to drive: drag the pad";
    return this.isMine(id) ? name : `${name}. Take the pad to drive.`;
  }
}

// Returns what a robot is called, with the name of its pupil.
/** @param {{ label: string, pupil?: string }} robot */
export function titleOf({ label, pupil }) {
  return pupil ? `${label}, ${pupil}` : label;
}

function sentence(robots, what) {
  if (!robots.length) return "";
  return robots.length === 1 ? `${robots[0].label} is ${what}.` : `${robots.length} robots are ${what}.`;
}
