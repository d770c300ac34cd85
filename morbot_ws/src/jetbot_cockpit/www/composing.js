// Keys that an input method takes while a person writes, say, Japanese are no commands: no other part of the page, and
// no part of Blockly, gets them. WebKit marks the key that ends a composition by its code alone.

const COMPOSED = 229; // keyCode

addEventListener("keydown", (event) => {
  const composed = event.isComposing || event.keyCode === COMPOSED && event.target instanceof HTMLInputElement;
  if (composed) event.stopImmediatePropagation();
}, true);
