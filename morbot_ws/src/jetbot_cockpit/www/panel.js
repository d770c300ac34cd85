// What the pad's page shows of the chosen robot: who drives it, its task, what its wheels get and the formula
// that leads there, and what a teacher can do with it.

/** @import { World } from "./world.js" */

import { element, inSeconds, setClass, setText, signed } from "./dom.js";
import { number, t } from "./language.js";
import { saidOf } from "./task.js";
import { leaveView } from "./views.js";

const SIMULATED = t("Simulated: no real robot moves.");
const SIDES = [
  { side: "left", name: t("left"), operator: "−", sign: -1 },
  { side: "right", name: t("right"), operator: "+", sign: 1 },
];

// problem: why there is no connection, or ""
/** @param {World} world */
export function showPanel(world, problem) {
  const id = world.chosen;
  const [robot, state] = [world.robot(id), world.state(id)];
  setText(element("driver"), robot && !problem ? world.describeDriver(id) : "");
  setClass(element("driver"), "soon", state.resumes);
  showWheels(robot, state);
  showTask(robot && state.task);
  showTeachersTools(world, robot, state);
}

function showTeachersTools(world, robot, { fake }) {
  const several = world.robots.length > 1;
  const fleet = world.teacher && several;
  element("fit").hidden = !several && !world.pointsOf(robot?.id).length;
  element("fleet").hidden = element("show-fleet").hidden = !fleet;
  element("show-codes").hidden = !world.me.codes;
  element("take").hidden = !(world.teacher && robot && world.mayTake(robot.id));
  element("go-on").hidden = !(world.teacher && robot && world.nameWaiting(robot.id));
  element("reset").hidden = !(world.teacher && robot?.simulated);
  element("robot").title = fake ? SIMULATED : "";
  setClass(document.body, "several", fleet);
  if (!fleet) leaveView("fleet");
}

function showWheels(robot, { command, wheels }) {
  const known = robot && command && robot.workshop !== null; // null: its units are not known yet
  const shown = known && command.map((value) => Number(value.toFixed(2)));
  SIDES.forEach(({ side, name, operator, sign }, index) => {
    const value = known ? wheelSpeed(sign, shown, robot) : undefined;
    showBar(side, wheels?.[index], value);
    setText(element(`${side}-formula`), known ? `${name} = ${formula(operator, shown, value, robot)}` : "");
  });
}

// Returns what the formula gives for x and z.
function wheelSpeed(sign, [x, z], { wheel_separation: separation, max_speed: maxSpeed, workshop }) {
  return workshop ? x + sign * z : (x + sign * z * separation / 2) / maxSpeed;
}

// Returns one side's formula with its numbers: value is its result.
function formula(operator, [x, z], value, { wheel_separation: separation, max_speed: maxSpeed, workshop }) {
  const operand = signed(z).startsWith("−") ? `(${signed(z)})` : signed(z);
  const sum = `${signed(x)} ${operator} ${operand}`;
  if (workshop) return `x ${operator} z = ${sum} = ${limited(value)}`;
  const words = t("(x {operator} z · separation / 2) / max. speed", { operator });
  return `${words} = (${sum} · ${number(separation)} / 2) / ${number(maxSpeed)} = ${limited(value)}`;
}

// A wheel has no more than full power.
function limited(value) {
  const [speed, limit] = [signed(value), signed(Math.sign(value))];
  return Math.abs(value) > 1.005 ? t("{speed}, limited to {limit}", { speed, limit }) : speed;
}

// expected: the formula's result; where the two differ by rounding alone, the number is the formula's
function showBar(side, value, expected) {
  const meter = element(`${side}-wheel`);
  const bar = meter.nextElementSibling.firstElementChild;
  meter.value = value ?? 0;
  meter.setAttribute("aria-valuetext", value === undefined ? t("not known") : `${Math.round(value * 100)} %`);
  bar.style.transform = `scaleX(${Math.max(-1, Math.min(1, value ?? 0))})`;
  const shown = Math.abs(value - expected) < 0.011 ? expected : value;
  setText(element(`${side}-value`), value === undefined ? "–" : signed(shown));
}

// The robot's task: its title, what its judge says, the time, and the score at the end.
function showTask(task) {
  element("task").hidden = !task;
  setClass(document.body, "task", task);
  setText(element("task-news"), task && task.state !== "driving" ? spoken(task) : ""); // the seconds are not read
  if (!task) return;
  element("task").dataset.state = task.state;
  setText(element("task-title"), t(task.title));
  setText(element("task-result"), result(task));
  setText(element("task-text"), task.state === "driving" ? "" : saidOf(task));
}

function result({ state, score, seconds }) {
  if (score === null) return state === "driving" ? inSeconds(seconds) : "";
  const points = t("{count} points", { count: score.toFixed(1) });
  return [points, inSeconds(seconds)].filter(Boolean).join(", ");
}

function spoken(task) {
  return [`${t(task.title)}:`, result(task) && `${result(task)}.`, saidOf(task)].filter(Boolean).join(" ");
}
