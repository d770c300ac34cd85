// Names that a program uses and nobody knows: variables, modules, attributes.

import { t } from "../language.js";
import { insteadOf, missing, NOT_HERE } from "./missing.js";
import { boundNames, BUILTINS, importOf, membersOf, methodsOf, MODULES, namesBoundBy } from "./names.js";
import { near } from "./near.js";
import { readStatements } from "./tokens.js";
import { CALL, joined, kindOf, NO_RESULT, SELF } from "./types.js";

const PART = t("Write motion.linear.x = 0.1, not motion.linear = 0.1");
const WORDS = {
  __proto__: null, null: "None", nil: "None", undefined: "None", this: "self", Math: "math", printf: "print",
  println: "print", echo: "print", puts: "print", length: "len", size: "len", string: "str", integer: "int",
};
const LENGTHS = ["length", "size", "len", "count"];

const meant = (text) => (text ? t("Do you mean {text}?", { text }) : "");

function unknownName({ name, source }) {
  const bound = boundNames(source);
  if (name === "self") return SELF;
  if (bound.has(name)) {
    return t("“{name}” has no value here: it gets one only further down, or inside a function.", { name });
  }
  const imported = importOf(name);
  if (imported) return t("“{name}” is not imported: write {text} at the top.", { name, text: imported });
  if (insteadOf(name)) return missing(name);
  const other = WORDS[name] ?? near(name, [...bound.keys(), ...BUILTINS]);
  return joined(t("“{name}” is not known here.", { name }),
                meant(other) || t("Give it a value before, or put a text between quotation marks."));
}

function unassigned({ source, number }) {
  const bound = boundNames(source);
  const statement = readStatements(source).statements.findLast(({ line }) => line <= number);
  const own = [...namesBoundBy(statement?.tokens ?? [])];
  const used = (statement?.tokens ?? []).filter(({ kind }) => kind === "name").map(({ text }) => text);
  const name = [...own, ...used].find((each) => bound.get(each));
  return name ? t("“{name}” has no value in this function. To use the one outside, begin the function with: {text}",
                  { name, text: `global ${name}` })
    : t("This line uses a name before the function gives it a value.");
}

function noModule({ name }) {
  if (insteadOf(name)) return missing(name);
  const other = near(name, [...MODULES, ...NOT_HERE]);
  return other ? joined(t("There is no module “{name}”.", { name }), meant(other)) : missing(name);
}

function noName({ name, code }) {
  const module = /\bfrom\s+([\w.]+)/.exec(code)?.[1] ?? "";
  if (insteadOf(`${module}.${name}`)) return missing(`${module}.${name}`);
  return joined(t("“{text}” has no “{name}”.", { text: module, name }), meant(near(name, membersOf(module))));
}

function noAttribute({ kind, owner, name, source }) {
  if (owner === "NoneType") return joined(t("What is before “.{name}” is None.", { name }), NO_RESULT);
  if (["function", "bound_method", "closure"].includes(owner)) return CALL;
  if (insteadOf(`${owner}.${name}`)) return missing(`${owner}.${name}`);
  if (LENGTHS.includes(name)) return t("len(x) gives the length of x.");
  const number = ["int", "float"].includes(owner) && /^[xyz]$/.test(name);
  const known = [...methodsOf(source), ...membersOf(owner)];
  const alone = kind === "type object" && known.includes(name); // "Twist.linear"
  return joined(t("“{text}” has no “{name}”.", { text: kindOf(owner), name }),
                number ? PART : meant(alone ? `${owner}()` : near(name, known)));
}

/** @import { Row } from "./mistakes.js" */
/** @type {Row[]} */
export const UNKNOWN = [
  ["NotHere", /^(?<name>.+)$/, ({ name }) => missing(name)],
  ["NotHeard", /^(?<name>.+)$/, ({ name }) => t(
    "Nothing in the page hears the topic {name}. To drive, the topic is {text}.", { name, text: "cmd_vel" })],
  ["NameError", /^name '(?<name>.+)' isn't defined$/, unknownName],
  ["NameError", /^local variable/, unassigned],
  ["ImportError", /^no module named '(?<name>.+)'$/, noModule],
  ["ImportError", /^can't import name (?<name>\w+)$/, noName],
  ["AttributeError", /^(?:(?<kind>type object|module) )?'_?(?<owner>.+)' (?:object )?has no attribute '(?<name>.+)'$/,
    noAttribute],
  ["AttributeError", /^(?<name>\w+) is not an attribute of (?<owner>\w+)$/, noAttribute],
];
