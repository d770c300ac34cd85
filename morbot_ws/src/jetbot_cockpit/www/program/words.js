// Blockly's own words, in the page's language.

import { language } from "../language.js";

if (language !== "en") await load(new URL(`../vendor/blockly/msg/${language}.js`, import.meta.url).href);

// It is a script, not a module. Without it, Blockly's words are English.
function load(src) {
  const script = Object.assign(document.createElement("script"), { src });
  document.head.append(script);
  return new Promise((resolve) => { script.onload = script.onerror = resolve; });
}
