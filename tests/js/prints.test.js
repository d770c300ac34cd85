// What a program prints is shown at once, and said no faster than it can be heard.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Clock } from "./clock.js";

class List {
  children = [];
  said = []; // all that was ever added

  append(child) {
    this.children.push(child);
    this.said.push(child.textContent);
    child.remove = () => this.children.splice(this.children.indexOf(child), 1);
  }

  replaceChildren() {
    this.children = [];
  }

  get childElementCount() {
    return this.children.length;
  }

  get firstChild() {
    return this.children[0];
  }
}

const elements = {};
globalThis.document = { getElementById: (id) => elements[id], createElement: () => ({}) };
const { clearPrints, print } = await import("#www/program/prints.js");

beforeEach(() => {
  Object.assign(elements, { prints: new List(), said: new List() });
  clearPrints();
});

test("each line is said, and lines of one moment together", async (t) => {
  const clock = new Clock(t);
  for (const line of ["one", "two", "three"]) print(line);
  await clock.pass(100);
  assert.deepEqual(elements.said.said, ["one\ntwo\nthree"]);
  await clock.pass(5000);
  print("four");
  await clock.pass(100);
  assert.deepEqual(elements.said.said, ["one\ntwo\nthree", "four"]);
  await clock.pass(5000);
});

test("of a flood only the newest is said, as fast as it is read, and nothing of a program before", async (t) => {
  const clock = new Clock(t);
  for (let line = 0; line < 1000; line += 1) {
    print(`line ${line}`);
    await clock.pass(10);
  }
  assert.equal(elements.prints.children.length, 200);
  assert.ok(elements.said.said.length < 8, `${elements.said.said.length} times in 10 s`);
  assert.ok(elements.said.said.every((text) => text.split("\n").length <= 5 && text.length <= 100));
  clearPrints();
  const before = elements.said.said.length;
  await clock.pass(20000);
  assert.equal(elements.said.said.length, before);
});
