// Which part of the floor the map shows.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Viewport } from "#www/viewport.js";

// Returns a map of 400 x 300 pixels; hand(type, id, x, y) is what a finger does there.
function begin() {
  const listeners = {};
  const canvas = {
    clientWidth: 400, clientHeight: 300, setPointerCapture() {},
    addEventListener(type, call) { listeners[type] = call; },
  };
  const seen = { changed: 0, taps: [], dragged: 0, zoomed: 0 };
  const viewport = new Viewport(canvas, {
    changed: () => { seen.changed += 1; }, tapped: (...place) => seen.taps.push(place),
    dragged: () => { seen.dragged += 1; }, zoomed: () => { seen.zoomed += 1; },
  });
  const hand = (type, pointerId, offsetX, offsetY) => listeners[type]({ type, pointerId, offsetX, offsetY });
  return { viewport, seen, hand, wheel: listeners.wheel };
}

const near = (one, other) => one.every((each, index) => Math.abs(each - other[index]) < 1e-6);

test("x is to the right, y is up, and the centre is in the middle of what is free", () => {
  const { viewport } = begin();
  viewport.covered = { above: 40, below: 20 };
  viewport.centre(1, 2);
  assert.deepEqual(viewport.toPixels(1, 2), [200, 160]);
  assert.deepEqual(viewport.toPixels(1.5, 2.5), [310, 50]);
});

test("a place in pixels is that place in metres", () => {
  const { viewport } = begin();
  viewport.centre(-3, 7);
  assert.ok(near(viewport.toMetres(...viewport.toPixels(0.3, -0.2)), [0.3, -0.2]));
});

test("all robots fit, with room around them, and one alone is not shown too large", () => {
  const { viewport } = begin();
  const places = [[-3, -1], [4, 2]];
  viewport.fit(places);
  for (const place of places) {
    const [right, down] = viewport.toPixels(...place);
    assert.ok(right > 20 && right < 380 && down > 20 && down < 280, `${right} ${down}`);
  }
  viewport.fit([[5, 5]]);
  assert.deepEqual([viewport.toPixels(5, 5), viewport.scale], [[200, 150], 300]);
});

test("no robot, or a map that is hidden, changes nothing", () => {
  const { viewport, seen } = begin();
  viewport.fit([]);
  viewport.canvas.clientWidth = 0;
  viewport.fit([[5, 5]]);
  assert.equal(seen.changed, 0);
});

test("the wheel zooms around the pointer, within limits", () => {
  const { viewport, wheel } = begin();
  const turn = (deltaY, deltaMode = 0) => wheel({ deltaY, deltaMode, offsetX: 100, offsetY: 50, preventDefault() {} });
  const place = viewport.toMetres(100, 50);
  turn(-200);
  assert.ok(viewport.scale > 220 && near(viewport.toMetres(100, 50), place));
  turn(-1000, 1);
  assert.equal(viewport.scale, 1500);
  turn(1000, 1);
  assert.equal(viewport.scale, 15);
});

const DRAG = [["down", 1, 100, 100], ["move", 1, 160, 70], ["up", 1, 160, 70]];
const TREMBLE = [["down", 1, 100, 100], ["move", 1, 103, 102], ["up", 1, 103, 102]];
const PINCH = [["down", 1, 150, 150], ["down", 2, 250, 150], ["move", 2, 350, 150], ["up", 2, 350, 150],
  ["up", 1, 150, 150]];
for (const [what, gesture, seen, from, to] of [ // taps, drags, zooms, scale; where a place of the floor was, and is
  ["a finger moves the floor with it", DRAG, [[], 1, 0, 220], [100, 100], [160, 70]],
  ["a finger that hardly moves has tapped", TREMBLE, [[[100, 100]], 0, 0, 220]],
  ["a finger that the browser takes away taps nothing", [TREMBLE[0], ["cancel", 1, 100, 100]], [[], 0, 0, 220]],
  ["two fingers zoom, and tap nothing", PINCH, [[], 0, 1, 440]],
]) {
  test(what, () => {
    const { viewport, seen: now, hand } = begin();
    const place = from && viewport.toMetres(...from);
    for (const [type, ...where] of gesture) hand(`pointer${type}`, ...where);
    assert.deepEqual([now.taps, now.dragged, now.zoomed, viewport.scale], seen);
    if (from) assert.ok(near(viewport.toMetres(...to), place));
  });
}
