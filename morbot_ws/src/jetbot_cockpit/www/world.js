// What the cockpit has sent: who this page is, which robots there are, and how each one is; and which one was chosen.

/** @import { Incoming, Robot, RobotState } from "./messages.js" */
/** @typedef {Omit<RobotState, "programs"> & { programs?: number }} State without programs: nothing is known yet */

import { summarize } from "./causes.js";
import { t } from "./language.js";
import { limits } from "./limits.js";
import { OBSTACLES } from "./refusals.js";

const SHAPES = ["wall", "line", "course", "goal"]; // that the map draws
const TAKEN = "robot"; // what a teacher holds, not its programs alone
const ALL_WAIT = {
  now: t("Pupils and programs wait"), until: t("Pupils and programs wait until a teacher presses Go on"),
};
const PROGRAM_WAITS = { now: t("The program waits"), until: t("The program waits until a teacher presses Go on") };
const ABSENT = {
  is: (robot) => (robot ? t("{robot} is not running.", { robot }) : t("No robot is running.")),
  was: (robot) => (robot ? t("{robot} was not running.", { robot }) : t("No robot was running.")),
};

/** @type {State} */
const UNKNOWN = {
  status: "", state: "", cause: "", template: "", arguments: {}, remarks: null, health: null, holds: [], waiting: [],
  fake: false, warning: false, answers: true, stopped: false, pose: null, speed: null, command: null, wheels: null,
  program: "", driver: null, resumes: null, held: null, stalls: 0, task: null, pictures: null, link: null,
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
  /** @type {string[]} */
  unconfirmed = []; // ids of robots that have not confirmed that stop
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
    return [describeGone(gone), describeCome(come)].filter(Boolean).join(" ");
  }

  /** @param {Extract<Incoming, { type: "state" }>} message */
  update({ emergency, unconfirmed = [], pupils_release: pupilsRelease, robots }) {
    Object.assign(this, { emergency, unconfirmed, pupilsRelease });
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
    this.scenes.set(robot, shapes.filter(({ kind }) => SHAPES.includes(kind)));
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

  // Whether the robot has a computer and a page of its own, and is out of reach.
  isAway(id) {
    return Boolean(this.robot(id)?.address) && !this.state(id).answers;
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
    return summarize(this, id);
  }

  // Returns that there is no robot that this page's person may drive: a sentence.
  /** @param {"is" | "was"} tense */
  describeAbsence(tense = "is") {
    const own = this.me.robot ?? this.chosen;
    return ABSENT[tense](own && (own.slice(1) || t("The robot")));
  }

  // Returns the same of the chosen robot, which may not run.
  get status() {
    if (this.robot(this.chosen)) return this.summarize(this.chosen);
    const text = `${this.describeAbsence()} ${t("This page shows it as soon as it runs.")}`;
    return { text: this.listed ? text : t("Connecting"), level: "waiting" };
  }

  // Returns who drives the robot, or "" if nobody does.
  nameDriver(id) {
    const { driver, program, state, answers } = this.state(id);
    if (driver) return this.isMine(id) ? t("You drive it") : t("{name} drives it", { name: calledOf(driver) });
    return answers && state === "driving" ? t("{program} drives", { program: program || t("A program") }) : "";
  }

  // Returns what waits until a teacher presses Go on, or "".
  nameWaiting(id) {
    return this.waits(id)?.now ?? "";
  }

  waits(id) {
    const { held, waiting } = this.state(id);
    if (held === TAKEN) return ALL_WAIT;
    return held && waiting.length ? PROGRAM_WAITS : undefined;
  }

  // Returns who drives the robot or will do so by itself, and what this page's person can do.
  describeDriver(id) {
    const [{ resumes }, waits] = [this.state(id), this.waits(id)];
    if (waits) return waits.until;
    if (resumes) return t("The program drives on in {seconds} s", { seconds: resumes });
    const driver = this.nameDriver(id);
    if (this.isBlocked(id)) return driver || t("Nobody drives it");
    if (!driver) return t("Free to drive: drag the pad");
    return this.isMine(id) ? driver : t("{driver}. Take the pad to drive.", { driver });
  }
}

// Returns what a driver is called, as a value of a sentence: who has typed no name has one that is translated.
/** @param {import("./messages.js").Driver | null} driver */
export function calledOf(driver) {
  return driver?.said ?? driver?.name ?? "";
}

// Returns what a robot is called, with the name of its pupil.
/** @param {{ label: string, pupil?: string }} robot */
export function titleOf({ label, pupil }) {
  return pupil ? `${label}, ${pupil}` : label;
}

/** @param {Robot[]} robots */
function describeGone(robots) {
  const [robot, count] = [robots[0]?.label, robots.length];
  if (count > 1) return t("{count} robots are not running any more.", { count });
  return count ? t("{robot} is not running any more.", { robot }) : "";
}

/** @param {Robot[]} robots */
function describeCome(robots) {
  const [robot, count] = [robots[0]?.label, robots.length];
  if (count > 1) return t("{count} robots are running.", { count });
  return count ? t("{robot} is running.", { robot }) : "";
}
