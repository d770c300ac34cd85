// Whatever order the cockpit's messages come in, doubled, late, or of robots that nobody knows: the page shows what the
// last one said, drives nothing by itself, keeps the chosen robot, and STOP works.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Clock } from "./clock.js";
import "./dom.js";
import { FakeSocket } from "./socket.js";
import { stream } from "./stream.js";

const IDS = ["/red", "/blue", "/tom"];
const elements = {};
const socket = () => FakeSocket.all.at(-1);
const press = (id) => elements[id].listeners.pointerdown.forEach((call) => call({ button: 0, timeStamp: 0 }));

// An element that takes whatever is done to it.
function field(id) {
  const nothing = () => {};
  const listeners = {};
  return elements[id] ??= {
    id, listeners, hidden: true, textContent: "", value: "", dataset: {}, classList: { toggle: nothing }, open: false,
    addEventListener: (type, call) => (listeners[type] ??= []).push(call), setAttribute: nothing, focus: nothing,
    replaceChildren: nothing, close: nothing, showModal: nothing, contains: () => true,
  };
}

Object.assign(globalThis, {
  addEventListener() {}, dispatchEvent() {}, history: { state: null, replaceState() {} }, Option: class {},
  location: { protocol: "http:", host: "robot", hash: "" }, localStorage: { getItem: () => null, setItem() {} },
  requestAnimationFrame: (call) => call(),
});
Object.assign(document, { getElementById: field, querySelectorAll: () => [] });
document.documentElement.style = { setProperty() {} };
const { Shell } = await import("#www/shell.js");
document.body = { classList: { toggle() {} } }; // with which the page would have looked for a language

// Returns a page that has just connected.
async function open() {
  for (const id of Object.keys(elements)) delete elements[id];
  const shell = new Shell({ receivers: {}, end() {}, drives: () => false, changed() {}, draw() {} });
  await shell.start();
  socket().open();
  return shell;
}

// Returns a message as the cockpit sends it, of some robots, as it is drawn.
function drawMessage(draw) {
  const one = (...choices) => choices[draw(choices.length)];
  const some = IDS.filter(() => draw(2));
  const robot = one(...IDS);
  const points = Array.from({ length: draw(4) }, () => [draw(9), draw(9)]);
  const state = () => ({
    status: one("driving", "waiting"), state: one("driving", "stopped", ""), cause: one("", "zero", "board", "new one"),
    template: "", arguments: {}, remarks: null, health: null, holds: [], waiting: one([], ["/zigzag"]), fake: false,
    warning: one(true, false), answers: one(true, false), stopped: one(true, false), pose: one(null, [draw(9), 0, 0]),
    speed: null, command: null, wheels: null, program: "", driver: one(null, { id: draw(3), name: "Ada" }),
    resumes: null, held: one(null, "robot", "programs"), stalls: 0, task: null, pictures: null, link: null, programs: 1,
  });
  return one(
    () => ({ type: "hello", id: 1, name: "Bob", role: one("pupil", "teacher"), robot: null, codes: false,
      limits: { trail: 3, trail_step: 0.01 } }),
    () => ({ type: "robots", robots: some.map((id) => ({ id, label: id.slice(1), color: "#808080" })) }),
    () => ({ type: "state", emergency: one(true, false), unconfirmed: one([], [robot]), pupils_release: true,
      robots: Object.fromEntries(some.map((id) => [id, state()])) }),
    () => ({ type: "trail", robot, start: one(null, [0, 0, 0]), points }),
    () => ({ type: "scene", robot, shapes: [{ kind: one("course", "goal", "new one"), width: 0.1, points }] }),
    () => ({ type: "notice", code: one("", "driven", "new one"), text: "in English", arguments: {} }),
    () => ({ type: "new one", robot }),
  )();
}

// Lets a message come, and checks what a person has then. last: the messages that came last, by their type.
function check(shell, message, last, chosen) {
  socket().receive(JSON.stringify(message));
  const { world } = shell;
  if (message.type === "hello") last.robots = null; // all is sent again
  last[message.type] = message;
  assert.ok(world.chosen === chosen || chosen === null, "the chosen robot stays");
  assert.deepEqual(world.robots, last.robots?.robots ?? []);
  assert.equal(world.emergency, last.state?.emergency ?? false);
  for (const id of IDS) assert.equal(world.state(id).status, last.state?.robots[id]?.status ?? "");
  assert.match(elements.sentence.textContent, /^(?!.*(undefined|null|NaN|\{|\[object)).+/, "the status is a sentence");
  assert.ok(elements.robot.disabled !== undefined || !last.robots, "robots are offered");
  const { sent } = socket();
  assert.deepEqual(sent.filter(({ type }) => type !== "ping"), [], "nothing is driven");
  press("stop");
  assert.deepEqual(sent.pop(), { type: "stop", robot: null });
  return world.chosen;
}

test("messages in any order, doubled, late, and of unknown robots leave a page that is right and stops", async (t) => {
  for (let seed = 1; seed <= 60; seed += 1) {
    t.mock.restoreAll(); // the clock of the page before
    const clock = new Clock(t);
    const random = stream(seed);
    const draw = (below) => Math.floor(random() * below);
    const [shell, last, earlier] = [await open(), {}, []];
    let chosen = null;
    for (let step = 0; step < 40; step += 1) {
      const message = draw(4) ? drawMessage(draw) : earlier[draw(earlier.length)] ?? drawMessage(draw);
      earlier.push(message);
      try {
        chosen = check(shell, message, last, chosen);
      } catch (error) {
        assert.fail(`seed ${seed}, step ${step}, ${JSON.stringify(message)}: ${error.stack}`);
      }
      if (draw(10)) continue;
      socket().close();
      await clock.pass(2250);
      socket().open();
    }
  }
});
