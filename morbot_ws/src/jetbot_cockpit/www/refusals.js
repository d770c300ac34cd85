// What the cockpit refuses, by the codes of notices.py: whether it is so now, as far as this page knows.

/** @import { World } from "./world.js" */
/** @typedef {(world: World, robot: string | null, drives: boolean) => boolean} IsSo drives: this page, its robot */

// What keeps this page's person from driving a robot, in the order in which the cockpit names it.
/** @type {Record<string, IsSo>} */
export const OBSTACLES = {
  taken: (world, robot) => world.isTaken(robot),
  driven: (world, robot) => Boolean(world.state(robot).driver) && !world.isMine(robot),
  all_stopped: (world) => world.emergency,
  no_answer: (world, robot) => !world.state(robot).answers,
  stopped: (world, robot) => world.state(robot).stopped,
};

/** @type {IsSo} */
const untilDriven = (_, __, drives) => !drives;

/** @type {Record<string, IsSo>} */
const OTHERS = {
  let_go: untilDriven, no_command: untilDriven, interrupted: untilDriven, put_back: untilDriven,
  ended: (world, robot) => !world.robot(robot),
  teacher_releases: (world) => world.mustWait,
  not_stopped: (world, robot) => !world.emergency && !world.state(robot).stopped,
  others_stopped: (world) => !world.emergency && world.robots.some(({ id }) => world.state(id).stopped),
  driver_collects: (world, robot) => !world.isMine(robot),
  judge_driven: OBSTACLES.driven,
  judged_elsewhere: (world, robot) => {
    const { task } = world.state(robot);
    return task !== null && task.state !== "done";
  },
};

// Returns whether this refusal holds now; most hold whatever the robots do.
/** @param {string} code @param {World} world @param {string | null} robot @param {boolean} drives */
export function holds(code, world, robot, drives) {
  const isSo = OBSTACLES[code] ?? OTHERS[code];
  return !isSo || isSo(world, robot, drives);
}

// Returns a function that returns whether this has been so, and is not any more: states come after refusals.
/** @param {() => boolean} isSo */
export function hasPassed(isSo) {
  let wasSo = isSo();
  return () => {
    const now = isSo();
    wasSo ||= now;
    return wasSo && !now;
  };
}
