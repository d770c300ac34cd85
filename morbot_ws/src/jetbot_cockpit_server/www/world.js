// What the cockpit has sent: who this page is, which robots there are, and how each one is.

import { prepareShapes } from "./scene.js";

const TRAIL_STEP = 0.03; // m between two points, as in trail.py
const TRAIL_LENGTH = 500; // points

const UNKNOWN = {
  status: "", warning: false, answers: true, stopped: false,
  pose: null, speed: null, command: null, wheels: null, driver: null, program: "", task: null,
};

export class World {
  constructor() {
    this.me = { id: null, name: "", role: "pupil", robot: null };
    this.robots = []; // in the order of the cockpit
    this.missing = new Map(); // robots that have gone, by id
    this.listed = false; // whether the robots are known
    this.states = {};
    this.trails = new Map();
    this.scenes = new Map(); // shapes, by the robot around which they are
    this.scores = [];
    this.emergency = false;
  }

  get teacher() {
    return this.me.role === "teacher";
  }

  hello(message) {
    this.me = message;
    this.missing = new Map();
    this.listed = false;
    this.trails.clear();
    this.scenes.clear();
    this.scores = [];
  }

  // Takes the list of robots; returns which have come and gone since the last one, in a sentence, or "".
  list(message) {
    const [before, now] = [this.robots, message.robots].map((robots) => new Map(robots.map((each) => [each.id, each])));
    const gone = this.listed ? this.robots.filter(({ id }) => !now.has(id)) : [];
    const come = this.listed ? message.robots.filter(({ id }) => !before.has(id)) : [];
    for (const robot of gone) this.missing.set(robot.id, robot);
    for (const id of now.keys()) this.missing.delete(id);
    for (const kept of [this.trails, this.scenes]) {
      for (const id of kept.keys()) if (!now.has(id)) kept.delete(id);
    }
    this.robots = message.robots;
    this.listed = true;
    return [sentence(gone, "not running any more"), sentence(come, "running")].filter(Boolean).join(" ");
  }

  update(message) {
    this.emergency = message.emergency;
    this.states = message.robots;
    for (const [id, { pose }] of Object.entries(this.states)) if (pose) this.append(id, pose);
  }

  trail(message) {
    this.trails.set(message.robot, message.points);
  }

  // Takes what is drawn around a robot; returns whether its course is another one.
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

  robot(id) {
    return this.robots.find((robot) => robot.id === id);
  }

  state(id) {
    return this.states[id] ?? UNKNOWN;
  }

  // Whether this page's person drives the robot.
  isMine(id) {
    return this.state(id).driver?.id === this.me.id;
  }

  // Whether this page's person cannot drive the robot now.
  isBlocked(id) {
    const { answers, stopped, driver } = this.state(id);
    return this.emergency || stopped || !answers || Boolean(driver) && !this.isMine(id);
  }

  // The robots whose place is known, each with its state.
  placed() {
    return this.robots.map((robot) => ({ robot, state: this.state(robot.id) })).filter(({ state }) => state.pose);
  }

  append(id, [x, y]) {
    const points = this.trails.get(id) ?? [];
    const [lastX, lastY] = points[points.length - 1] ?? [Infinity, Infinity];
    if (Math.hypot(x - lastX, y - lastY) < TRAIL_STEP) return;
    points.push([x, y]);
    if (points.length > TRAIL_LENGTH) points.shift();
    this.trails.set(id, points);
  }
}

function sentence(robots, what) {
  if (!robots.length) return "";
  return robots.length === 1 ? `${robots[0].label} is ${what}.` : `${robots.length} robots are ${what}.`;
}

// Returns what a person needs to know about the robot now: a sentence, and how urgent it is.
export function summarize(world, id) {
  const { status, warning, answers, stopped } = world.state(id);
  const label = world.robot(id)?.label ?? "The robot";
  if (!answers) return { text: status || `${label} does not answer: look after its node.`, level: "warning" };
  if (world.emergency || stopped) return { text: status || "stopped: emergency stop", level: "stopped" };
  const level = warning ? "warning" : status.startsWith("stopped") ? "waiting" : "driving";
  return { text: status || "waiting for its status", level };
}

// Returns who drives the robot, or "" if nobody does.
export function nameDriver(world, id) {
  const { driver, program, status, answers } = world.state(id);
  if (driver) return world.isMine(id) ? "You drive it" : `${driver.name} drives it`;
  return answers && status.startsWith("driving") ? `${program || "A program"} drives` : "";
}

// Returns who drives the robot, and what this page's person can do.
export function describeDriver(world, id) {
  const name = nameDriver(world, id);
  if (world.isBlocked(id)) return name || "Nobody drives it";
  if (!name) return "Free to drive: drag the pad";
  return world.isMine(id) ? name : `${name}. Take the pad to drive.`;
}
