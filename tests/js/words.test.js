// Blockly's own words: what its file of a language leaves in English, the page's file of that language translates.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { runInThisContext } from "node:vm";

const MESSAGES = new URL("../../morbot_ws/src/jetbot_cockpit/www/vendor/blockly/msg/", import.meta.url);
const read = (name) => runInThisContext(readFileSync(new URL(name, MESSAGES), "utf8"));

const GERMAN = { "Begin stack": "Beginn des Stapels", "repeat %1 times": "nie", Delete: "Löschen", Del: "Entf" };

// A page in German, as far as a language needs it
Object.defineProperty(globalThis, "navigator", { value: { languages: ["de-AT", "en"] } });
Object.assign(globalThis, {
  Blockly: { Msg: {} },
  document: {
    body: {}, documentElement: { querySelectorAll: () => [] }, createElement: () => ({}),
    head: {
      append(script) {
        read(script.src.split("/").pop());
        queueMicrotask(() => script.onload());
      },
    },
  },
  fetch: async () => ({ json: async () => GERMAN }),
});
read("en.js");

test("a sentence that Blockly's file has is Blockly's, another one ours, and the rest stays English", async () => {
  await import("#www/program/words.js");
  const { Msg } = globalThis.Blockly;
  assert.equal(Msg.CONTROLS_REPEAT_TITLE, "wiederhole %1-mal:");
  assert.equal(Msg.BLOCK_LABEL_BEGIN_STACK, "Beginn des Stapels");
  assert.equal(Msg.BLOCK_LABEL_VALUE, "value");
  assert.equal(Msg.DELETE_KEY, "Entf", "a key is named as it is on the keyboard");
});
