// How large a program may become while it is built: it can always be kept, and opened again. It knows no page.

import { t } from "../language.js";
import { limits } from "../limits.js";
import { problemOf } from "./check.js";

// Returns whether the cockpit does not keep this text of a program.
export function isTooLarge(program) {
  return new TextEncoder().encode(program).length > limits.program;
}

export class Room {
  fits = true; // whether the program that is shown can be kept; one from a file may be too large

  // Returns why the change that led to this program must be undone, or "". undoable: a person has changed something
  change(program, undoable) {
    const problem = problemWith(program);
    if (problem && this.fits && undoable) {
      return t("With the last change: {problem} It was undone.", { problem });
    }
    this.fits = !problem;
    return "";
  }
}

function problemWith(program) {
  return isTooLarge(program) ? t("This program has more than {most} kB.", { most: limits.program / 1024 })
    : problemOf(program);
}
