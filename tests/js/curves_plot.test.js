// How the curves are drawn, and what a person does with them: zoom, move, read.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Drive } from "#www/curves/drive.js";
import { Path } from "#www/curves/path.js";
import { heightOf, Plot } from "#www/curves/plot.js";
import { axis, scaleOf, ticks } from "#www/curves/scale.js";
import { digits, printedStrip } from "#www/curves/series.js";
import { LEFT, Timeline } from "#www/curves/timeline.js";
import { Track } from "#www/curves/track.js";

let hands = {}, timeline = null, changes = 0;

beforeEach(() => {
  [hands, changes] = [{}, 0];
  const canvas = {
    clientWidth: LEFT + 100, clientHeight: 100, setPointerCapture() {},
    addEventListener: (type, act) => { (hands[type] ??= []).push(act); },
  };
  timeline = new Timeline(canvas, () => { changes += 1; });
  timeline.length = 10;
});

function act(type, event) {
  hands[type].forEach((each) => each({ type, pointerId: 1, preventDefault() {}, offsetY: 50, ...event }));
}

function touch(type, pointerId, right) {
  act(type, { pointerId, pointerType: "touch", offsetX: LEFT + right, buttons: 1 });
}

test("the wheel zooms so that the moment below the mouse stays where it is", () => {
  act("wheel", { deltaMode: 0, deltaY: -400, offsetX: LEFT + 40 });
  assert.ok(Math.abs(timeline.span - 10 / Math.E) < 1e-9);
  assert.ok(Math.abs(timeline.time(LEFT + 40) - 4) < 1e-9);
  act("wheel", { deltaMode: 0, deltaY: 4000, offsetX: LEFT + 40 });
  for (const length of [10, 20]) { // it grows
    timeline.length = length;
    assert.deepEqual(timeline.shown, [0, length]);
  }
});

test("two fingers zoom in time, and one moves what is shown to its ends, not further", () => {
  touch("pointerdown", 1, 20);
  touch("pointerdown", 2, 40);
  touch("pointermove", 2, 60);
  assert.ok(Math.abs(timeline.span - 5) < 1e-9);
  touch("pointerup", 2, 60);
  touch("pointerup", 1, 20);
  touch("pointerdown", 1, 20);
  touch("pointermove", 1, 300);
  assert.deepEqual(timeline.shown, [0, 5]);
  touch("pointermove", 1, -900);
  assert.deepEqual(timeline.shown, [5, 10]);
  timeline.all();
  assert.deepEqual(timeline.shown, [0, 10]);
});

test("a tap, a mouse that rests, and a finger that slides over a whole drive read a moment", () => {
  touch("pointerdown", 1, 30);
  touch("pointerup", 1, 30);
  assert.equal(timeline.cursor, 3);
  act("pointermove", { pointerType: "mouse", buttons: 0, offsetX: LEFT + 50 });
  assert.equal(timeline.cursor, 5);
  act("pointerleave", { pointerType: "mouse" });
  assert.equal(timeline.cursor, null);
  touch("pointerdown", 1, 30);
  touch("pointermove", 1, 70);
  assert.equal(timeline.cursor, 7);
  assert.ok(changes > 3);
});

// Returns the points of a line through [stamp, right, down].
function path(rows) {
  const made = new Path(2.5); // s that a value holds
  for (const row of rows) made.add(...row);
  return made.points.map((point) => point && point.slice(0, 2));
}

test("a value is drawn until the next one comes, and not where values are missing, or are too old", () => {
  assert.deepEqual(path([[0, 0, 10], [1, 10, 30]]), [null, [0, 10], [10, 10], [10, 30]]);
  assert.deepEqual(path([[0, 0, 10], [0, 0, NaN], [1, 10, 30]]), [null, [0, 10], [0, 10], null, [10, 30]]);
  assert.deepEqual(path([[0, 0, 10], [3, 30, 30]]), [null, [0, 10], null, [30, 30]]);
});

test("of a thousand values in one column of pixels, the extremes are drawn, and where it goes on", () => {
  const down = (index) => (index === 500 ? 99 : 10 + index % 7);
  const rows = Array.from({ length: 1000 }, (_, index) => [index / 1e4, index / 1001, down(index)]);
  const points = path([...rows, [0.2, 5, 20]]);
  assert.ok(points.length < 50, `${points.length} points`);
  assert.ok(points.some((point) => point?.[1] === 99) && points.some((point) => point?.[1] === 10));
  assert.deepEqual(points.slice(-2), [[5, down(999)], [5, 20]]);
});

test("an axis has all values in it, also those that nobody expects, and some height if they are the same", () => {
  const track = new Track(2);
  track.add([0, 0.5]);
  const series = { topic: "wheels", name: "", column: 1, style: 0, hold: 1 };
  const drives = [["current", { start: 0, tracks: { wheels: track } }, Infinity]];
  const scale = (range) => scaleOf({ range, series: [series] }, drives, timeline, { top: 0, bottom: 100 });
  assert.ok(scale(null).high - scale(null).low > 0.05);
  assert.equal(scale([-1, 1]).y(0.5), 25);
  track.add([1, 4]);
  assert.equal(scale([-1, 1]).y(4), 0);
});

test("the numbers beside an axis are round, in order and few", () => {
  for (const [low, high, most, numbers] of [
    [-1, 1, 5, "−1.0 −0.5 0.0 0.5 1.0"], [0, 7.3, 4, "0 2 4 6"], [0, 1e14, 4, "0 5e13 1e14"],
    [-3e-9, 0, 4, "−3e−9 −2e−9 −1e−9 0.000000000"], [0.301, 0.309, 5, "0.302 0.304 0.306 0.308"],
  ]) assert.equal(ticks(low, high, most).map((each, _, all) => axis(each, all)).join(" "), numbers);
});

test("a value is read with as many digits as it deserves", () => {
  assert.deepEqual([[0.25, 2], [-0.001, 2], [1 / 3, null], [-12345.678, null], [null, 2], [-89.6, 0], [1e14, null]]
    .map(([value, places]) => digits(value, places)), ["0.25", "0.00", "0.3333", "−12350", "–", "−90", "1e14"]);
});

// Returns a context that notes what is written: [text, from, to, down] in px, each character 7 px wide.
function notedContext() {
  const texts = [];
  const context = {
    texts, measureText: (text) => ({ width: 7 * text.length }),
    fillText(text, right, down, most = Infinity) {
      const width = Math.min(most, 7 * text.length);
      const from = right - width * { left: 0, center: 0.5, right: 1 }[this.textAlign];
      texts.push([text, from, from + width, down]);
    },
  };
  for (const name of ["fillRect", "save", "restore", "beginPath", "rect", "clip", "moveTo", "lineTo", "stroke", "arc",
    "fill", "setLineDash"]) context[name] = () => {};
  return context;
}

const LARGE = { "from 0 on": [0, 1795710423313], "alike": [1795710423312, 1795710423313] };
for (const [what, values] of Object.entries(LARGE)) {
  test(`eight printed curves of large values ${what} are read on a narrow screen`, () => {
    const [drive, names] = [new Drive(1, 0), Array.from({ length: 8 }, (_, index) => `distance ${index}`)];
    for (const name of names) values.forEach((value, time) => drive.print(name, value, time));
    timeline.canvas.clientWidth = 330;
    const [context, strips] = [notedContext(), [printedStrip([drive])]];
    const height = heightOf(strips, context, 330);
    new Plot(context, timeline, {}).draw(strips, [["current", drive, Infinity]], height);
    const legend = names.map((name) => context.texts.find(([text]) => text.startsWith(name)));
    assert.ok(legend.every(([text]) => text.endsWith("1.796e12")));
    for (const [text, from, to, down] of context.texts) {
      assert.ok(from >= 0 && to <= 330 && down > 0 && down < height, `${text} from ${from} to ${to} at ${down}`);
      const near = legend.filter((each) => each[0] !== text && each[1] < to && from < each[2]);
      assert.ok(near.every((each) => Math.abs(each[3] - down) > 12), `${text} is over ${near}`);
    }
  });
}
