// The map from above: grid, trails, robots, and the chosen robot's commanded and actual speed.

/** @import { World } from "./world.js" */

import { visible } from "./colors.js";
import { element } from "./dom.js";
import {
  drawArrow, drawGrid, drawRing, drawRobot, drawScene, drawTrail, SCALE_HEIGHT,
} from "./drawing.js";
import { limits } from "./limits.js";
import { MapText } from "./map_text.js";
import { Viewport } from "./viewport.js";

const COLORS = ["ground", "grid", "axis", "text", "muted", "tyre", "commanded", "actual", "course"];
const [BODY_RADIUS, MIN_RADIUS] = [0.1, 9]; // of a robot, in metres, and in pixels, at which it is found
const [CHOSEN_RADIUS, MIN_CHOSEN_RADIUS] = [0.13, 14]; // of the ring around the chosen one
const TAP_RADIUS = 28; // pixels

export class RobotMap {
  following = true;
  /** @type {Record<string, string>} */
  colors = {};
  /** @type {{ places: () => number[][], isOver: () => boolean } | null} */
  framed = null; // which places are shown, and whether no more, until a person moves the map

  // choose(id): a robot was tapped; redraw(): draw() is due; lost(): whether there is no
  // connection
  /** @param {World} world */
  constructor(canvas, world, { choose, redraw, lost }) {
    this.canvas = canvas;
    this.world = world;
    this.choose = choose;
    this.redraw = redraw;
    this.text = new MapText(canvas, world, lost);
    this.viewport = new Viewport(canvas, {
      changed: redraw,
      tapped: (right, down) => this.tap(right, down),
      dragged: () => this.follow(false),
      zoomed: () => { this.framed = null; },
    });
    this.readColors();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.readColors());
    const sizes = new ResizeObserver(() => this.measure());
    for (const each of [canvas, element("tools"), element("legend")]) sizes.observe(each);
    element("zoom-in").addEventListener("click", () => this.viewport.zoom(1.4));
    element("zoom-out").addEventListener("click", () => this.viewport.zoom(1 / 1.4));
    element("fit").addEventListener("click", () => this.fit());
    element("follow").addEventListener("click", () => this.follow(!this.following));
  }

  measure() {
    const isSeen = ({ offsetLeft, offsetWidth }) => offsetLeft + offsetWidth <= this.canvas.clientWidth;
    const [above, below] = [element("tools"), element("legend")].map((each) => isSeen(each) && each.offsetHeight + 6);
    this.viewport.covered = { above: Number(above), below: Number(below) + SCALE_HEIGHT };
    if (this.framed) this.viewport.fit(this.framed.places());
    this.redraw();
  }

  readColors() {
    const style = getComputedStyle(document.documentElement);
    this.colors = Object.fromEntries(COLORS.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
    this.redraw();
  }

  follow(on) {
    this.following = on;
    this.framed = null;
    element("follow").setAttribute("aria-pressed", on);
    this.redraw();
  }

  fit() {
    this.frame(() => [...this.world.placed.map(({ state }) => state.pose),
      ...this.world.robots.flatMap(({ id }) => this.world.pointsOf(id))]);
  }

  // A robot's course has come: shows all of it instead of following the robot, until its task is over.
  showCourse(id) {
    const course = this.world.courseOf(id);
    if (id !== this.world.chosen || !this.following || !course.length) return;
    const { pose } = this.world.state(id);
    this.frame(() => pose ? [pose, ...course] : course, () => this.world.isTaskOver(id));
  }

  // Shows what places() returns, also when the map's size changes, until a person moves it, or isOver().
  frame(places, isOver = () => false) {
    this.follow(false);
    this.framed = { places, isOver };
    this.viewport.fit(places());
  }

  // A state has arrived.
  update() {
    if (this.framed?.isOver()) this.follow(true);
  }

  tap(right, down) {
    const distances = this.world.placed.map(({ robot: { id }, state }) => {
      const [x, y] = this.viewport.toPixels(...state.pose);
      return { id, distance: Math.hypot(x - right, y - down) };
    });
    const [near] = distances.sort((one, other) => one.distance - other.distance);
    if (near?.distance < TAP_RADIUS) this.choose(near.id);
  }

  draw() {
    const context = this.fitCanvas();
    const { pose } = this.world.state(this.world.chosen);
    if (this.following && pose) this.viewport.centre(pose[0], pose[1]);
    drawGrid(context, this.viewport, this.colors);
    this.inMetres(context, (pixel) => {
      this.drawScenes(context, pixel);
      for (const { id, color } of this.world.robots) {
        drawTrail(context, this.world.trails.get(id) ?? [], visible(color), pixel);
      }
    });
    this.drawLabels(context);
    this.inMetres(context, (pixel) => this.drawRobots(context, pixel));
    this.text.show();
  }

  fitCanvas() {
    const ratio = devicePixelRatio || 1;
    const [width, height] = [Math.round(this.viewport.width * ratio), Math.round(this.viewport.height * ratio)];
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const context = this.canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = this.colors.ground;
    context.fillRect(0, 0, this.viewport.width, this.viewport.height);
    return context;
  }

  // Calls draw with the size of a pixel, while the context is in metres.
  inMetres(context, draw) {
    context.save();
    context.translate(...this.viewport.toPixels(0, 0));
    context.scale(this.viewport.scale, -this.viewport.scale);
    draw(1 / this.viewport.scale);
    context.restore();
  }

  drawScenes(context, pixel) {
    const { scenes, chosen } = this.world;
    for (const id of this.chosenLast([...scenes.keys()], (id) => id)) {
      drawScene(context, scenes.get(id), id === chosen, this.colors, pixel);
    }
  }

  // The chosen robot is on top.
  chosenLast(items, idOf) {
    const isChosen = (item) => idOf(item) === this.world.chosen;
    return items.sort((one, other) => Number(isChosen(one)) - Number(isChosen(other)));
  }

  get placed() {
    return this.chosenLast(this.world.placed, ({ robot }) => robot.id);
  }

  drawRobots(context, pixel) {
    for (const { robot, state } of this.placed) {
      const [chosen, color] = [robot.id === this.world.chosen, visible(robot.color)];
      const radius = radiusOf(chosen, pixel);
      drawRobot(context, state.pose, color, this.colors, pixel);
      if (chosen || radius > BODY_RADIUS) drawRing(context, state.pose, radius, color, pixel);
      if (chosen) this.drawArrows(context, robot, state, pixel);
    }
  }

  drawArrows(context, robot, { pose, command, speed }, pixel) {
    const { actual, commanded } = this.colors;
    if (speed) drawArrow(context, pose, speed, { color: actual, dashed: false }, pixel);
    if (command) drawArrow(context, pose, nominalSpeed(command, robot), { color: commanded, dashed: true }, pixel);
  }

  drawLabels(context) {
    Object.assign(context, { textAlign: "center", strokeStyle: this.colors.ground, lineWidth: 4, lineJoin: "round" });
    for (const { robot, state } of this.placed) {
      const chosen = robot.id === this.world.chosen;
      const [x, y] = this.viewport.toPixels(...state.pose);
      const below = y + radiusOf(chosen, 1 / this.viewport.scale) * this.viewport.scale + 14;
      context.font = `${chosen ? "bold 13px" : "12px"} system-ui, sans-serif`;
      context.fillStyle = chosen ? this.colors.text : this.colors.muted;
      const name = robot.label.slice(this.world.commonName.length);
      context.strokeText(name, x, below);
      context.fillText(name, x, below);
    }
  }
}

// Returns the radius in metres of what is drawn of a robot. pixel: size of a pixel in metres.
function radiusOf(chosen, pixel) {
  const [metres, pixels] = chosen ? [CHOSEN_RADIUS, MIN_CHOSEN_RADIUS] : [BODY_RADIUS, MIN_RADIUS];
  return Math.max(metres, pixels * pixel);
}

// Returns the speed [m/s, rad/s] that a command asks for: in the workshop's units it is one of power.
function nominalSpeed([x, z], { workshop }) {
  if (!workshop) return [x, z];
  const [left, right] = [x - z, x + z].map((power) => limits.full_speed * Math.max(-1, Math.min(1, power)));
  return [(left + right) / 2, (right - left) / limits.wheel_separation];
}
