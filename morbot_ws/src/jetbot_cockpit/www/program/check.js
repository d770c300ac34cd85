// The text of a program: written as it is saved, and checked when it comes from elsewhere, before Blockly sees it.

import { t } from "../language.js";
import { toText } from "../storage.js";
import { TYPES } from "./semantics.js";

const MAX_SIZE = 512 * 1024; // characters
const MAX_BLOCKS = 2000;
const MAX_NESTING = 60; // blocks in blocks; those below each other do not count
const MAX_PARTS = 50; // branches of an if, parts of a text
const MAX_TYPE = 40; // characters of a block's type that are shown
export const NO_PROGRAM = t("This file is no program of this page.");
const TWO_VARIABLES = t("Two variables of this program have the same name.");
const TWO_FUNCTIONS = t("Two functions of this program have the same name.");
// A program without blocks
export const EMPTY =
  '{"blocks":{"languageVersion":0,"blocks":[{"type":"robot_start","x":30,"y":30}]},"variables":[]}';
const BLOCK_KEYS = ["type", "id", "x", "y", "inline", "fields", "inputs", "next", "extraState"];
const MADE_ANEW = ["id", "deletable", "disabledReasons"]; // of each block, whenever it is shown

// Why a program is refused, in a sentence for the person.
export class Refusal extends Error {}

// Returns the text of a program of Blockly, with its Python if it is a text. Opened and saved again, it is the same.
export function writeProgram(program) {
  return JSON.stringify(program, leaveOut);
}

/** @this {any} */
function leaveOut(key, value) { // a variable keeps its id
  return this.type && MADE_ANEW.includes(key) ? undefined : value;
}

// Returns the text of a program that is this Python.
export function withPython(python) {
  return JSON.stringify({ ...JSON.parse(EMPTY), python });
}

// Returns the program, with what this page knows of it alone; throws a Refusal.
export function parseProgram(file) {
  if (file.length > MAX_SIZE) {
    throw new Refusal(t("This file is too large: a program has {most} kB at most.", { most: MAX_SIZE / 1024 }));
  }
  try {
    const { blocks: { blocks }, variables = [], python } = JSON.parse(file);
    const functions = blocks.filter(({ type }) => type.startsWith("procedures_def"));
    checkNames(TWO_VARIABLES, variables.map(({ name }) => name));
    checkNames(TWO_FUNCTIONS, functions.map(({ fields }) => fields.NAME));
    return {
      blocks: { languageVersion: 0, blocks: checkBlocks(blocks) },
      variables: checkVariables(variables),
      ...python !== undefined && { python: toLines(python) },
    };
  } catch (error) { // what is of another form causes a TypeError
    throw error instanceof Refusal ? error : new Refusal(NO_PROGRAM);
  }
}

// Returns why this text could not be opened again, or "".
export function problemOf(text) {
  try {
    parseProgram(text);
  } catch (error) {
    return error.message;
  }
  return "";
}

// Blockly gives no two the same name, and takes capitals for small letters.
function checkNames(problem, names) {
  const all = names.map((name) => text(name).trim().toLowerCase());
  need(!all.includes(""));
  if (new Set(all).size < all.length) throw new Refusal(problem);
}

function checkVariables(variables) {
  if (variables.length > MAX_BLOCKS) {
    throw new Refusal(t("This program has more than {most} variables.", { most: MAX_BLOCKS }));
  }
  return variables.map(({ name, id }) => ({ name: text(name), id: text(id) }));
}

// Goes from block to block in a list, not by recursion: what is nested deep ends no page.
function checkBlocks(tops) {
  const checked = [];
  const todo = tops.map((block, index) => ({ block, depth: 0, put: (copy) => { checked[index] = copy; } }));
  for (let count = 0; todo.length; count += 1) {
    if (count >= MAX_BLOCKS) throw new Refusal(t("This program has more than {most} blocks.", { most: MAX_BLOCKS }));
    const { block, depth, put } = todo.pop();
    if (depth > MAX_NESTING) {
      throw new Refusal(t("This program nests more than {most} blocks in each other.", { most: MAX_NESTING }));
    }
    const { inputs, next, ...own } = checkBlock(block);
    put(own);
    if (next) todo.push({ block: next.block, depth, put: (copy) => { own.next = { block: copy }; } });
    if (inputs) own.inputs = {};
    for (const [name, input] of Object.entries(inputs ?? {})) {
      const filled = own.inputs[text(name)] = {};
      for (const kind of ["block", "shadow"]) {
        if (input?.[kind]) todo.push({ block: input[kind], depth: depth + 1, put: (copy) => { filled[kind] = copy; } });
      }
    }
  }
  return checked;
}

function checkBlock(block) {
  const { type } = block;
  if (!TYPES.has(type)) {
    throw new Refusal(t("This page does not know the block {type}.", { type: text(type).slice(0, MAX_TYPE) }));
  }
  const known = Object.fromEntries(BLOCK_KEYS.filter((key) => key in block).map((key) => [key, block[key]]));
  for (const key of ["fields", "extraState"].filter((each) => each in known)) known[key] = copy(known[key]);
  const isXml = typeof known.extraState === "string"; // it says what fields say, except of a return
  if (isXml && type !== "procedures_ifreturn") delete known.extraState;
  const { elseIfCount, itemCount, params } = known.extraState ?? {};
  const isLarge = [elseIfCount, itemCount, params?.length].some((parts) => parts > MAX_PARTS);
  if (isLarge) throw new Refusal(t("This program has a block with more than {most} parts.", { most: MAX_PARTS }));
  if ("id" in known) known.id = text(known.id);
  if ("inline" in known) need(typeof known.inline === "boolean");
  for (const key of ["x", "y"]) if (key in known) known[key] = Math.max(-1e5, Math.min(1e5, Number(known[key]) || 0));
  return known;
}

function copy(value) {
  return JSON.parse(JSON.stringify(value), (_, each) => (typeof each === "string" ? text(each) : each));
}

function text(value) {
  need(typeof value === "string");
  return toText(value);
}

// Returns a text of several lines without what is harmful where it is shown.
export function toLines(lines) {
  need(typeof lines === "string");
  return lines.replace(/\r\n?/g, "\n").replace(/[^\n\t]+/g, toText);
}

function need(condition) {
  if (!condition) throw new Refusal(NO_PROGRAM);
}
