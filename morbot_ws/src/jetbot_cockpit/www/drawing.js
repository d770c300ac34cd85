// Draws the map: the grid in pixels; robots, trails, arrows and what is around a robot in metres, x ahead, y to the
// left. pixel: size of a pixel in metres.

import { number } from "./language.js";
import { limits } from "./limits.js";

const MIN_CELL = 48; // pixels
export const SCALE_HEIGHT = 26; // pixels, above the legend

// Like the simulation's model: the origin is the middle of the axle.
const BODY = [-0.095, -0.0475, 0.13, 0.095];
const WHEEL = { length: 0.06, width: 0.012 };
const CAMERA = [0.028, -0.013, 0.012, 0.026];
const NOSE = 0.06; // where the arrows start
const ARROW_TIME = 0.8; // s that an arrow looks ahead
const ARROW_STEPS = 24;

const GOAL_RADIUS = [0.04, 7]; // in metres and in pixels: the larger one
const FAINT = 0.3; // opacity of what belongs to another robot
const STYLES = { // color: its name in the page's style; thinnest: width in pixels; opacity: of the chosen robot's
  wall: { color: "tyre", thinnest: 3, opacity: 1 },
  line: { color: "muted", thinnest: 2, opacity: 1 },
  course: { color: "course", thinnest: 7, opacity: 0.7 },
  goal: { color: "course", thinnest: 2.5, opacity: 1 },
};

// Draws a grid in metres, with a scale.
export function drawGrid(context, viewport, colors) {
  const cell = cellSize(viewport.scale);
  const [left, top] = viewport.toMetres(0, 0);
  const [right, bottom] = viewport.toMetres(viewport.width, viewport.height);
  context.lineWidth = 1;
  for (let n = Math.ceil(left / cell); n * cell <= right; n += 1) {
    const across = Math.round(viewport.toPixels(n * cell, 0)[0]) + 0.5;
    drawLine(context, [[across, 0], [across, viewport.height]], n === 0 ? colors.axis : colors.grid);
  }
  for (let n = Math.ceil(bottom / cell); n * cell <= top; n += 1) {
    const down = Math.round(viewport.toPixels(0, n * cell)[1]) + 0.5;
    drawLine(context, [[0, down], [viewport.width, down]], n === 0 ? colors.axis : colors.grid);
  }
  drawScale(context, viewport, cell, colors);
}

// Returns the smallest of 0.1, 0.2, 0.5, 1, 2, 5 ... m that is wide enough to see.
function cellSize(scale) {
  for (let power = 0.1; ; power *= 10) {
    for (const size of [power, 2 * power, 5 * power]) if (size * scale >= MIN_CELL) return size;
  }
}

function drawScale(context, viewport, cell, colors) {
  const [left, length] = [14.5, Math.round(cell * viewport.scale)];
  const down = Math.round(viewport.height - viewport.covered.below) + SCALE_HEIGHT - 9.5;
  const [font, textAlign] = ["11px system-ui, sans-serif", "center"];
  Object.assign(context, { lineWidth: 1.5, fillStyle: colors.text, font, textAlign });
  const corners = [[left, down - 5], [left, down], [left + length, down], [left + length, down - 5]];
  drawLine(context, corners, colors.text);
  context.fillText(`${number(Number(cell.toPrecision(1)))} m`, left + length / 2, down - 5);
}

function drawLine(context, points, color) {
  context.strokeStyle = color;
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.stroke();
}

export function drawTrail(context, points, color, pixel) {
  Object.assign(context, { lineWidth: 2 * pixel, lineJoin: "round" });
  drawLine(context, points, color);
}

// Draws the robot at [x, y, yaw].
export function drawRobot(context, pose, color, colors, pixel) {
  atPose(context, pose, () => {
    context.fillStyle = colors.tyre;
    for (const side of [1, -1]) {
      const across = side * limits.wheel_separation / 2 - WHEEL.width / 2;
      context.fillRect(-WHEEL.length / 2, across, WHEEL.length, WHEEL.width);
    }
    Object.assign(context, { fillStyle: color, strokeStyle: colors.ground, lineWidth: 1.5 * pixel });
    context.fillRect(...BODY);
    context.strokeRect(...BODY);
    context.fillStyle = colors.ground;
    fillPolygon(context, [[-0.03, 0.024], [-0.03, -0.024], [0.018, 0]]);
    context.fillStyle = colors.tyre;
    context.fillRect(...CAMERA);
  });
}

// Calls draw while the context has its origin at this place, and x in this direction.
function atPose(context, [x, y, yaw], draw) {
  context.save();
  context.translate(x, y);
  context.rotate(yaw);
  draw();
  context.restore();
}

function fillPolygon(context, points) {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.fill();
}

// Marks a robot that is too small to see, or the chosen one.
export function drawRing(context, [x, y], radius, color, pixel) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  Object.assign(context, { strokeStyle: color, lineWidth: 2 * pixel });
  context.stroke();
}

// Draws where the nose would go at this speed [m/s, rad/s].
export function drawArrow(context, pose, speed, { color, dashed }, pixel) {
  const path = nosePath(speed);
  if (pathLength(path) < 6 * pixel) return;
  atPose(context, pose, () => {
    Object.assign(context, { fillStyle: color, lineWidth: 3 * pixel, lineCap: "butt" });
    context.setLineDash(dashed ? [6 * pixel, 4 * pixel] : []);
    drawLine(context, path, color);
    drawArrowhead(context, path[path.length - 2], path[path.length - 1], 7 * pixel);
  });
}

function nosePath([forward, turn]) {
  const time = Math.min(ARROW_TIME, Math.PI / Math.max(Math.abs(turn), 1e-6));
  const path = [[NOSE, 0]];
  let [x, y] = [0, 0];
  for (let step = 1; step <= ARROW_STEPS; step += 1) {
    const angle = turn * time * (step - 0.5) / ARROW_STEPS;
    x += forward * time / ARROW_STEPS * Math.cos(angle);
    y += forward * time / ARROW_STEPS * Math.sin(angle);
    const heading = turn * time * step / ARROW_STEPS;
    path.push([x + NOSE * Math.cos(heading), y + NOSE * Math.sin(heading)]);
  }
  return path;
}

function pathLength(path) {
  return path.slice(1).reduce((sum, [x, y], index) => sum + Math.hypot(x - path[index][0], y - path[index][1]), 0);
}

// Draws a tip at the end of a line that comes from there.
function drawArrowhead(context, /** @type {number[]} */ [fromX, fromY], /** @type {number[]} */ [x, y], size) {
  const angle = Math.atan2(y - fromY, x - fromX);
  fillPolygon(context, [0, 2.4, -2.4].map((turn) => [x + size * Math.cos(angle + turn),
    y + size * Math.sin(angle + turn)]));
}

// Draws walls, lines on the floor, a task's course and goal; each keeps its path.
// chosen: whether they belong to the chosen robot
export function drawScene(context, shapes, chosen, colors, pixel) {
  for (const shape of shapes) {
    const { color, thinnest, opacity } = STYLES[shape.kind];
    const width = (chosen ? thinnest : 1) * pixel;
    const task = shape.kind === "course" || shape.kind === "goal";
    Object.assign(context, {
      strokeStyle: colors[color], fillStyle: colors[color], lineJoin: "round", lineCap: task ? "round" : "butt",
      lineWidth: task ? width : Math.max(shape.width, width), globalAlpha: chosen ? opacity : FAINT,
    });
    if (shape.kind !== "goal") context.stroke(shape.path ??= pathOf(shape.points));
    else if (chosen) drawGoal(context, shape.points, pixel);
  }
  Object.assign(context, { globalAlpha: 1, lineCap: "butt" });
}

function pathOf(points) {
  const path = new Path2D();
  for (const [x, y] of points) path.lineTo(x, y);
  return path;
}

function drawGoal(context, [from, to], pixel) {
  const [metres, pixels] = GOAL_RADIUS;
  const radius = Math.max(metres, pixels * pixel);
  context.beginPath();
  context.arc(...from, radius, 0, 2 * Math.PI);
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
  drawArrowhead(context, from, to, 9 * pixel);
}
