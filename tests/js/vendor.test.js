// The compressed files of what others have written are those that they stand beside.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { brotliDecompressSync } from "node:zlib";

const FOLDER = new URL("../../morbot_ws/src/jetbot_cockpit/www/vendor/", import.meta.url);

test("each script of Blockly and CodeMirror has its compressed file", () => {
  const names = ["blockly/", "blockly/msg/", "codemirror/"].flatMap((folder) => readdirSync(new URL(folder, FOLDER))
    .filter((name) => name.endsWith(".js")).map((name) => folder + name));
  assert.equal(names.length, 10);
  for (const name of names) {
    const compressed = readFileSync(new URL(`${name}.br`, FOLDER));
    assert.ok(brotliDecompressSync(compressed).equals(readFileSync(new URL(name, FOLDER))), name);
  }
});
