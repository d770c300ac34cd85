// A page in German: what comes from the cockpit is translated by its template, and numbers have a comma.

import assert from "node:assert/strict";
import { test } from "node:test";

const GERMAN = {
  "stopped: {cause}": "steht: {cause}", "no command for {seconds} s": "kein Befehl seit {seconds} s", driving: "fährt",
  "{driver} drives {robot}.": "{robot} wird von {driver} gefahren.",
  "{count} robots are running.": "{count} Roboter laufen.",
};
Object.assign(globalThis, {
  document: { body: {}, documentElement: { querySelectorAll: () => [] } },
  fetch: async () => ({ json: async () => GERMAN }),
});
Object.defineProperty(globalThis, "navigator", { value: { languages: ["nl-NL", "de-AT", "en"] } });

const { inWords } = await import("#www/causes.js");
const { inSeconds, signed } = await import("#www/dom.js");
const { language, said, t } = await import("#www/language.js");

test("the language is the first of the browser's that there is", () => {
  assert.equal(language, "de");
});

test("a message is translated by its template, and is English where there is none", () => {
  const message = { text: "Ada drives red.", arguments: { driver: "Ada", robot: "red" } };
  assert.equal(said({ ...message, template: "{driver} drives {robot}." }), "red wird von Ada gefahren.");
  assert.equal(said(message), "Ada drives red.");
});

test("what is said of a robot besides why it is stopped stays in English", () => {
  const cause = { template: "no command for {seconds} s", arguments: { seconds: "1.0" } };
  const robot = { state: "stopped", cause: "no_command", ...cause };
  const status = "stopped: no command for 1.0 s";
  assert.equal(inWords({ ...robot, status }), "steht: kein Befehl seit 1,0 s");
  assert.equal(inWords({ ...robot, status: `${status}, 7.1 V` }), "steht: kein Befehl seit 1,0 s, 7.1 V");
  assert.equal(inWords({ ...robot, status: "another sentence" }), "another sentence");
  assert.equal(inWords({ state: "driving", cause: "", status: "driving, 7.1 V" }), "fährt, 7.1 V");
});

test("numbers have a comma", () => {
  assert.deepEqual([signed(-0.4), inSeconds(12.34)], ["−0,40", "12,3 s"]);
});

test("a sentence without translation is English, whatever it is", () => {
  assert.deepEqual(["No robot", "constructor"].map((english) => t(english)), ["No robot", "constructor"]);
});
