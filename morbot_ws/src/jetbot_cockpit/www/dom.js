// Short forms for the elements of the page. Text from outside reaches it as textContent alone.

import { number, t } from "./language.js";

const CLICK_WITHIN = 1000; // ms after a touch: a click then belongs to that touch
const CALM = 1000; // ms between two texts for a screen reader
const SURE_WITHIN = 3000; // ms between the two presses that something needs

/** @returns {any} whose kind the caller knows */
export function element(id) {
  return document.getElementById(id);
}

export function setText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

export function setClass(target, name, on) {
  target.classList.toggle(name, Boolean(on));
}

// Returns a function that sets a text for a screen reader: only one that has changed, and at most once a second.
export function calmly(set) {
  let [shown, at] = ["", -Infinity];
  return (text) => {
    const now = performance.now();
    if (text === shown || now - at < CALM) return;
    [shown, at] = [text, now];
    set(text);
  };
}

// Returns a new element with this class and text.
export function create(tag, className = "", text = "") {
  return Object.assign(document.createElement(tag), { className, textContent: text });
}

// Returns the number with two places, with a real minus, and without "-0.00".
export function signed(value) {
  const text = value.toFixed(2);
  return number(Number(text) === 0 ? "0.00" : text.replace("-", "−"));
}

// Returns a time with its unit, or "" where it is not known.
export function inSeconds(seconds) {
  return seconds === null ? "" : t("{seconds} s", { seconds: seconds.toFixed(1) });
}

// Gives the person a file of this name.
export function download(name, content, type) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  Object.assign(create("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

// Calls action() once per press: as a finger touches if urgent() is true then, else as it lifts from the button.
// It works while another finger holds the pad: browsers make no click of a second finger. A click without a touch
// counts as well: the Enter key, assistive technology.
export function onPress(target, action, urgent = () => true) {
  const waiting = new Set(); // pointers whose action is due when they lift
  let touched = -Infinity;
  target.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    touched = event.timeStamp;
    if (urgent()) action();
    else waiting.add(event.pointerId);
  });
  target.addEventListener("pointerup", (event) => {
    touched = event.timeStamp;
    if (waiting.delete(event.pointerId) && isOver(target, event)) action();
  });
  target.addEventListener("pointercancel", (event) => waiting.delete(event.pointerId));
  target.addEventListener("click", (event) => {
    const ofTouch = event.detail > 0 && event.timeStamp - touched < CLICK_WITHIN;
    if (!ofTouch) action();
  });
}

// Calls action() at the second press; the first one lets the button ask. Returns a function that takes that back.
export function onSurePress(target, question, action) {
  const text = target.textContent;
  let [sure, timer] = [false, 0]; // sure: the next press acts
  const ask = (on) => {
    sure = on;
    clearTimeout(timer);
    if (on) timer = setTimeout(() => ask(false), SURE_WITHIN);
    setText(target, on ? question : text);
  };
  onPress(target, () => {
    if (sure) action();
    ask(!sure);
  }, () => false);
  return () => ask(false);
}

// Returns whether the finger is on the button: it may have slid away.
function isOver(target, { clientX, clientY }) {
  return target.contains(document.elementFromPoint(clientX, clientY));
}
