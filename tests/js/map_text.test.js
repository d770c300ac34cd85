// The map's text for a screen reader: it is true, and does not change all the time.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Clock } from "./clock.js";
import "./dom.js";

import { MapText } from "#www/map_text.js";
import { World } from "#www/world.js";

test("the map's text is set at most once a second, only if it has changed, and is not known without a connection",
  async (t) => {
    const [clock, world, texts] = [new Clock(t), new World(), []];
    let lost = false;
    const map = new MapText({ setAttribute: (_, text) => texts.push(text) }, world, () => lost);
    const show = (x) => {
      world.states = { "/red": { ...world.state(null), programs: 0, pose: [x, 0, 0] } };
      map.show();
    };
    Object.assign(world, { chosen: "/red", starts: new Map([["/red", [0, 0, 0]]]) });
    for (const x of [0, 0.1, 0.2]) show(x);
    assert.deepEqual(texts, ["Map from above. The robot is at its start. It faces ahead."]);
    for (const x of [0.3, 0.31, 0.4]) {
      await clock.pass(1000);
      show(x);
    }
    assert.deepEqual(texts.slice(1).map((text) => text.match(/[\d.]+ m/)?.[0]), ["0.3 m", "0.4 m"]);
    await clock.pass(1000);
    lost = true;
    show(0.4);
    assert.equal(texts.at(-1), "Map from above. The robot's place is not known.");
  });
