// A program as a file: opened, saved, and packed for ROS.

import { download } from "../dom.js";
import { withPython } from "./check.js";
import { packageName } from "./names.js";
import { packageText } from "./package.js";

const MAX_FILE = 20e6; // bytes that are read at all

// Opens the file that a person has chosen: a program, or a text in Python.
export async function openFile(input, work) {
  const [file] = input.files;
  if (!file) return;
  const content = await file.slice(0, MAX_FILE).text();
  const [, name, kind] = file.name.match(/^(.*?)(\.json|\.py(?:\.txt)?)?$/s);
  work.addFile(name, kind?.startsWith(".py") ? withPython(content) : content);
  input.value = "";
}

// Browsers hold back a .py as they do a program. title: of the program; python: the text that it is, or null; program:
// the text that opens it again
export function save(title, python, program) {
  const name = packageName(title);
  if (python === null) download(`${name}.json`, program, "application/json");
  else download(`${name}.py.txt`, python, "text/plain");
}

export function savePackage(title, python, program) {
  const name = packageName(title);
  download(`${name}.txt`, packageText(name, python, program), "text/plain");
}
