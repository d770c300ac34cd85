// A browser that asks for no language, and a language whose file has been edited wrongly.

import assert from "node:assert/strict";
import { test } from "node:test";

Object.assign(globalThis, {
  document: { body: {}, documentElement: { querySelectorAll: () => [] } },
  fetch: async () => ({ json: async () => null }),
});

function ask(navigator) {
  Object.defineProperty(globalThis, "navigator", { value: navigator, configurable: true });
}

test("a page of which no language is asked is in English", async () => {
  ask({});
  assert.equal((await import("#www/language.js")).language, "en");
});

test("a page whose file of a language is no list of sentences is in English", async () => {
  ask({ languages: ["de"] });
  const { t } = await import("#www/language.js?again");
  assert.equal(t("Release"), "Release");
});
