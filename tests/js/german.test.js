// A page in German: what comes from the cockpit is translated by its template, and numbers have a comma.

import assert from "node:assert/strict";
import { test } from "node:test";

const GERMAN = {
  "stopped: {cause}": "steht: {cause}", "no command for {seconds} s": "kein Befehl seit {seconds} s", driving: "fährt",
  "its battery is empty ({voltage} V)": "der Akku ist leer ({voltage} V)", "pupil {number}": "Schüler {number}",
  "{count} points": "{count} Punkt|{count} Punkte",
  "{driver} drives {robot}.": "{robot} wird von {driver} gefahren.",
  "{count} robots are running.": "{count} Roboter laufen.", "{seconds} s": "{seconds} Sek.", Speed: ["Tempo"],
};
Object.assign(globalThis, {
  document: { body: {}, documentElement: { querySelectorAll: () => [] } },
  fetch: async () => ({ json: async () => GERMAN }),
});
Object.defineProperty(globalThis, "navigator", { value: { languages: ["nl-NL", "de-AT", "en"] },
  configurable: true });

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

test("who has typed no name is named in German, and a name that was typed stays", () => {
  const drives = (driver) => t("{driver} drives {robot}.", { driver, robot: "red" });
  const named = { code: "pupil", text: "pupil 7", template: "pupil {number}", arguments: { number: "7" } };
  assert.equal(drives(named), "red wird von Schüler 7 gefahren.");
  assert.equal(drives("pupil 7"), "red wird von pupil 7 gefahren.");
});

for (const name of ["driver", "name", "text"]) {
  test(`the ${name} that a person typed stays as it is, also 7.1`, () => {
    assert.equal(t(`{${name}} 7.1`, { [name]: "7.1" }), "7.1 7.1");
  });
}

const EMPTY = { code: "empty", template: "its battery is empty ({voltage} V)", arguments: { voltage: "7.1" } };
const NEW = { code: "new", template: "it {does} this", arguments: { does: "hears" } };
const DRIVING = { status: "in English", state: "driving", cause: "", template: "", arguments: {}, remarks: [] };
const NO_COMMAND = { cause: "no_command", template: "no command for {seconds} s", arguments: { seconds: "1.0" } };
const STOPPED = { ...DRIVING, state: "stopped", ...NO_COMMAND };
const STATUSES = [
  [DRIVING, "fährt"], [{ ...DRIVING, remarks: [EMPTY, NEW] }, "fährt, der Akku ist leer (7,1 V), it hears this"],
  [STOPPED, "steht: kein Befehl seit 1,0 s"],
  [{ ...STOPPED, remarks: [EMPTY] }, "steht: kein Befehl seit 1,0 s, der Akku ist leer (7,1 V)"],
  [{ ...STOPPED, remarks: null }, "in English"], [{ ...DRIVING, remarks: null }, "in English"],
  [{ ...STOPPED, template: "", arguments: {} }, "in English"], [{ ...DRIVING, state: "" }, "in English"],
];

for (const [robot, text] of STATUSES) {
  const { state, cause, template, remarks } = robot;
  test(`a robot ${JSON.stringify({ state, cause, template, remarks })} is described as: ${text}`, () => {
    assert.equal(inWords(robot), text);
  });
}

test("how many points there are chooses the form", () => {
  const points = ["1", "1.0", "0.5", "87.3"].map((count) => t("{count} points", { count }));
  assert.deepEqual(points, ["1 Punkt", "1,0 Punkte", "0,5 Punkte", "87,3 Punkte"]);
});

test("numbers have a comma", () => {
  assert.deepEqual([signed(-0.4), inSeconds(12.34)], ["−0,40", "12,3 Sek."]);
});

test("a sentence without translation is English, whatever it is", () => {
  assert.deepEqual(["No robot", "constructor", "Speed"].map((english) => t(english)),
                   ["No robot", "constructor", "Speed"]);
});

test("a page of which no language is asked is in English", async () => {
  const { languages } = navigator;
  Object.defineProperty(globalThis, "navigator", { value: {}, configurable: true });
  assert.equal((await import("#www/language.js?none")).language, "en");
  Object.defineProperty(globalThis, "navigator", { value: { languages }, configurable: true });
});

for (const content of [null, "", 7, {}]) {
  test(`a page whose words are ${JSON.stringify(content)} is in English, and says so`, async () => {
    globalThis.fetch = async () => ({ json: async () => content });
    const page = await import(`#www/language.js?${JSON.stringify(content)}`);
    assert.deepEqual([page.t("driving"), document.documentElement.lang], ["driving", "en"]);
  });
}
