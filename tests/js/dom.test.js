// Numbers and times as the page shows them.

import assert from "node:assert/strict";
import { test } from "node:test";

import { inSeconds, onSurePress, signed } from "#www/dom.js";

import { Clock } from "./clock.js";

test("a number has two places, a real minus, and no negative zero", () => {
  assert.deepEqual([0.5, -0.256, -0.001, 0].map(signed), ["0.50", "−0.26", "0.00", "0.00"]);
});

test("a time has its unit, and is nothing where it is not known", () => {
  assert.deepEqual([12.34, 0, null].map(inSeconds), ["12.3 s", "0.0 s", ""]);
});

// A button that asks "Sure?" before it does something; press() is a click by the keyboard.
function sureButton() {
  const button = Object.assign(new EventTarget(), { textContent: "Delete", done: 0 });
  button.takeBack = onSurePress(button, "Sure?", () => { button.done += 1; });
  button.press = () => button.dispatchEvent(new Event("click"));
  return button;
}

test("what needs two presses is done at the second one, and asks at the first", (t) => {
  new Clock(t);
  const button = sureButton();
  button.press();
  assert.deepEqual([button.textContent, button.done], ["Sure?", 0]);
  button.press();
  assert.deepEqual([button.textContent, button.done], ["Delete", 1]);
  button.press();
  assert.equal(button.done, 1, "each time");
});

test("a question is over after a while, or when it is taken back", async (t) => {
  const [clock, button] = [new Clock(t), sureButton()];
  for (const over of [() => clock.pass(3000), () => button.takeBack()]) {
    button.press();
    await over();
    assert.equal(button.textContent, "Delete");
    button.press();
    assert.equal(button.done, 0);
    await clock.pass(3000);
  }
});
