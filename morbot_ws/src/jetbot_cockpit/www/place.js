// Where a robot is and where it is steered, for those who do not see it. Its place is seen from its start, ahead and to
// the left as it faced there.

import { t } from "./language.js";

// counterclockwise, an eighth of a turn each
const HEADINGS = [
  t("It faces ahead."), t("It faces ahead and left."), t("It faces left."), t("It faces back and left."),
  t("It faces back."), t("It faces back and right."), t("It faces right."), t("It faces ahead and right."),
];
const STEERING = [
  t("You steer ahead."), t("You steer ahead and left."), t("You steer left."), t("You steer back and left."),
  t("You steer back."), t("You steer back and right."), t("You steer right."), t("You steer ahead and right."),
];
const PLACES = { // by the signs of the ways ahead and to the left
  "0,0": () => t("The robot is at its start."),
  "1,0": (ways) => t("The robot is {ahead} m ahead of its start.", ways),
  "-1,0": (ways) => t("The robot is {ahead} m behind its start.", ways),
  "0,1": (ways) => t("The robot is {left} m to the left of its start.", ways),
  "0,-1": (ways) => t("The robot is {left} m to the right of its start.", ways),
  "1,1": (ways) => t("The robot is {ahead} m ahead of its start and {left} m to the left.", ways),
  "1,-1": (ways) => t("The robot is {ahead} m ahead of its start and {left} m to the right.", ways),
  "-1,1": (ways) => t("The robot is {ahead} m behind its start and {left} m to the left.", ways),
  "-1,-1": (ways) => t("The robot is {ahead} m behind its start and {left} m to the right.", ways),
};
const EIGHTH = Math.PI / 4; // rad

// Returns whole sentences. pose, start: x, y in m and heading in rad on the map, or null; goal: a point there, if the
// robot's task has one; others: how many other robots are on the map.
/** @param {{ pose: number[] | null, start?: number[] | null, goal?: number[], others: number }} place */
export function describePlace({ pose, start, goal, others }) {
  if (!pose || !start) return t("The robot's place is not known.");
  return [
    describeWay(pose, start),
    HEADINGS[eighth(pose[2] - start[2])],
    goal && t("The goal is {distance} m away.", { distance: metres(Math.hypot(goal[0] - pose[0], goal[1] - pose[1])) }),
    others && t("{count} other robot is on the map.|{count} other robots are on the map.", { count: others }),
  ].filter(Boolean).join(" ");
}

function describeWay(/** @type {number[]} */ [x, y], /** @type {number[]} */ [startX, startY, yaw]) {
  const [east, north] = [x - startX, y - startY];
  const [ahead, left] = [
    east * Math.cos(yaw) + north * Math.sin(yaw), north * Math.cos(yaw) - east * Math.sin(yaw),
  ].map((way) => Math.round(10 * way) / 10);
  return PLACES[String([ahead, left].map(Math.sign))]({ ahead: metres(ahead), left: metres(left) });
}

// Returns where the pad is, in a sentence, or "" if it is released.
export function describeSteering(/** @type {number[]} */ [forward, left]) {
  return forward || left ? STEERING[eighth(Math.atan2(left, forward))] : "";
}

function eighth(angle) {
  return (Math.round(angle / EIGHTH) % 8 + 8) % 8;
}

function metres(way) {
  return Math.abs(way).toFixed(1);
}
