// A package that leaves the page unpacks anywhere, with sh alone.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, test } from "node:test";

import { archive } from "#www/program/archive.js";
import { packageName } from "#www/program/names.js";
import { packageText } from "#www/program/package.js";

const FILES = [
  { name: "a.txt", text: "1\n\n  2\n" },
  { name: "scripts/program.py", text: "print('ü €')\n", executable: true },
];
let folder;

beforeEach(() => { folder = mkdtempSync(join(tmpdir(), "archive_")); });
afterEach(() => rmSync(folder, { recursive: true }));

// Unpacks a text in the folder as a person does; returns the exit code.
function unpack(text, ...into) {
  writeFileSync(join(folder, "x.txt"), text);
  return spawnSync("sh", ["x.txt", ...into], { cwd: folder }).status;
}

const read = (name) => readFileSync(join(folder, name), "utf8");

test("each file has its name, its text and its rights", () => {
  assert.equal(unpack(archive("made", FILES)), 0);
  for (const { name, text, executable = false } of FILES) {
    assert.equal(read(`made/${name}`), text);
    assert.equal((statSync(join(folder, "made", name)).mode & 0o100) > 0, executable);
  }
});

test("it is unpacked into the folder that is named", () => {
  unpack(archive("outer", FILES));
  assert.equal(unpack(archive("inner", FILES), "outer"), 0);
  assert.deepEqual(readdirSync(join(folder, "outer/inner")), ["a.txt", "scripts"]);
});

test("nothing that a file holds is run, and nothing is lost", () => {
  const text = "END\ntouch bad\n|END\n$(touch bad)\n`touch bad`\n'\"\\\r\nEND\n";
  assert.equal(unpack(archive("made", [{ name: "a.txt", text }])), 0);
  assert.equal(read("made/a.txt"), text);
  assert.deepEqual(readdirSync(join(folder, "made")), ["a.txt"]);
});

test("what is there already is not overwritten", () => {
  unpack(archive("made", FILES));
  assert.notEqual(unpack(archive("made", [{ name: "a.txt", text: "other" }])), 0);
  assert.equal(read("made/a.txt"), FILES[0].text);
});

test("a package can be started, has the blocks to open again, and depends on what its program imports", () => {
  unpack(packageText("my_square", "import rospy\nfrom sensor_msgs.msg import Range\n", "{}"));
  assert.equal(statSync(join(folder, "my_square/scripts/program.py")).mode & 0o100, 0o100);
  assert.equal(read("my_square/scripts/program.py"),
    "#!/usr/bin/env python3\nimport rospy\nfrom sensor_msgs.msg import Range\n");
  assert.deepEqual(JSON.parse(read("my_square/my_square.json")), {});
  assert.deepEqual(read("my_square/package.xml").match(/(?<=<exec_depend>)\w+/g),
    ["rospy", "sensor_msgs", "jetbot_control_node"]);
});

test("a text with its first line is packed as it is", () => {
  unpack(packageText("my_text", "#!/usr/bin/python3\nprint(1)\n", "{}"));
  assert.equal(read("my_text/scripts/program.py"), "#!/usr/bin/python3\nprint(1)\n");
});

test("a package's name is one that catkin takes, and no package of the workspace has it", () => {
  const names = ["Two moves!", "my square", "", "Über 100 % Größe", "jetbot", "__"].map(packageName);
  assert.deepEqual(names, ["my_two_moves", "my_square", "my_program", "my_uber_100_grosse", "my_jetbot", "my_program"]);
  assert.ok(packageName("x".repeat(200)).length < 50);
  assert.equal(packageName("日本語 2"), "my_65e5_672c_8a9e_2", "and each program has its own, in any writing");
});
