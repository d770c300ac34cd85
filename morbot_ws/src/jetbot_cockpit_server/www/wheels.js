// What the wheels get, and the formula that leads there.

import { element, setText } from "./dom.js";
import { operand, signed } from "./numbers.js";

const FULL_SPEED = 0.6; // m/s of a JetBot's wheel at full power, as the simulation has it
const WHEEL_SEPARATION = 0.1125; // m
const SIDES = [["left", "−", -1], ["right", "+", 1]];

// Returns what the formula gives for x and z.
function result(sign, [x, z], { wheel_separation: separation, max_speed: maxSpeed, workshop }) {
  return workshop ? x + sign * z : (x + sign * z * separation / 2) / maxSpeed;
}

// Returns one side's formula with its numbers: value is its result.
function formula(name, operator, [x, z], value, { wheel_separation: separation, max_speed: maxSpeed, workshop }) {
  const limited = Math.abs(value) > 1.005 ? `, limited to ${signed(Math.sign(value))}` : "";
  const sum = `${signed(x)} ${operator} ${operand(z)}`;
  if (workshop) return `${name} = x ${operator} z = ${sum} = ${signed(value)}${limited}`;
  const words = `(x ${operator} z · separation / 2) / max. speed`;
  return `${name} = ${words} = (${sum} · ${separation} / 2) / ${maxSpeed} = ${signed(value)}${limited}`;
}

// Returns the speed [m/s, rad/s] that a command asks for: in the workshop's units it is one of power.
export function nominalSpeed([x, z], { workshop }) {
  if (!workshop) return [x, z];
  const [left, right] = [x - z, x + z].map((power) => FULL_SPEED * Math.max(-1, Math.min(1, power)));
  return [(left + right) / 2, (right - left) / WHEEL_SEPARATION];
}

export function showWheels(robot, { command, wheels }) {
  const known = robot && command && robot.workshop !== null; // null: its units are not known yet
  const shown = known && command.map((value) => Number(value.toFixed(2)));
  SIDES.forEach(([name, operator, sign], index) => {
    const value = known ? result(sign, shown, robot) : undefined;
    showBar(name, wheels?.[index], value);
    setText(element(`${name}-formula`), known ? formula(name, operator, shown, value, robot) : "");
  });
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
