// A package that leaves the page opens anywhere.

import assert from "node:assert/strict";
import { test } from "node:test";

import { packageName, packageZip } from "#www/program/package.js";
import { zip } from "#www/program/zip.js";

const FILES = [
  { name: "a.txt", text: "123456789", mode: 0o644 },
  { name: "scripts/ü.py", text: "print('ü')\n", mode: 0o755 },
];

// Returns the entries of a zip's directory, with their text.
async function unpack(blob) {
  const data = Buffer.from(await blob.arrayBuffer());
  const end = data.length - 22;
  assert.equal(data.readUInt32LE(end), 0x06054b50);
  const entries = [];
  let place = data.readUInt32LE(end + 16);
  for (let left = data.readUInt16LE(end + 10); left; left -= 1) {
    const [size, length, start] = [24, 28, 42].map((at, index) =>
      (index === 1 ? data.readUInt16LE(place + at) : data.readUInt32LE(place + at)));
    entries.push({
      name: data.toString("utf8", place + 46, place + 46 + length), mode: data.readUInt32LE(place + 38) >>> 16 & 0o777,
      text: data.toString("utf8", start + 30 + length, start + 30 + length + size), sum: data.readUInt32LE(place + 16),
    });
    place += 46 + length;
  }
  assert.equal(place, end);
  return entries;
}

test("each file has its name, its text and its rights", async () => {
  const entries = await unpack(zip(FILES));
  assert.deepEqual(entries.map(({ name, text, mode }) => ({ name, text, mode })), FILES);
});

test("a computer that unpacks it knows that the rights are those of Unix", async () => {
  const data = Buffer.from(await zip(FILES).arrayBuffer());
  assert.equal(data[data.readUInt32LE(data.length - 6) + 5], 3);
});

test("each file has the checksum of the zip format", async () => {
  const [{ sum }] = await unpack(zip(FILES));
  assert.equal(sum, 0xcbf43926); // the check value of CRC-32
});

test("a package has a folder of its own, with a script that may be run", async () => {
  const entries = await unpack(packageZip("my_square", "import rospy\n", "{}"));
  assert.ok(entries.every(({ name }) => name.startsWith("my_square/")));
  assert.equal(entries.find(({ name }) => name.endsWith("program.py")).mode, 0o755);
});

test("a package depends on what its program imports", async () => {
  const [{ text }] = await unpack(packageZip("my_square", "import rospy\nfrom nav_msgs.msg import Odometry\n", "{}"));
  assert.match(text, /<exec_depend>nav_msgs</);
  assert.doesNotMatch(text, /std_msgs/);
});

test("a package's name is one that catkin takes, and no package of the workspace has it", () => {
  const names = ["Two moves!", "my square", "", "Über 100 %", "jetbot", "__"].map(packageName);
  assert.deepEqual(names, ["my_two_moves", "my_square", "my_program", "my_ber_100", "my_jetbot", "my_program"]);
  assert.ok(packageName("x".repeat(200)).length < 50);
});
