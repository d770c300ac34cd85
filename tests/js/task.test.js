// What a page says of a task: the judge's data in the page's language, else the judge's English.

import assert from "node:assert/strict";
import { test } from "node:test";

import { saidOf } from "#www/task.js";

const TURN = "turned {count} degree too far at corner {corner}|turned {count} degrees too far at corner {corner}";
const NOT_COUNTED = { code: "not_counted", template: "The drive does not count.", arguments: {} };
const INVITATION = { code: "drive_metre", template: "Drive when you are ready: 1 m straight ahead.", arguments: {} };
const task = { text: "in English", sentences: [], lost: null };

test("its sentences follow each other", () => {
  assert.equal(saidOf({ ...task, sentences: [NOT_COUNTED, INVITATION] }),
    "The drive does not count. Drive when you are ready: 1 m straight ahead.");
});

for (const [count, degrees] of [["1", "1 degree"], ["8", "8 degrees"]]) {
  test(`what lost most points, with ${degrees}`, () => {
    const loss = { code: "turned_too_far_corner", template: TURN, arguments: { count, corner: "3" } };
    assert.equal(saidOf({ ...task, sentences: [loss], lost: 55 }),
      `Largest loss: turned ${degrees} too far at corner 3 (55.0 points).`);
  });
}

test("a judge that publishes no data is shown in English", () => {
  assert.equal(saidOf({ ...task, lost: 55 }), "in English");
});
