// What a person should know of a program while it runs, and of what it asks too much.

const LIMITED = 1.005; // times the fastest speed: more than rounding
const PAUSED = "Paused. Step runs the marked block.";
const NO_WAIT = "A loop runs without a wait, so the robot stands still: put a wait into it.";

export const UNUSED = "The robot obeys while the program waits: put a wait below the last block that sets its speed.";

// Returns a sentence if the wheels cannot turn as fast as x, z asks, or "". robot: as the cockpit describes it
export function excess(/** @type {number[]} */ [x, z], { wheel_separation: separation, max_speed: fastest, workshop }) {
  const asked = Math.abs(x) + Math.abs(z) * separation / 2;
  const unit = workshop === false ? " m/s" : "";
  return asked > fastest * LIMITED ? `A wheel takes ${fastest}${unit} at most, not ${Number(asked.toFixed(2))}.` : "";
}

// Returns what is said of a run that is not over, and whether that is a warning.
export function newsOf({ held, at, waitless, limit }) {
  if (held) return [at ? PAUSED : "Paused", false];
  if (waitless) return [NO_WAIT, true];
  const text = at ? "Running" : "Starting";
  return limit ? [`${text}. ${limit.text}`, true] : [text, false];
}
