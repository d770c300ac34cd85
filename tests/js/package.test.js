// A program as a package for ROS.

import assert from "node:assert/strict";
import { test } from "node:test";

import { packageText } from "#www/program/package.js";

test("a text without its first line is started by Python all the same, and needs what it imports", () => {
  const text = packageText("my_text", "import rospy\nfrom sensor_msgs.msg import Range\n", "{}");
  assert.match(text, /> scripts\/program\.py <<'END'\n\|#!\/usr\/bin\/env python3\n\|import rospy\n/);
  for (const name of ["rospy", "sensor_msgs"]) assert.ok(text.includes(`<exec_depend>${name}</exec_depend>`));
  assert.ok(!text.includes("<exec_depend>nav_msgs"));
  assert.ok(text.includes("<description>Drives a JetBot.</description>"), "not of blocks");
});

test("a text with its first line is packed as it is", () => {
  const text = packageText("my_text", "#!/usr/bin/python3\nprint(1)\n", "{}");
  assert.match(text, /<<'END'\n\|#!\/usr\/bin\/python3\n\|print\(1\)\nEND\n/);
});
