// Which drives a page keeps for its curves, and what of them: each value as it came, and none that did not.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { toCsv } from "#www/curves/csv.js";
import { Drives } from "#www/curves/drives.js";
import { printedStrip, STRIPS, valueAt } from "#www/curves/series.js";
import { MOST, Track } from "#www/curves/track.js";

const CLOCK = 1790000000; // s, the robot's, when this page's is 0
const [LEFT, SPEED] = [STRIPS[0].series[0], STRIPS[1].series[0]];
let drives = null, number = 0;

beforeEach(() => {
  [drives, number] = [new Drives(), 0];
});

// Lets a message come at a time of the page's clock, in s. rows: by topic, each with its time
function come(now, rows = {}, missing = 0) {
  const stamped = ([time, ...values]) => [CLOCK + time, ...values];
  const topics = ["odom", "wheels", "line", "battery"].map((topic) => [topic, (rows[topic] ?? []).map(stamped)]);
  const after = number + missing;
  number = after + topics.reduce((sum, [, all]) => sum + all.length, 0);
  drives.take({ now: CLOCK + now, after, number, ...Object.fromEntries(topics) }, now * 1000);
}

const wheels = (time, power) => ({ wheels: [[time, power, 0, power, power]] });

// The robot drives for a second, and rests.
function drive(from) {
  come(from, wheels(from, 0.5));
  come(from + 1, wheels(from + 1, 0));
  come(from + 3.5, wheels(from + 3.5, 0));
}

test("a drive begins when the robot moves after a rest, and ends when it has rested for a while", () => {
  come(0, wheels(0, 0));
  come(1, wheels(0.9, 0.5));
  const { current } = drives;
  assert.deepEqual([current.number, current.start], [1, CLOCK + 0.9]);
  come(2, wheels(1.9, 0));
  come(2.8, wheels(2.7, 0.5));
  assert.equal(drives.current, current, "it has stopped for a moment");
  come(5, wheels(4.9, 0));
  come(6.5, { odom: [[6.4, 0, 0, 0, 0, 0]] });
  assert.equal(current.tracks.odom.count, 0, "what comes after a drive does not belong to it");
  come(8, wheels(7.9, 0.1));
  assert.equal(drives.current.number, 2);
  assert.equal(current.end, CLOCK + 5);
});

test("a program's drive begins with its clock, stands as long as it likes, and ends a second after it", () => {
  come(1, wheels(1, 0));
  drives.run(1500);
  come(2, { odom: [[1.4, 0, 0, 0, 0, 0], [1.6, 0, 0, 0, 0.1, 0]] });
  come(9, wheels(9, 0));
  come(10, wheels(10, 0.5));
  drives.ended(10500);
  come(12, { wheels: [[11.4, 0, 0, 0.5, 0.5], [11.6, 0, 0, 0, 0]] });
  const { number: count, start, tracks } = drives.current;
  assert.deepEqual([count, start], [1, CLOCK + 1.5]);
  assert.deepEqual([tracks.odom.count, tracks.wheels.count], [1, 3]);
});

test("the robot's wheels that turn on after a program begin no other drive", () => {
  come(1, wheels(1, 0));
  drives.run(1000);
  drives.ended(2000);
  come(4, wheels(4, 0.5));
  assert.equal(drives.current.number, 1);
  come(5, wheels(5, 0));
  come(6, wheels(6, 0.5));
  assert.equal(drives.current.number, 2);
});

test("the time of what a program prints is the robot's, by the message that took least", () => {
  come(0, wheels(0, 0));
  drives.take({ now: CLOCK + 1, after: 1, number: 1, odom: [], wheels: [], line: [], battery: [] }, 1400);
  drives.run(2000);
  drives.print("x", 7, 3000);
  assert.deepEqual([...drives.current.prints.get("x").row(0)], [CLOCK + 3, 7]);
});

test("eight names are printed as curves, each short, and no value that cannot be drawn", () => {
  come(0, wheels(0, 0));
  drives.run(0);
  for (let name = 0; name < 12; name += 1) drives.print(`${name}${"x".repeat(50)}`, name, 100);
  for (const value of [NaN, Infinity, "7", null, true]) drives.print(`0${"x".repeat(50)}`, value, 200);
  const { prints } = drives.current;
  assert.deepEqual([prints.size, [...prints.keys()][0].length], [8, 40]);
  assert.equal([...prints.values()][0].count, 1);
});

test("what is printed before the robot's clock is known is no curve, and a drive begins with the first value", () => {
  drives.run(1000);
  drives.print("x", 7, 1001);
  come(5, { odom: [[4, 0, 0, 0, 0, 0]] });
  assert.deepEqual([drives.current.prints.size, drives.current.start], [0, CLOCK + 4]);
});

test("the newest drive is kept, the three before it, and the best at its task", () => {
  const scores = [null, 50, 90, 90, 70, null, null, null];
  scores.forEach((score, index) => {
    drive(10 * index + 1);
    if (score !== null) Object.assign(drives.current, { score, task: "metre" });
  });
  assert.deepEqual(drives.kept.map((each) => each.number), [8, 7, 6, 5, 3]);
  Object.assign(drives.current, { score: 10, task: "square" });
  drive(100);
  assert.equal(drives.best.number, 8, "another task has another best");
});

test("values that were lost leave a gap, and the table no row", () => {
  come(1, wheels(1, 0.5));
  come(2, wheels(2, 0.5), 3);
  const [{ tracks }, at] = [drives.current, (time) => valueAt(drives.current, LEFT, time)];
  assert.deepEqual([0, 1, 2].map((index) => tracks.wheels.isGap(index)), [false, true, false]);
  assert.deepEqual([at(0.5), at(1)], [null, 0.5]);
  assert.deepEqual(toCsv([drives.current]).match(/^1,.*$/gm),
    [1, 2].map((second) => `1,${second - 1}.000,${CLOCK + second},,,,,,0.5,0,0.5,0.5,,,,`));
});

test("a value holds until the robot should have repeated it", () => {
  come(1, { ...wheels(1, 0.5), odom: [[1, 0, 0, 0, 0.3, 0]] });
  const at = (time) => [LEFT, SPEED].map((series) => valueAt(drives.current, series, time));
  assert.deepEqual([at(-0.1), at(0), at(2), at(3)], [[null, null], [0.5, 0.3], [0.5, 0.3], [null, null]]);
});

test("the heading goes on at half a turn, and begins at 0", () => {
  const yaws = [3, 3.1, -3.1, -2, 0, 2, 3.1, -3.1];
  come(0, wheels(0, 0.5));
  come(1, { odom: yaws.map((yaw, index) => [0.1 * index, 0, 0, yaw, 0, 0]) });
  const { odom } = drives.current.tracks;
  const headings = yaws.map((_, index) => odom.at(index, 6));
  assert.ok(headings.every((heading, index) => heading >= (headings[index - 1] ?? 0)), headings);
  assert.equal(Math.round(headings.at(-1)), Math.round((2 * 2 * Math.PI - 3.1 - 3) * 180 / Math.PI));
});

test("a clock that is set back begins another drive", () => {
  come(0, wheels(100, 0.5));
  come(1, wheels(40, 0.5));
  assert.deepEqual([drives.current.number, drives.current.start, drives.earlier.length], [2, CLOCK + 40, 1]);
});

test("a long drive keeps its newest part, and no more memory", () => {
  const track = new Track(2);
  for (let index = 0; index < 5 * MOST; index += 1) track.add([index, -index]);
  assert.ok(track.count <= MOST && track.count >= MOST / 2);
  assert.ok(track.data.length <= 2 * MOST);
  const [last, middle] = [track.count - 1, track.until(5 * MOST - 9) - 1];
  assert.deepEqual([track.at(last, 1), track.at(middle)], [1 - 5 * MOST, 5 * MOST - 9]);
});

test("the table has a row for each stamp, the numbers as they came, and nothing that a spreadsheet calculates", () => {
  come(0, { ...wheels(0, 0.5), odom: [[0, 1e-7, -2, 0.5, 0.30000001192092896, 0]] });
  come(1, { line: [[0.5, 0.25, 0, 1]], battery: [[0.75, 12.1]] });
  for (const name of ['=1+"2"', "\t=1", "\r=1", "\n=1"]) drives.print(name, -3.5, 750); // no space hides the sign
  const rows = toCsv(drives.kept.slice(0, 1)).trimEnd().split("\r\n");
  assert.deepEqual(rows, [
    "drive,time (s),stamp (s),x (m),y (m),yaw (rad),speed (m/s),turn rate (rad/s),command x,command z,"
      + "left wheel (power),right wheel (power),left eye,middle eye,right eye,battery (V),"
      + '"\'=1+""2""","\'\t=1","\'\r=1","\'\n=1"',
    `1,0.000,${CLOCK},1e-7,-2,0.5,0.30000001192092896,0,0.5,0,0.5,0.5,,,,,,,,`,
    `1,0.500,${CLOCK}.5,,,,,,,,,,0.25,0,1,,,,,`,
    `1,0.750,${CLOCK}.75,,,,,,,,,,,,,12.1,-3.5,-3.5,-3.5,-3.5`,
  ]);
});

test("names that two drives print are one curve", () => {
  come(0, wheels(0, 0));
  for (const names of [["a", "b"], ["b", "c"]]) {
    drives.run(0);
    for (const name of names) drives.print(name, 1, 1);
    drives.ended(2);
  }
  assert.deepEqual(printedStrip(drives.kept).series.map(({ name }) => name), ["b", "c", "a"]);
});
