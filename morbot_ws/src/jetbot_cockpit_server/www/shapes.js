// Draws robots, trails and arrows, in metres; x ahead, y to the left.

// Like the simulation's model: the origin is the middle of the axle.
const BODY = [-0.095, -0.0475, 0.13, 0.095];
const WHEEL = { length: 0.06, width: 0.012, offset: 0.05625 };
const CAMERA = [0.028, -0.013, 0.012, 0.026];
const NOSE = 0.06; // where the arrows start
const ARROW_TIME = 0.8; // s that an arrow looks ahead
const ARROW_STEPS = 24;

export function drawTrail(context, points, color, width) {
  if (points.length < 2) return;
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  Object.assign(context, { strokeStyle: color, lineWidth: width, lineJoin: "round", globalAlpha: 0.55 });
  context.stroke();
  context.globalAlpha = 1;
}

// Draws the robot at [x, y, yaw]; pixel: size of a pixel in metres.
export function drawRobot(context, [x, y, yaw], color, colors, pixel) {
  context.save();
  context.translate(x, y);
  context.rotate(yaw);
  context.fillStyle = colors.tyre;
  for (const side of [1, -1]) {
    rounded(context, [-WHEEL.length / 2, side * WHEEL.offset - WHEEL.width / 2, WHEEL.length, WHEEL.width], 0.004);
    context.fill();
  }
  Object.assign(context, { fillStyle: color, strokeStyle: colors.ground, lineWidth: 1.5 * pixel });
  rounded(context, BODY, 0.014);
  context.fill();
  context.stroke();
  drawHeading(context, colors);
  context.restore();
}

function drawHeading(context, colors) {
  context.fillStyle = colors.ground;
  context.beginPath();
  for (const [x, y] of [[-0.03, 0.024], [-0.03, -0.024], [0.018, 0]]) context.lineTo(x, y);
  context.closePath();
  context.fill();
  context.fillStyle = colors.tyre;
  context.fillRect(...CAMERA);
}

// Marks a robot that is too small to see, or the chosen one.
export function drawRing(context, [x, y], radius, color, pixel) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  Object.assign(context, { strokeStyle: color, lineWidth: 2 * pixel });
  context.stroke();
}

// Draws where the nose would go at this speed [m/s, rad/s].
export function drawArrow(context, [x, y, yaw], [forward, turn], { color, dashed }, pixel) {
  const path = nosePath(forward, turn);
  if (pathLength(path) < 6 * pixel) return;
  context.save();
  context.translate(x, y);
  context.rotate(yaw);
  Object.assign(context, { strokeStyle: color, fillStyle: color, lineWidth: 3 * pixel, lineCap: "butt" });
  context.setLineDash(dashed ? [6 * pixel, 4 * pixel] : []);
  context.beginPath();
  for (const [pathX, pathY] of path) context.lineTo(pathX, pathY);
  context.stroke();
  context.setLineDash([]);
  drawArrowhead(context, path[path.length - 2], path[path.length - 1], 7 * pixel);
  context.restore();
}

function nosePath(forward, turn) {
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
export function drawArrowhead(context, [fromX, fromY], [x, y], size) {
  const angle = Math.atan2(y - fromY, x - fromX);
  context.beginPath();
  for (const turn of [0, 2.4, -2.4]) {
    context.lineTo(x + size * Math.cos(angle + turn), y + size * Math.sin(angle + turn));
  }
  context.closePath();
  context.fill();
}

function rounded(context, [x, y, width, height], radius) {
  context.beginPath();
  context.moveTo(x + radius, y);
  context.arcTo(x + width, y, x + width, y + height, radius);
  context.arcTo(x + width, y + height, x, y + height, radius);
  context.arcTo(x, y + height, x, y, radius);
  context.arcTo(x, y, x + width, y, radius);
  context.closePath();
}
