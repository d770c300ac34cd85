// A browser that asks for no language.

import assert from "node:assert/strict";
import { test } from "node:test";

Object.assign(globalThis, { document: { body: {}, documentElement: { querySelectorAll: () => [] } } });
Object.defineProperty(globalThis, "navigator", { value: {} });

test("a page of which no language is asked is in English", async () => {
  assert.equal((await import("#www/language.js")).language, "en");
});
