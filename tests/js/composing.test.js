// Keys that an input method takes while a person writes, say, Japanese.

import assert from "node:assert/strict";
import { test } from "node:test";

const page = new EventTarget();
globalThis.addEventListener = page.addEventListener.bind(page);
globalThis.HTMLInputElement = class {};

await import("#www/composing.js");
const { Keys } = await import("#www/inputs.js");

const FIELD = Object.assign(new HTMLInputElement(), { type: "text" });
const BUTTON = {};

// Returns how often a press of Escape stops the robots.
function stopsBy(target, marks) {
  let stops = 0;
  new Keys(() => {}, () => { stops += 1; });
  const event = new Event("keydown", { cancelable: true });
  Object.defineProperty(event, "target", { value: target });
  page.dispatchEvent(Object.assign(event, { key: "Escape", code: "Escape", ...marks }));
  return stops;
}

test("Escape that takes a conversion back stops no robot, in WebKit neither", () => {
  for (const marks of [{ isComposing: true }, { keyCode: 229 }]) assert.equal(stopsBy(FIELD, marks), 0);
});

test("Escape stops the robots while a person types, and an input method is no obstacle where nobody does", () => {
  assert.equal(stopsBy(FIELD, { keyCode: 27 }), 1);
  assert.equal(stopsBy(BUTTON, { keyCode: 229 }), 1);
});
