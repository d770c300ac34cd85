// What this device keeps of programs until the cockpit has them.

import { recall, remember } from "../storage.js";

const LAST = "last program"; // the key of the one that was shown last
const ASIDE = "unsaved programs"; // of those that were shown before it

// Returns the program of this robot that was shown last, or null.
export function keptFor(place) {
  return load(recall(keyOf(place)));
}

export function keptLast() {
  return load(recall(recall(LAST)));
}

export function keepShown(kept) {
  const [key, last] = [keyOf(kept), recall(LAST)];
  if (last !== key && load(recall(last))?.id === kept.id) remember(last, ""); // it has found its robot, or its class
  remember(key, JSON.stringify(entry(kept)));
  remember(LAST, key);
  forgetAside(kept);
}

// What is shown is not sent beside that: what was kept of it earlier would overtake it.
function forgetAside({ id }) {
  const all = keptAside(), others = all.filter((each) => each.id !== id);
  if (others.length < all.length) remember(ASIDE, JSON.stringify(others));
}

// Shows nothing of this program any more; what is unsaved stays, until its class is there again.
export function leave(kept) {
  if (!kept.state.unsaved) remember(keyOf(kept), "");
  remember(LAST, "");
}

// Keeps a program that is not shown as long as it is unsaved.
export function keepAside(kept) {
  const { robot } = kept; // it was shown last, perhaps before it found its robot, or its class
  for (const key of [keyOf(kept), keyOf({ robot, classId: null }), recall(LAST)]) {
    if (load(recall(key))?.id === kept.id) remember(key, JSON.stringify(entry(kept)));
  }
  const others = keptAside().filter(({ id }) => id !== kept.id);
  const all = kept.content && kept.state.unsaved ? [...others, entry(kept)] : others;
  if (others.length || all.length || recall(ASIDE)) remember(ASIDE, JSON.stringify(all));
}

export function keptAside() {
  const all = parse(recall(ASIDE));
  return Array.isArray(all) ? all.filter(isEntry) : [];
}

function entry({ robot, id, version, classId, content, state: { unsaved } }) {
  return { robot, id, version, classId, ...content, unsaved };
}

function load(text) {
  const left = parse(text);
  return isEntry(left) ? left : null;
}

function isEntry(left) {
  return typeof left?.program === "string" && /^[0-9a-f]{16}$/.test(left.id);
}

function parse(text) {
  try {
    return JSON.parse(text);
  } catch { // nothing, or something else, is there
    return null;
  }
}

function keyOf({ classId, robot }) {
  return `program ${classId ?? ""}${robot}`;
}
