// The page in the person's language. English is the key: what has no translation is shown in English.

import { recall } from "./storage.js";

export const LANGUAGES = {
  en: "English", de: "Deutsch", es: "Español", fr: "Français", it: "Italiano", ja: "日本語",
};
export const WORDS_TIMEOUT = 4000; // ms: a page without its words is in English, but stops robots
const ATTRIBUTES = ["title", "aria-label", "aria-roledescription", "placeholder"];
const WORDS = /\S(?:.*\S)?/s; // of an element, without the space around them
const TYPED = ["driver", "name", "text"]; // values that a person may have typed
const DECIMAL = /^([-−]?\d+)\.(\d+)$/;

const page = globalThis.document?.body; // none in a test without a browser
export const language = page ? choose() : "en";
const sentences = new Map(language === "en" ? [] : await load());
const [whole, decimal] = [0, 1].map((digits) => new Intl.PluralRules(language, { minimumFractionDigits: digits }));
const [, mark] = new Intl.NumberFormat(language).formatToParts(0.5);
if (page) translate(document.documentElement);

// The one that was chosen here, else the first that the browser asks for; some ask for none.
function choose() {
  const wanted = [recall("language"), ...(navigator.languages ?? []).map((each) => each.split("-")[0])];
  return wanted.find((each) => Object.hasOwn(LANGUAGES, each)) ?? "en";
}

// Returns what the file has in order: whoever corrects a sentence may break another one.
async function load() {
  try {
    const signal = AbortSignal.timeout?.(WORDS_TIMEOUT);
    const file = await fetch(new URL(`languages/${language}.json`, import.meta.url), { signal });
    return Object.entries(await file.json()).filter(([, text]) => typeof text === "string");
  } catch {
    return [];
  }
}

// Returns the sentence in the page's language, with values in place of its {names}. Of "{count} robot|{count} robots",
// values.count chooses the form.
/** @param {string} english @param {Record<string, unknown>} values */
export function t(english, values = {}) {
  const [one, other = one] = (sentences.get(english) ?? english).split("|");
  const form = isOne(values.count ?? 1) ? one : other;
  return form.replace(/\{(\w+)\}/g, (name, key) => (Object.hasOwn(values, key) ? written(key, values[key]) : name));
}

// Whether this number takes the first of two forms: 1 does, but "1.0" not in each language.
function isOne(count) {
  return (String(count).includes(".") ? decimal : whole).select(Number(count)) === "one";
}

// Returns a value of a sentence, which may itself be one of the cockpit's. What was typed is quoted as it is.
function written(name, value) {
  if (value instanceof Object) return said(value);
  return TYPED.includes(name) ? value : number(value);
}

// Returns what a message says: that of the cockpit has its English as a template, too.
/** @param {{ text: string, template?: string, arguments?: Record<string, unknown> }} message */
export function said({ text, template, arguments: values }) {
  return template ? t(template, values) : text;
}

// Returns a number with the language's decimal mark, and another text as it is.
export function number(value) {
  return String(value).replace(DECIMAL, `$1${mark.value}$2`);
}

// Translates the texts of the page, once.
function translate(root) {
  root.lang = sentences.size ? language : "en";
  for (const each of root.querySelectorAll("*")) {
    for (const name of ATTRIBUTES) if (each.hasAttribute(name)) each.setAttribute(name, t(each.getAttribute(name)));
    for (const child of each.childNodes) if (child instanceof Text) child.data = child.data.replace(WORDS, inWords);
  }
}

function inWords(text) {
  return t(text.replace(/\s+/g, " "));
}
