// Blockly as its page has it, without the page: import this before what uses it.

import { readFileSync } from "node:fs";
import { runInThisContext } from "node:vm";

import { WORKSHOP } from "./programs.js";

const FOLDER = new URL("../../morbot_ws/src/jetbot_cockpit/www/vendor/blockly/", import.meta.url);
for (const name of ["blockly_compressed", "blocks_compressed", "python_compressed", "msg/en"]) {
  runInThisContext(readFileSync(new URL(`${name}.js`, FOLDER), "utf8"));
}

// What Blockly needs of XML, in which some blocks describe their parts.
class Element {
  childNodes = [];
  #attributes = new Map();

  constructor(nodeName) {
    this.nodeName = nodeName;
  }

  appendChild(child) {
    this.childNodes.push(child);
  }

  setAttribute(name, value) {
    this.#attributes.set(name, String(value));
  }

  getAttribute(name) {
    return this.#attributes.get(name) ?? null;
  }

  toString() {
    const attributes = Array.from(this.#attributes, ([name, value]) => ` ${name}="${value}"`).join("");
    return `<${this.nodeName}${attributes}>${this.childNodes.join("")}</${this.nodeName}>`;
  }
}

class XMLSerializer {
  serializeToString(element) {
    return String(element);
  }
}

const { Blockly } = globalThis;
Blockly.utils.xml.injectDependencies({
  document: { createElementNS: (_, nodeName) => new Element(nodeName) }, DOMParser: Object, XMLSerializer,
});
Blockly.Events.disable(); // they would write more of it
const { defineBlocks } = await import("#www/program/blocks.js");
const { parseProgram, writeProgram } = await import("#www/program/check.js");
const { prepareGenerator, toPython } = await import("#www/program/python.js");
defineBlocks();
prepareGenerator();

// Returns the Python of a program, as toPython() does.
export function write(program, geometry = WORKSHOP) {
  const workspace = new Blockly.Workspace();
  Blockly.serialization.workspaces.load(program, workspace);
  return toPython(workspace, "my_program", geometry);
}

// Returns the text that the page saves of this program.
export function save(program) {
  const workspace = new Blockly.Workspace();
  Blockly.serialization.workspaces.load(program, workspace);
  return writeProgram(Blockly.serialization.workspaces.save(workspace));
}

// Returns the text that the page saves once it has opened this one.
export const reopen = (text) => save(parseProgram(text));
