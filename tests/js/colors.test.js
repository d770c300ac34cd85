// The robots' colours on the page.

import assert from "node:assert/strict";
import { test } from "node:test";

import { restyle } from "./dom.js";

const { visible } = await import("#www/colors.js");

test("a colour that stands out from the ground is shown as it is", () => {
  assert.equal(visible("#0000ff"), "#0000ff");
});

test("a colour that hardly stands out is mixed with the text's until it does", () => {
  const yellow = visible("#ffff00");
  assert.match(yellow, /^#([0-9a-f]{2})\1[0-9a-f]{2}$/);
  assert.ok(parseInt(yellow.slice(1, 3), 16) < 0xb0, yellow);
  assert.ok(parseInt(yellow.slice(1, 3), 16) > 0x60, `${yellow} is still a yellow`);
});

test("on a dark page, dark colours are lightened instead", () => {
  const before = visible("#000080");
  restyle({ "--calm-ground": "#101010", "--text": "#f0f0f0" });
  assert.equal(before, "#000080");
  assert.ok(parseInt(visible("#000080").slice(1, 3), 16) > 0x30);
  assert.equal(visible("#ffff00"), "#ffff00");
});
