// What a program prints: all of it to see, and no more than there is time for to hear.

import { create, element } from "../dom.js";

export const MAX_PRINTS = 200; // on the page
const [SAID_LINES, SAID_CHARACTERS] = [5, 100]; // the newest, at a time
const [PAUSE, PER_CHARACTER] = [500, 60]; // ms that a screen reader takes

let waiting = []; // to be said
let timer = 0; // of what is said; 0: nothing is

export function clearPrints() {
  for (const id of ["prints", "said"]) element(id).replaceChildren();
  waiting = [];
}

export function print(text) {
  append("prints", "li", text || " ", MAX_PRINTS);
  waiting = [...waiting, text].slice(-SAID_LINES);
  timer ||= setTimeout(say);
}

function say() {
  const text = waiting.splice(0).join("\n").slice(-SAID_CHARACTERS);
  timer = text ? setTimeout(say, PAUSE + PER_CHARACTER * text.length) : 0;
  if (text) append("said", "p", text, SAID_LINES);
}

function append(id, tag, text, most) {
  element(id).append(create(tag, "", text));
  if (element(id).childElementCount > most) element(id).firstChild.remove();
}
