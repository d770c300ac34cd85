// What the sheet with the programs says of an empty list.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./dom.js";
import { Shelf } from "#www/program/shelf.js";

// Returns the sheet, on a page on which nothing has the focus.
function openShelf() {
  const nothing = { closest: () => null, parentElement: { children: [] }, addEventListener() {}, replaceChildren() {} };
  for (const id of ["work", "programs", "close-work", "work-list"]) Object.assign(document.getElementById(id), nothing);
  Object.assign(globalThis, { addEventListener() {} });
  Object.assign(document, { activeElement: nothing });
  return new Shelf({});
}

test("that there are no programs is said once the cockpit has listed none", () => {
  const [shelf, sentence] = [openShelf(), document.getElementById("no-programs")];
  shelf.show();
  assert.equal(sentence.hidden, true);
  shelf.list([]);
  shelf.show();
  assert.equal(sentence.hidden, false);
});
