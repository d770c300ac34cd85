// What a key does, by what has the focus, and whether an input method takes it.

import assert from "node:assert/strict";
import { test } from "node:test";

const page = new EventTarget();
globalThis.addEventListener = page.addEventListener.bind(page);
globalThis.HTMLInputElement = class {
  type = "text";
};

await import("#www/composing.js");
const { Keys } = await import("#www/inputs.js");

const FIELD = new HTMLInputElement();
const BUTTON = { matches: () => false };
const SCROLLER = { matches: (selector) => selector.includes(".scrolls") };

let [padIsSeen, done] = [true, { stops: 0, drives: [] }];
const keys = new Keys({ getClientRects: () => (padIsSeen ? [{}] : []) },
  (...command) => done.drives.push(command), () => { done.stops += 1; });

// Returns what pressing this key does: how often it stops, what it drives, and whether the browser does nothing.
function press(key, target, marks = {}) {
  done = { stops: 0, drives: [] };
  const event = new Event("keydown", { cancelable: true });
  Object.defineProperty(event, "target", { value: target });
  page.dispatchEvent(Object.assign(event, { key, code: key, ...marks }));
  keys.held.clear();
  return { ...done, kept: event.defaultPrevented };
}

test("Escape that takes a conversion back stops no robot, in WebKit neither", () => {
  for (const marks of [{ isComposing: true }, { keyCode: 229 }]) assert.equal(press("Escape", FIELD, marks).stops, 0);
});

test("Escape stops the robots while a person types, and an input method is no obstacle where nobody does", () => {
  assert.equal(press("Escape", FIELD, { keyCode: 27 }).stops, 1);
  assert.equal(press("Escape", BUTTON, { keyCode: 229 }).stops, 1);
});

test("arrow keys drive, but scroll a text that scrolls; W drives from there, too", () => {
  assert.deepEqual(press("ArrowDown", BUTTON), { stops: 0, drives: [[-1, 0]], kept: true });
  assert.deepEqual(press("ArrowDown", SCROLLER), { stops: 0, drives: [], kept: false });
  assert.deepEqual(press("KeyW", SCROLLER).drives, [[1, 0]]);
});

test("no key drives where the pad is out of sight, but Escape stops", () => {
  padIsSeen = false;
  for (const key of ["ArrowDown", "KeyW"]) assert.deepEqual(press(key, BUTTON), { stops: 0, drives: [], kept: false });
  assert.equal(press("Escape", BUTTON).stops, 1);
});
