// What the pad's page shows of the chosen robot: who drives it, its task, what its wheels get and the formula
// that leads there, and what a teacher can do with it.

/** @import { World } from "./world.js" */

import { element, inSeconds, setClass, setText, signed } from "./dom.js";
import { leaveView } from "./views.js";

const SIMULATED = "Simulated: no real robot moves.";
const SIDES = [["left", "−", -1], ["right", "+", 1]];

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
  SIDES.forEach(([name, operator, sign], index) => {
    const value = known ? wheelSpeed(sign, shown, robot) : undefined;
    showBar(name, wheels?.[index], value);
    setText(element(`${name}-formula`), known ? formula(name, operator, shown, value, robot) : "");
  });
}

// Returns what the formula gives for x and z.
function wheelSpeed(sign, [x, z], { wheel_separation: separation, max_speed: maxSpeed, workshop }) {
  return workshop ? x + sign * z : (x + sign * z * separation / 2) / maxSpeed;
}

// Returns one side's formula with its numbers: value is its result.
function formula(name, operator, [x, z], value, { wheel_separation: separation, max_speed: maxSpeed, workshop }) {
  const limited = Math.abs(value) > 1.005 ? `, limited to ${signed(Math.sign(value))}` : "";
  const operand = signed(z).startsWith("−") ? `(${signed(z)})` : signed(z);
  const sum = `${signed(x)} ${operator} ${operand}`;
  if (workshop) return `${name} = x ${operator} z = ${sum} = ${signed(value)}${limited}`;
  const words = `(x ${operator} z · separation / 2) / max. speed`;
  return `${name} = ${words} = (${sum} · ${separation} / 2) / ${maxSpeed} = ${signed(value)}${limited}`;
}

// expected: the formula's result; where the two differ by rounding alone, the number is the formula's
function showBar(name, value, expected) {
  const meter = element(`${name}-wheel`);
  const bar = meter.nextElementSibling.firstElementChild;
  meter.value = value ?? 0;
  meter.setAttribute("aria-valuetext", value === undefined ? "not known" : `${Math.round(value * 100)} %`);
  bar.style.transform = `scaleX(${Math.max(-1, Math.min(1, value ?? 0))})`;
  const shown = Math.abs(value - expected) < 0.011 ? expected : value;
  setText(element(`${name}-value`), value === undefined ? "–" : signed(shown));
}

// The robot's task: its title, what its judge says, the time, and the score at the end.
function showTask(task) {
  element("task").hidden = !task;
  setClass(document.body, "task", task);
  setText(element("task-news"), task && task.state !== "driving" ? spoken(task) : ""); // the seconds are not read
  if (!task) return;
  element("task").dataset.state = task.state;
  setText(element("task-title"), task.title);
  setText(element("task-result"), result(task));
  setText(element("task-text"), task.state === "driving" ? "" : task.text);
}

function result({ state, score, seconds }) {
  if (score !== null) return [`${score.toFixed(1)} points`, inSeconds(seconds)].filter(Boolean).join(", ");
  return state === "driving" ? inSeconds(seconds) : "";
}

function spoken(task) {
  return [`${task.title}:`, result(task) && `${result(task)}.`, task.text].filter(Boolean).join(" ");
}
