// What a person should know of a program while it runs, and of what it asks too much.

import { t } from "../language.js";

const LIMITED = 1.005; // times the fastest speed: more than rounding
const PAUSED = t("Paused. Step runs what is marked.");
const NO_WAIT = t("A loop runs without a wait, so the robot stands still: put a wait into it.");

export const UNUSED = t("The robot obeys while the program waits: " +
  "put a wait below the last block that sets its speed.");

// Returns a sentence if the wheels cannot turn as fast as x, z asks, or "". robot: as the cockpit describes it
export function excess(/** @type {number[]} */ [x, z], { wheel_separation: separation, max_speed: fastest, workshop }) {
  const asked = Math.abs(x) + Math.abs(z) * separation / 2;
  if (asked <= fastest * LIMITED) return "";
  const values = { fastest, asked: Number(asked.toFixed(2)) };
  return workshop === false ? t("A wheel takes {fastest} m/s at most, not {asked}.", values)
    : t("A wheel takes {fastest} at most, not {asked}.", values);
}

// Returns what is said of a run that is not over, and whether that is a warning.
export function newsOf({ held, at, waitless, limit }) {
  if (held) return [at ? PAUSED : t("Paused"), false];
  if (waitless) return [NO_WAIT, true];
  if (!limit) return [at ? t("Running") : t("Starting"), false];
  const { text } = limit;
  return [at ? t("Running. {limit}", { limit: text }) : t("Starting. {limit}", { limit: text }), true];
}
