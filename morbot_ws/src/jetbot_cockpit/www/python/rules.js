// What cannot be in a statement of Python, whatever is around it.

import { t } from "../language.js";
import { near } from "./near.js";
import { ends, problem, VALUES } from "./tokens.js";

/** @import { Problem, Token } from "./tokens.js" */

export const BLOCKS = ["if", "elif", "else", "while", "for", "def", "class", "try", "except", "finally", "with"];
const STARTS = [...BLOCKS, "import", "from", "return", "global", "del", "raise", "assert", "nonlocal", "print"];
const SOFT = ["match", "case", "type"]; // words of newer Pythons that are names, too
const BINARY = ("/ // % @ == != < > <= >= & | ^ << >> = += -= *= /= //= %= @= &= |= ^= <<= >>= **= := and or in is"
).split(" ");
const OPERATORS = [...BINARY, "+", "-", "*", "**", "~", "not"];
const STOPS = [")", "]", "}", ",", ":", ";"];

// Words of other languages
const DECLARES = ["var", "let", "const", "int", "float", "double", "string", "auto"];
const MEANT = { __proto__: null, elseif: "elif", elsif: "elif", function: "def", func: "def", fun: "def" };

// Returns the first word of a statement, behind "async".
/** @param {Token[]} tokens */
export const word = ([first, second]) => (first.text === "async" && second ? second.text : first.text);

const outside = (tokens) => tokens.filter((token) => !token.opener && !["open", "close"].includes(token.kind));
const endsWith = (tokens, text) => tokens.length > 1 && tokens[tokens.length - 1].text === text;

function begins(token) {
  return Boolean(token) && (["name", "number", "string"].includes(token.kind)
    || [...VALUES, "lambda"].includes(token.text));
}

// Returns the first mistake of a statement, or null.
/** @param {Token[]} tokens @returns {Problem | null} */
export function statementProblem(tokens) {
  for (const rule of RULES) {
    const [text, token = tokens[0]] = rule(tokens) || [];
    if (text) return problem(text, token.line);
  }
  return null;
}

// Each returns a sentence, and the token that it is about if that is not the first, or nothing.
/** @type {((tokens: any) => any[] | false | undefined | null)[]} */
const RULES = [
  ([first, second]) => first.text === "print" && begins(second) && [t("print needs brackets: print(...)")],
  ([first, second]) => first.text === "else" && second?.text === "if"
    && [t("Python has no “{name}”: use {text}.", { name: "else if", text: "elif" })],
  (tokens) => tokens[0].text === "else" && tokens[1]?.text !== ":" && colon(tokens)
    && [t("“else” has no condition: delete it, or use elif.")],
  ([first]) => ["/", "//"].includes(first.text) && [t("A comment begins with #")],
  misspelled,
  (tokens) => tokens[0].text === "match" && tokens.length > 2 && endsWith(tokens, ":")
    && [t("The page's Python has no “match”: use if and elif.")],
  keywordAsName,
  equals,
  (tokens) => word(tokens) === "for" && !outside(tokens).some(({ text }) => text === "in")
    && [t("“for” needs “in”: for i in range(10):")],
  ([first, second, third]) => first.text === "def" && second?.kind === "name" && !["(", "["].includes(third?.text)
    && [t("A function needs brackets after its name: def {text}():", second)],
  (tokens) => BLOCKS.includes(word(tokens)) && !colon(tokens)
    && [t("A colon is missing: a line with “{text}” ends with :", { text: word(tokens) })],
  (tokens) => pairs(tokens, increment),
  (tokens) => pairs(tokens, gap),
];

// Finds a statement that begins with a name where only a keyword can be: "If x:", "improt math".
function misspelled(tokens) {
  const [{ kind, text: name }, second] = tokens;
  if (kind !== "name" || SOFT.includes(name) || !(begins(second) || endsWith(tokens, ":"))) return null;
  if (DECLARES.includes(name)) return [t("Python has no “{name}”: delete it.", { name })];
  const text = MEANT[name] ?? near(name, STARTS);
  return text && [t("“{name}” is not known here. Do you mean {text}?", { name, text })];
}

function keywordAsName(tokens) {
  const index = tokens.findIndex(({ kind, text }, at) => kind === "keyword" && !VALUES.includes(text)
    && (tokens[at + 1]?.text === "=" || ["def", "class"].includes(tokens[at - 1]?.text)));
  return index >= 0 && [t("“{text}” is a word of Python: choose another name.", tokens[index]), tokens[index]];
}

function equals(tokens) {
  if (!["if", "elif", "while"].includes(word(tokens)) || tokens.some(({ text }) => text === "lambda")) return null;
  const condition = tokens.slice(0, tokens.indexOf(colon(tokens) ?? tokens[tokens.length - 1]));
  const sign = condition.find(({ text, opener }) => text === "=" && !opener?.call);
  return sign && [t("= gives a value to a name; == compares two values."), sign];
}

// Returns the colon after which the block begins.
function colon(tokens) {
  let lambdas = 0;
  return outside(tokens).find(({ text }) => {
    if (text === "lambda") lambdas += 1;
    return text === ":" && (lambdas -= 1) < 0;
  });
}

// Returns what a rule says of the first two tokens that cannot be beside each other.
function pairs(tokens, rule) {
  for (const [index, token] of [...tokens, undefined].entries()) {
    const text = rule(tokens[index - 1], token, tokens, index);
    if (text) return [text, tokens[index - 1] ?? token];
  }
  return null;
}

// Finds "x++".
function increment(before, token, tokens, index) {
  const sign = before?.text;
  return ["+", "-"].includes(sign) && tokens[index - 2]?.text === sign && ends(tokens[index - 3])
    && (!token || STOPS.includes(token.text)) && t("Python has no “{name}”: use {text}.",
                                                  { name: sign + sign, text: `${sign}= 1` });
}

function gap(before, token, tokens, index) {
  const strings = before?.kind === "string" && token?.kind === "string";
  if (ends(before) && before.text !== "..." && begins(token) && !strings) {
    const values = { name: before.text, text: token.text };
    return !(index === 1 && SOFT.includes(before.text))
      && t("Something is missing between “{name}” and “{text}”: perhaps a comma, +, or quotation marks.", values);
  }
  if (lacksRight(before, token, tokens[index - 2])) return t("Something is missing after “{text}”.", before);
  return lacksLeft(before, token) && t("Something is missing before “{text}”.", token);
}

// "*" and "/" divide the parameters of a function; "import *" is Python, too.
const lacksRight = (sign, token, before) => sign && !ends(sign) && OPERATORS.includes(sign.text)
  && (token ? STOPS.includes(token.text) && !["*", "/"].includes(sign.text) : before?.text !== "import");

// "x, = y", "for x, in y", "not in" and "@" before a function are Python.
const lacksLeft = (before, token) => BINARY.includes(token?.text) && !ends(before)
  && !(before?.text === "," && ["=", "in", "/"].includes(token.text))
  && !(before?.text === "not" && token.text === "in") && !(token.text === "@" && !before);
