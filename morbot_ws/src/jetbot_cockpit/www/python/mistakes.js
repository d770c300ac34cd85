// What went wrong in a Python program, in a sentence for a pupil: from what MicroPython says of it, and the program.

import { t } from "../language.js";
import { missing } from "./missing.js";
import { syntaxProblem } from "./syntax.js";
import { joined, POINT, TYPES } from "./types.js";
import { UNKNOWN } from "./unknown.js";

/** @import { Problem } from "./tokens.js" */
/** @typedef {{ type: string, message: string, line: number }} Failure */
/** @typedef {[string, RegExp, (said: any) => string | Problem]} Row: types of errors; what MicroPython says;
 * the sentence, of what that names, of the program (source), and of the line that failed (code, number); with the line
 * to mark if that is another */

/** @type {Row[]} */
const COMPILED = [
  ["SyntaxError", /^'return' outside function$/, () => t("“return” ends a function: this line is in none.")],
  ["SyntaxError", /^'yield' outside function$/, () => t("“yield” belongs in a function: this line is in none.")],
  ["SyntaxError", /^'break'\/'continue' outside loop$/,
    () => t("“break” and “continue” belong in a loop: this line is in none.")],
  ["SyntaxError", /^can't assign to /, () => t("Only a name can get a value: put one on the left of =.")],
  ["SyntaxError", /^argument name reused$/, () => t("Two parameters have the same name.")],
  ["SyntaxError", /^non-default argument follows default/,
    () => t("A parameter without a value cannot follow one with a value.")],
  ["SyntaxError", /^positional arg after keyword arg$/,
    () => t("A value without a name cannot follow one with a name.")],
  ["SyntaxError", /^expecting (?:key:value for dict|just a value for set)$/,
    () => t("Each item of a dictionary is a key, a colon, and a value.")],
  ["SyntaxError", /global$|nonlocal/, () => t("“global” comes first in a function, before the name is used.")],
  ["SyntaxError", /^invalid syntax for /, () => t("Python cannot read this number.")],
  ["SyntaxError IndentationError", /./,
    ({ code }) => (/\br?f["']/i.test(code)
      ? t("What is in { } is too much for the page's Python: first give it a name, x = ..., then write f\"{x}\"")
      : t("Python cannot read this line. Compare it with an example."))],
];

// "motion.linear.x = 0,5" fails where that is published.
function notNumber({ name, source, number }) {
  const text = t("“{name}” of the message needs a number.", { name });
  const comma = new RegExp(`\\.${name.split(".").at(-1)}\\s*=\\s*-?\\d+,\\s*\\d+\\s*(?:#|$)`);
  const line = source.split("\n").slice(0, number).findLastIndex((each) => comma.test(each)) + 1;
  return line ? { text: joined(text, POINT), line } : text;
}

function wrongValues({ text: given, kind }) {
  const text = given.replace(/[^\w, ]/g, "");
  const hint = kind ? t("Do you mean {text}?", { text: `${kind}()` })
    : text === "linear, angular" && t("First make a message: motion = Twist(), then motion.linear.x = 0.5");
  return joined(t("The message takes all of these values, or none: {text}.", { text }), hint);
}

/** @type {Row[]} */
const VALUES = [
  ["IndexError", /out of range$/, ({ code }) => (/\bsys\.argv\b/.test(code) ? missing("sys.argv")
    : t("There is no item at this position: the first is 0, the last is len(x) - 1."))],
  ["IndexError", /^(?:pop from empty list)?$/, () => t("The list is empty.")],
  ["ValueError", /^arg is an empty sequence$/, () => t("The list is empty.")],
  ["KeyError", /^(?<text>.*)$/, ({ text }) => t("There is no key “{text}”.", { text })],
  ["ZeroDivisionError", /^/, () => t("This line divides by 0.")],
  ["ValueError", /^invalid syntax for integer with base \d+: '(?<text>.*)'$/,
    ({ text }) => t("int(...) cannot make a whole number of “{text}”.", { text })],
  ["ValueError", /^invalid syntax for number$/,
    () => t("float(...) cannot make a number of this text: a number looks like 0.5")],
  ["ValueError", /^too many values to unpack \(expected (?<count>\d+)\)$/, ({ count }) => t(
    "There are more values than the {count} name on the left of =.|"
    + "There are more values than the {count} names on the left of =.", { count })],
  ["ValueError", /^need more than (?<count>\d+) values to unpack$/, ({ count }) => t(
    "There is only {count} value for the names on the left of =.|"
    + "There are only {count} values for the names on the left of =.", { count })],
  ["ValueError", /^(?:object not in sequence|substring not found)$/,
    () => t("What you look for is not in the list or the text.")],
  ["ValueError", /^math domain error$/, () => t("This function of math has no result for this number.")],
  ["RuntimeError", /^(?:maximum recursion depth|pystack)/,
    () => t("A function calls itself again and again: let it end with an if.")],
  ["MemoryError", /^/, () => t("The program needs too much memory: does a list or a text grow without an end?")],
  ["OSError", /^29$/, () => missing("sys.stdin")],
  ["AssertionError", /^$/, () => t("What “assert” says is not true.")],
  ["ROSException ROSInitException", /not (?:been )?initialized/,
    () => t("“rospy.init_node” comes first: rospy.init_node(\"my_program\")")],
  ["ROSSerializationException SerializationError", /^field (?<name>\S+) must be (?:float|an integer|unsigned)/,
    notNumber],
  ["TypeError", /^Invalid number of arguments, args should be (?<text>.+?) args are(?:\(<class '(?<kind>\w+)'>,\))?/,
    wrongValues],
  ["TypeError", /^expected \[(?<kind>.*)\] but got \[(?<other>.*)\]$/, ({ kind, other }) => t(
    "The message needs {kind}, not {other}.", { kind, other })],
  ["TypeError", /^(?<name>\S+) carries (?<kind>\S+), not (?<other>\S+)$/,
    ({ name, kind, other }) => t("The topic {name} takes {kind}, not {other}.", { name, kind, other })],
];

const MISTAKES = [...UNKNOWN, ...TYPES, ...VALUES, ...COMPILED];

// Returns a failure in the page's words, and the line to mark. What no row knows stays in MicroPython's words.
/** @param {Failure} failure @param {string} source as the person wrote it @returns {Problem} */
export function explain({ type, message, line }, source) {
  const broken = ["SyntaxError", "IndentationError"].includes(type) && syntaxProblem(source);
  if (broken) return broken;
  const lines = source.split("\n");
  const number = Math.max(1, Math.min(line, lines.length)); // MicroPython may mean the end
  const said = { source, code: lines[number - 1], number };
  for (const [types, pattern, sentence] of MISTAKES) {
    const match = types.split(" ").includes(type) && pattern.exec(message);
    const found = match && sentence({ ...match.groups, ...said });
    if (found) return typeof found === "string" ? { text: found, line: number } : found;
  }
  return { text: message ? `${type}: ${message}` : type, line: number };
}
