// Writes what the page does with texts, which are given by their names as JSON. How long: s of each one's clock

import { readFileSync } from "node:fs";

import { runText } from "./text_engine.js";

const SENSES = { here: { X: 0, Y: 0, HEADING: 0 }, pose: [1, 2, 0], line: [0.25, 0.5, 1], wheels: [0, 0] };
const longest = Number(process.argv[2]);
const done = {};
for (const [name, text] of Object.entries(JSON.parse(readFileSync(0, "utf8")))) {
  done[name] = await runText(text, SENSES, longest);
}
console.log(JSON.stringify(done, (_, value) => (typeof value === "number" ? String(value) : value)));
