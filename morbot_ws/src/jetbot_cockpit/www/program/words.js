// Blockly's own words, in the page's language: of its file for this language, else of ours.

import { language, t, WORDS_TIMEOUT } from "../language.js";

if (language !== "en") {
  const { Msg } = globalThis.Blockly;
  const english = Object.entries(Msg);
  await load(new URL(`../vendor/blockly/msg/${language}.js`, import.meta.url).href);
  for (const [name, text] of english) if (Msg[name] === text) Msg[name] = name === "DELETE_KEY" ? t("Del") : t(text);
}

// It is a script, not a module. Without it, Blockly's words are English.
function load(src) {
  const script = Object.assign(document.createElement("script"), { src });
  document.head.append(script);
  return new Promise((resolve) => {
    script.onload = script.onerror = resolve;
    setTimeout(resolve, WORDS_TIMEOUT);
  });
}
