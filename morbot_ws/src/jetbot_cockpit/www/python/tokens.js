// The words and signs of a Python program, and its statements: enough to find what a pupil got wrong.

import { t } from "../language.js";

/** @typedef {{ text: string, line: number }} Problem */
/** @typedef {{ kind: string, text: string, line: number, opener: Token | null, call?: boolean }} Token */
/** @typedef {{ indent: string, line: number, tokens: Token[] }} Statement */

export const KEYWORDS = ("and as assert async await break class continue def del elif else except finally for from "
  + "global if import in is lambda nonlocal not or pass raise return try while with yield").split(" ");
export const VALUES = ["False", "None", "True"];

const { raw } = String;
const PREFIX = "[rbuf]{0,2}";

// The kinds of tokens, in the order in which they are looked for
const KINDS = {
  space: raw`[ \t\f\r\ufeff]+|\\\r?\n|#[^\n]*`, end: raw`\n`,
  string: raw`${PREFIX}(?:"""(?:[^\\]|\\.)*?"""|'''(?:[^\\]|\\.)*?'''|"(?!"")(?:[^"\\\n]|\\.)*"`
    + raw`|'(?!'')(?:[^'\\\n]|\\.)*')`,
  unclosed: `${PREFIX}(?:"""|'''|"|')`,
  number: raw`(?:0[xbo][\da-f_]+|(?:\d[\d_]*(?:\.[\d_]*)?|\.\d[\d_]*)(?:e[+-]?\d[\d_]*)?j?)(?![\p{L}\d_])`
    + raw`|\d+(?=(?:and|else|for|if|in|is|or)\b)`,
  misnamed: raw`\d[\p{L}\d_]*`, name: raw`[\p{L}_][\p{L}\p{M}\p{N}_]*`, open: raw`[([{]`, close: raw`[)\]}]`,
  foreign: raw`&&|\|\||<>|=>|=<|===|!(?!=)`,
  sign: raw`(?:\*\*|//|>>|<<|[-+*/%@&|^=!<>:])=|->|\.\.\.|\*\*|//|>>|<<|[-+*/%@&|^~<>=.,:;]`, odd: ".",
};
const NAMES = Object.keys(KINDS);
const TOKEN = new RegExp(Object.entries(KINDS).map(([kind, pattern]) => `(?<${kind}>${pattern})`).join("|"), "isuy");

const PAIRS = { "(": ")", "[": "]", "{": "}" };
const FOREIGN = { "&&": "and", "||": "or", "<>": "!=", "=>": ">=", "=<": "<=", "===": "==", "!": "not" };
const PLAIN = {
  __proto__: null,
  "“": '"', "”": '"', "„": '"', "«": '"', "»": '"', "「": '"', "」": '"', "‘": "'", "’": "'", "´": "'",
  "−": "-", "–": "-", "—": "-", "×": "*", "·": "*", "÷": "/", "≤": "<=", "≥": ">=", "≠": "!=", "、": ",", "。": ".",
};

// What no Python has, by the kind of its token
const REFUSED = {
  unclosed: ({ text }) => (text.length > 2
    ? t("The text that begins here is never closed: put {text} at its end.", { text: text.slice(-3) })
    : t("The text that begins here is not closed on its line: put {text} at its end.", { text: text.slice(-1) })),
  misnamed: ({ text }) => t("“{text}” is neither a number nor a name: a name begins with a letter.", { text }),
  foreign: ({ text }) => t("Python has no “{name}”: use {text}.", { name: text, text: FOREIGN[text] }),
  odd({ text: name }) {
    if (/\s/.test(name)) return t("Here is a space of a kind that Python does not know: type it again.");
    const text = PLAIN[name] ?? name.normalize("NFKC");
    return text === name ? t("Python has no “{name}”: delete it.", { name })
      : t("Python has no “{name}”: use {text}.", { name, text });
  },
};

/** @param {string} text @param {number} line @returns {Problem} */
export const problem = (text, line) => ({ text, line });

// Whether a value ends with this token, so that "(" after it calls and "[" takes an item.
export function ends(/** @type {any} */ token) {
  return Boolean(token) && (["name", "number", "string", "close"].includes(token.kind)
    || VALUES.includes(token.text) || token.text === "...");
}

// Returns the statements up to the first thing that is no Python, and what is wrong with that.
/** @param {string} source @returns {{ statements: Statement[], wrong: Problem | null }} */
export function readStatements(source) {
  /** @type {Statement[]} */
  const statements = [];
  const reading = { opener: /** @type {Token | null} */ (null), tokens: /** @type {Token[]} */ ([]), indent: "" };
  for (const token of tokensOf(source)) {
    if (token.kind === "end") {
      if (reading.opener) continue;
      if (reading.tokens.length) statements.push({ indent: reading.indent, ...statement(reading.tokens) });
      Object.assign(reading, { tokens: [], indent: "" });
    } else if (token.kind === "space") {
      if (!reading.tokens.length && /^[ \t]/.test(token.text)) reading.indent += token.text;
    } else {
      const wrong = add(token, reading);
      if (wrong) return { statements, wrong: problem(wrong, token.line) };
    }
  }
  const { opener } = reading;
  const wrong = opener && problem(t("The bracket “{text}” is never closed.", opener), opener.line);
  return { statements, wrong };
}

const statement = (tokens) => ({ tokens, line: tokens[0].line });

function *tokensOf(source) {
  let line = 1;
  TOKEN.lastIndex = 0;
  for (let match; (match = TOKEN.exec(source));) {
    const { 0: text, groups = {} } = match;
    const kind = NAMES.find((each) => groups[each] !== undefined);
    const word = kind === "name" && (KEYWORDS.includes(text) || VALUES.includes(text));
    yield { kind: word ? "keyword" : kind, text, line };
    line += text.split("\n").length - 1;
  }
  yield { kind: "end", text: "", line };
}

// Adds a token to the statement. Returns what is wrong with it, or "".
function add(token, reading) {
  if (REFUSED[token.kind]) return REFUSED[token.kind](token);
  const { opener, tokens } = reading;
  if (token.kind === "close") {
    if (!opener) return t("“{text}” closes no bracket: delete it, or open one before.", token);
    if (PAIRS[opener.text] !== token.text) {
      return t("“{name}” closes the bracket “{text}”: use {other}.",
               { name: token.text, text: opener.text, other: PAIRS[opener.text] });
    }
    reading.opener = opener.opener;
  }
  token.opener = reading.opener;
  if (token.kind === "open") reading.opener = Object.assign(token, { call: ends(tokens.at(-1)) });
  tokens.push(token);
  return "";
}
