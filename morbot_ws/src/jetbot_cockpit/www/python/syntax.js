// What is wrong with a program before it runs. It finds nothing in a program that Python understands; what it does not
// find, MicroPython does.

import { t } from "../language.js";
import { BLOCKS, statementProblem, word } from "./rules.js";
import { problem, readStatements } from "./tokens.js";

/** @import { Problem, Statement } from "./tokens.js" */
/** @typedef {{ indent: string, before: string }} Level: of indentation, and the first word of the statement before */

const FOLLOWS = { // what comes right before it, in the same column
  __proto__: null, elif: ["if", "elif"], else: ["if", "elif", "for", "while", "except"], except: ["try", "except"],
  finally: ["try", "except", "else"],
};

const NO_EXCEPT = t("“try” needs “except” below its lines.");

/** @param {Statement | undefined} statement */
const opens = (statement) => statement?.tokens.at(-1)?.text === ":" && BLOCKS.includes(word(statement.tokens));

// Returns the first mistake of a program and its line, or null.
/** @param {string} source @returns {Problem | null} */
export function syntaxProblem(source) {
  const { statements, wrong } = readStatements(source);
  if (wrong) return wrong;
  const levels = [{ indent: "", before: "" }];
  for (const [index, statement] of statements.entries()) {
    const text = place(statement, statements[index - 1], levels) || order(statement, levels.at(-1));
    const found = text ? problem(text, statement.line) : statementProblem(statement.tokens);
    if (found) return found;
  }
  return ending(statements.at(-1), levels);
}

// Returns what is wrong with where the program ends, or null.
function ending(last, levels) {
  if (opens(last)) {
    const text = word(last.tokens);
    return problem(t("“{text}” needs a line below it, with 4 more spaces in front.", { text }), last.line);
  }
  return levels.some(({ before }) => before === "try") ? problem(NO_EXCEPT, last.line) : null;
}

// Returns what is wrong with where a statement begins, or "". levels: of the blocks around it; it changes them
/** @param {Statement} statement @param {Statement | undefined} above @param {Level[]} levels */
function place({ indent }, above, levels) {
  const outer = levels[levels.length - 1].indent;
  if (!indent.startsWith(outer) && !outer.startsWith(indent)) {
    return t("This line begins with tabs and spaces mixed: use spaces alone.");
  }
  const deeper = indent.length > outer.length;
  if (above && opens(above)) {
    levels.push({ indent, before: "" });
    return deeper ? "" : t("This line belongs to “{text}” above it: put 4 more spaces in front.",
                           { text: word(above.tokens) });
  }
  if (deeper) return t("This line is indented too far: align it with the line above.");
  while (levels[levels.length - 1].indent.length > indent.length) {
    if (levels.pop()?.before === "try") return NO_EXCEPT;
  }
  return levels[levels.length - 1].indent === indent ? ""
    : t("This line begins in a column in which no line above it begins.");
}

// Returns what is wrong with the order of if, else, try, except ..., or "".
/** @param {Statement} statement @param {Level | undefined} level */
function order({ tokens }, level = { indent: "", before: "" }) {
  const { before } = level;
  const name = level.before = word(tokens);
  if (FOLLOWS[name] ? !FOLLOWS[name].includes(before) : before === "try") {
    return FOLLOWS[name] ? t("“{name}” has no “{text}” above it in the same column.", { name, text: FOLLOWS[name][0] })
      : NO_EXCEPT;
  }
  return "";
}
