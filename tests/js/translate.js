// Reads programs, an object of JSON, null for the examples; writes what the page does with each, and its Python.

import { readFileSync } from "node:fs";

import { write } from "./blockly.js";
import { interpret } from "./programs.js";

const { EXAMPLES } = await import("#www/program/examples.js");
const examples = () => Object.entries(EXAMPLES).map(([name, text]) => [name, JSON.parse(text)]);
const given = JSON.parse(readFileSync(0, "utf8"));
const programs = given ? Object.entries(given) : examples();
const translated = programs.map(([name, json]) => [name, { ...interpret(json), python: write(json).text }]);
console.log(JSON.stringify(Object.fromEntries(translated)));
