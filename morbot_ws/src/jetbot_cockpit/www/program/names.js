// The names of programs.

import { t } from "../language.js";
import { limits } from "../limits.js";
import { beginning, toName } from "../storage.js";

const NOT_LATIN = /(?!\p{Script=Latin})\p{L}/gu;

// Returns a name that the cockpit takes.
export function clean(name) {
  return toName(beginning(String(name), limits.program_name)) || t("Program");
}

// Returns a name for a new program, which none of these rows has: "Square", "Square 2", "Square 3".
/** @param {string} name @param {{ name: string, deleted?: boolean }[]} rows */
export function freeName(name, rows) {
  const isTaken = (each) => rows.some((row) => !row.deleted && row.name === each);
  const [, base, last] = /** @type {string[]} */ (name.match(/^([^]*?)(?: (\d{1,4}))?$/));
  for (let number = Number(last ?? 1); isTaken(name); name = numbered(base, number)) number += 1;
  return name;
}

function numbered(name, number) {
  return `${beginning(name, limits.program_name - ` ${number}`.length)} ${number}`;
}

// Returns a name for a file: "jetbot_07, Ömer" becomes "jetbot_07_Omer".
export function plain(text) {
  return text.normalize("NFKD").replace(/\p{M}/gu, "").replaceAll("ß", "ss").replace(/[^A-Za-z0-9]+/g, "_");
}

// Returns the name of the package of a program: it clashes with no package of the workspace.
export function packageName(title) {
  const inCodes = title.replace(NOT_LATIN, (letter) => `_${Number(letter.codePointAt(0)).toString(16)}_`);
  const name = plain(inCodes).toLowerCase().replace(/^_+|_+$/g, "").slice(0, 40);
  return name.startsWith("my_") ? name : `my_${name || "program"}`;
}
