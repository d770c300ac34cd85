// Draws what is around a robot, in metres: walls, lines on the floor, its task's course and goal.

import { drawArrowhead } from "./shapes.js";

const GOAL_RADIUS = [0.04, 7]; // in metres and in pixels: the larger one
const FAINT = 0.3; // opacity of what belongs to another robot
const STYLES = { // color: its name in the page's style; thinnest: width in pixels; opacity: of the chosen robot's
  wall: { color: "tyre", thinnest: 3, opacity: 1 },
  line: { color: "muted", thinnest: 2, opacity: 1 },
  course: { color: "course", thinnest: 7, opacity: 0.4 },
  goal: { color: "course", thinnest: 2.5, opacity: 1 },
};

// Takes the shapes of a message; returns those that this page can draw, each with its path.
export function prepareShapes(shapes) {
  return shapes.filter(({ kind }) => Object.hasOwn(STYLES, kind)).map((shape) => {
    const path = new Path2D();
    for (const [x, y] of shape.points) path.lineTo(x, y);
    return { ...shape, path };
  });
}

// chosen: whether they belong to the chosen robot; pixel: size of a pixel in metres
export function drawScene(context, shapes, chosen, colors, pixel) {
  for (const shape of shapes) {
    const { color, thinnest, opacity } = STYLES[shape.kind];
    const width = (chosen ? thinnest : 1) * pixel;
    const task = shape.kind === "course" || shape.kind === "goal";
    Object.assign(context, {
      strokeStyle: colors[color], fillStyle: colors[color], lineJoin: "round", lineCap: task ? "round" : "butt",
      lineWidth: task ? width : Math.max(shape.width, width), globalAlpha: chosen ? opacity : FAINT,
    });
    if (shape.kind !== "goal") context.stroke(shape.path);
    else if (chosen) drawGoal(context, shape.points, pixel);
  }
  Object.assign(context, { globalAlpha: 1, lineCap: "butt" });
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
