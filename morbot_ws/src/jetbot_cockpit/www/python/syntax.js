// What is wrong with a program before it runs. It must find nothing in any program that Python understands:
// whatever else is wrong, MicroPython says.

import { t } from "../language.js";
import { near } from "./near.js";
import { ends, KEYWORDS, problem, readStatements, VALUES } from "./tokens.js";

/** @import { Problem, Statement, Token } from "./tokens.js" */

const BLOCKS = ["if", "elif", "else", "while", "for", "def", "class", "try", "except", "finally", "with"];
const CONDITIONS = ["if", "elif", "while"];
const FOLLOWS = {
  __proto__: null,
  elif: ["if", "elif"], else: ["if", "elif", "for", "while", "except"], except: ["try", "except"],
  finally: ["try", "except", "else"],
};
const BINARY = ("/ // % @ == != < > <= >= & | ^ << >> = += -= *= /= //= %= @= &= |= ^= <<= >>= **= := and or in is"
  ).split(" ");
const UNARY = ["+", "-", "*", "**", "~", "not"];
const STOPS = [")", "]", "}", ",", ":", ";"];

const word = ({ tokens }) => (tokens[0].text === "async" && tokens[1] ? tokens[1].text : tokens[0].text);
const opens = (statement) => statement.tokens.at(-1).text === ":" && BLOCKS.includes(word(statement));
const outside = (tokens) => tokens.filter((token) => !token.opener && !["open", "close"].includes(token.kind));
const quoted = (text) => ({ text });

// Returns the first mistake of a program and its line, or null.
/** @param {string} source @returns {Problem | null} */
export function syntaxProblem(source) {
  const { statements, wrong } = readStatements(source);
  if (wrong) return wrong;
  const levels = [{ indent: "", before: "" }];
  for (const [index, statement] of statements.entries()) {
    const found = layout(statement, statements[index - 1], levels) ?? check(statement);
    if (found) return found;
  }
  const last = statements.at(-1);
  return last && opens(last) ? problem(t("“{text}” needs a line below it, 4 spaces further in.", quoted(word(last))),
                                       last.line) : null;
}

// Returns what is wrong with where a statement begins. levels: of the blocks around it, with the word before it in each
/** @param {Statement} statement @param {Statement | undefined} above */
function layout(statement, above, levels) {
  const { indent, line } = statement;
  const top = levels.at(-1);
  if (!indent.startsWith(top.indent) && !top.indent.startsWith(indent)) {
    return problem(t("This line mixes tabs and spaces at its beginning: use spaces alone."), line);
  }
  const deeper = indent.length > top.indent.length;
  if (above && opens(above)) {
    if (!deeper) return problem(t("This line belongs to “{text}” above it: put 4 spaces before it.",
                                  quoted(word(above))), line);
    levels.push({ indent, before: "" });
  } else if (deeper) {
    return problem(t("This line begins too far to the right: let it begin where the line above it does."), line);
  }
  return siblings(statement, levels);
}

// Returns what is wrong with the order of if, else, try, except ...
function siblings(statement, levels) {
  while (levels.at(-1).indent.length > statement.indent.length) levels.pop();
  const level = levels.at(-1);
  if (level.indent !== statement.indent) {
    return problem(t("This line begins in no column in which a line above it begins."), statement.line);
  }
  const now = word(statement);
  const before = level.before;
  level.before = now;
  if (FOLLOWS[now] && !FOLLOWS[now].includes(before)) {
    return problem(t("“{name}” has no “{text}” above it that begins in the same column.",
                     { name: now, text: FOLLOWS[now][0] }), statement.line);
  }
  return before === "try" && !FOLLOWS[now] ? problem(t("“try” needs “except” below its lines."), statement.line) : null;
}

// Returns what is wrong with a statement itself, by the first rule that knows.
function check(statement) {
  for (const rule of RULES) {
    const found = rule(statement.tokens, statement);
    if (found) return problem(found[0], (found[1] ?? statement).line);
  }
  return null;
}

/** @typedef {[string, Token?] | false | undefined | null} Found: the sentence, and where */
/** @type {((tokens: Token[], statement: Statement) => Found)[]} */
const RULES = [
  ([first, second]) => first.text === "print" && second && !second.opener && begins(second)
    && [t("print needs brackets: print(...).")],
  ([first, second]) => first.text === "else" && second?.text === "if"
    && [t("Python writes “else if” as {text}.", quoted("elif"))],
  ([first, second], { tokens }) => first.text === "else" && second && second.text !== ":" && tokens.at(-1).text === ":"
    && [t("“else” has no condition: delete it, or use elif.")],
  ([first]) => ["//", "/"].includes(first.text) && [t("A comment begins with #.")],
  (tokens) => misspelled(tokens),
  ([first], { tokens }) => first.text === "match" && tokens.length > 2 && tokens.at(-1).text === ":"
    && [t("Python in the page has no “match”: use if and elif.")],
  (tokens) => keywordAsName(tokens),
  (tokens, statement) => CONDITIONS.includes(word(statement)) && equals(tokens),
  (tokens, statement) => word(statement) === "for" && !outside(tokens).some(({ text }) => text === "in")
    && [t("“for” needs “in”: for i in range(10):")],
  ([first, second, third]) => first.text === "def" && second?.kind === "name" && third?.text !== "(" && third?.text !== "["
    && [t("A function needs brackets after its name: def {text}():", second)],
  (tokens, statement) => BLOCKS.includes(word(statement)) && !colon(tokens)
    && [t("A colon is missing: a line with “{text}” ends with :", quoted(word(statement)))],
  (tokens) => pairs(tokens, increment),
  (tokens) => pairs(tokens, gap),
];

// A statement that begins with a name where only a keyword fits: "If x:", "improt math"
function misspelled([first, second, ...others]) {
  if (first.kind !== "name" || !second || ["match", "case", "type"].includes(first.text)) return null;
  const header = [second, ...others].at(-1).text === ":";
  const meant = header || begins(second) ? near(first.text, [...KEYWORDS, "print"]) ?? FOREIGN_WORDS[first.text] : null;
  return meant && [t("“{name}” is not known here. Do you mean {text}?", { name: first.text, text: meant })];
}

const FOREIGN_WORDS = { __proto__: null, elseif: "elif", elsif: "elif", function: "def", func: "def", fun: "def", switch: "if" };

function keywordAsName(tokens) {
  const index = tokens.findIndex(({ kind, text }, at) => kind === "keyword" && !VALUES.includes(text)
    && (tokens[at + 1]?.text === "=" || ["def", "class"].includes(tokens[at - 1]?.text)));
  return index >= 0 && [t("“{text}” is a word of Python: choose another name.", tokens[index]), tokens[index]];
}

function equals(tokens) {
  if (tokens.some(({ text }) => text === "lambda")) return null;
  const header = tokens.slice(0, tokens.indexOf(colon(tokens) ?? tokens.at(-1)));
  const sign = header.find(({ text, opener }) => text === "=" && !opener?.call);
  return sign && [t("= gives a value to a name; use == to compare."), sign];
}

// Returns the colon after which the block begins.
function colon(tokens) {
  let lambdas = 0;
  return outside(tokens).find(({ text }) => {
    if (text === "lambda") lambdas += 1;
    return text === ":" && (lambdas -= 1) < 0;
  });
}

// Returns what the rule says of the first two tokens beside each other that cannot be.
function pairs(tokens, rule) {
  for (const [index, token] of [...tokens, undefined].entries()) {
    const found = rule(tokens[index - 1], token, tokens, index);
    if (found) return [found, tokens[index - 1] ?? token];
  }
  return null;
}

function increment(before, token, tokens, index) {
  const sign = before?.text;
  if (!["+", "-"].includes(sign) || tokens[index - 2]?.text !== sign || !ends(tokens[index - 3])) return null;
  return (!token || STOPS.includes(token.text))
    && t("Python has no “{name}”: use {text}.", { name: sign + sign, text: `${sign}= 1` });
}

function gap(before, token, tokens, index) {
  if (ends(before) && begins(token) && !(before.kind === "string" && token.kind === "string")) {
    return !(index === 1 && ["match", "case", "type"].includes(before.text)) && t(
      "Something is missing between “{name}” and “{text}”: a comma, perhaps, or +, or quotation marks.",
      { name: before.text, text: token.text });
  }
  if (needsRight(before, tokens[index - 2]) && (!token || stops(before, token))) {
    return t("Something is missing after “{text}”.", before);
  }
  return needsLeft(token, before) && t("Something is missing before “{text}”.", token);
}

function begins(token) {
  return Boolean(token) && (["name", "number", "string"].includes(token.kind)
    || [...VALUES, "lambda"].includes(token.text));
}

const needsRight = (token, before) => token && !ends(token) && ([...BINARY, ...UNARY].includes(token.text))
  && !(token.text === "*" && before?.text === "import");

// "*" and "/" divide the parameters of a function.
const stops = (before, token) => STOPS.includes(token.text) && !["*", "/"].includes(before.text);

// "x, = y" and "for x, in y" are Python; so is "not in", and "@" before a function.
const needsLeft = (token, before) => BINARY.includes(token?.text) && !ends(before)
  && !(before?.text === "," && ["=", "in", "/"].includes(token.text))
  && !(before?.text === "not" && token.text === "in") && !(token.text === "@" && !before)
  && !(before?.text === ";");
