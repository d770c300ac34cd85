// Blockly as its page has it, without the page: import this before what uses it.

import { readFileSync } from "node:fs";
import { runInThisContext } from "node:vm";

const BLOCKLY = new URL("../../morbot_ws/src/jetbot_cockpit/www/vendor/blockly/", import.meta.url);

for (const name of ["blockly_compressed", "blocks_compressed", "python_compressed", "msg/en"]) {
  runInThisContext(readFileSync(new URL(`${name}.js`, BLOCKLY), "utf8"));
}
