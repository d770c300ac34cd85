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
// Words that begin a statement and are nowhere else
const LEADING = ["while", "try", "def", "class", "return", "del", "pass", "break", "continue", "raise", "global",
  "nonlocal", "with", "elif", "except", "finally", "assert"];
const STOPS = [")", "]", "}", ",", ":", ";"];

const RIGHT = [", =", ", in", ", /", "not in", " @"]; // two that can be beside each other
const DOTTED = ["from", ".", "..."]; // what is before the dots of "from . import x"
const EQUALS = t("= gives a value to a name; == compares two values.");

// A text that begins with f: {{ and }}, {x:{y}}, and anything around
const FORMATTED = /^[^"']*(?:[^{}]|\{\{|\}\}|\{(?=\s+\{|\s*[^\s{}:!=])(?:[^{}]|\{[^{}]*\})*\})*$/s;

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
    || [...VALUES, ...LEADING, "lambda"].includes(token.text));
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
  (tokens) => tokens[0].text === "from" && !tokens.some(({ text }) => text === "import")
    && [t("“from” needs “import”: from math import sin")],
  ([first, second, third]) => first.text === "def" && second?.kind === "name" && !["(", "["].includes(third?.text)
    && [t("A function needs brackets after its name: def {text}():", second)],
  (tokens) => BLOCKS.includes(word(tokens)) && !colon(tokens)
    && [t("A colon is missing: a line with “{text}” ends with :", { text: word(tokens) })],
  (tokens) => endsWith(tokens, ":") && ![...BLOCKS, ...SOFT].includes(word(tokens))
    && [t("A line that ends with : begins with a word such as if, while or def.")],
  (tokens) => numbers(tokens),
  braces,
  assigned,
  conditional,
  (tokens) => pairs(tokens, increment),
  (tokens) => pairs(tokens, between),
  (tokens) => pairs(tokens, after),
  (tokens) => pairs(tokens, ahead),
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
  return sign && [EQUALS, sign];
}

// Finds "f(x.y = 1)".
function assigned(tokens) {
  if (word(tokens) === "def" || tokens.some(({ text }) => text === "lambda")) return null;
  const sign = tokens.find(({ text, opener }, index) => text === "=" && opener?.call
    && !(tokens[index - 1].kind === "name" && ["(", ","].includes(tokens[index - 2].text)));
  return sign && [EQUALS, sign];
}

// Finds "x = 1 if y".
function conditional(tokens) {
  const beside = (at, other) => tokens.some(({ text, opener }) => text === other && opener === tokens[at].opener);
  const index = tokens.findIndex(({ text }, at) => text === "if" && at > 0 && !beside(at, "else")
    && !beside(at, "for") && !SOFT.includes(tokens[0].text));
  return index > 0 && [t("“if” inside a line needs “else”: x = 1 if a else 2"), tokens[index]];
}

function numbers(tokens) {
  const number = tokens.find(({ kind, text }) => kind === "number" && /^0[\d_]*[1-9][\d_]*$/.test(text));
  return number && [t("Python cannot read this number."), number];
}

// Finds f"{x" and f"{}". It looks at no text within the braces.
function braces(tokens) {
  const wrong = tokens.find(({ kind, text }) => kind === "string" && /^r?f/i.test(text) && !FORMATTED.test(text));
  return wrong && [t("In a text that begins with f, each { needs a name and a }: f\"{x}\""), wrong];
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

function between(before, token, tokens, index) {
  const strings = before?.kind === "string" && token?.kind === "string";
  const negated = token?.text === "not" && tokens[index + 1]?.text !== "in";
  if (!ends(before) || before.text === "..." || strings || !(begins(token) || negated)) return "";
  const values = { name: before.text, text: token.text };
  return !(index === 1 && SOFT.includes(before.text))
    && t("Something is missing between “{name}” and “{text}”: perhaps a comma, +, or quotation marks.", values);
}

// "*" and "/" divide the parameters of a function; "import *" is Python, too.
function after(sign, token, tokens, index) {
  const before = tokens[index - 2]?.text;
  const open = OPERATORS.includes(sign?.text) && !ends(sign)
    && (token ? STOPS.includes(token.text) && !["*", "/"].includes(sign.text) : before !== "import");
  return (open || lacksPart(sign, token, before)) && t("Something is missing after “{text}”.", sign);
}

// Finds "x.", and {"a": }.
const lacksPart = (sign, token, before) => (sign?.text === "." && token?.kind !== "name" && !DOTTED.includes(before))
  || (sign?.text === ":" && sign.opener?.text === "{" && [",", "}"].includes(token?.text));

// "x, = y", "for x, in y", "not in" and "@" before a function are Python.
function ahead(before, token) {
  const sign = token?.text;
  if (ends(before) || !(BINARY.includes(sign) || [".", ","].includes(sign))) return "";
  const right = sign === "," ? before && !["open", "keyword"].includes(before.kind) && before.text !== ","
    : sign === "." ? DOTTED.includes(before?.text) : RIGHT.includes(`${before?.text ?? ""} ${sign}`);
  return !right && t("Something is missing before “{text}”.", token);
}
