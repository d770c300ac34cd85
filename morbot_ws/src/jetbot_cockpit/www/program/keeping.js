// What the page shows of the program that is kept: a line over the blocks, and the sheet with all of the robot.

/** @import { Shelf } from "./shelf.js" */

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { EMPTY } from "./check.js";
import { NOT_YET } from "./kept.js";
import { clean } from "./names.js";
import { Work } from "./work.js";

export const NEW = [t("my program"), EMPTY];

/** @type {Shelf | null} */
let shelf = null; // until it is opened first
let rows = null; // as the cockpit lists them

// Returns the Work of the page; for what it shows, current and lock see there. notLoaded(): the sheet is not there
export function openWork({ show, current, lock, notLoaded }) {
  const work = new Work({ show, current, lock, say, list });
  element("programs").addEventListener("click", () => shelf ?? openShelf(work).catch(notLoaded));
  const begin = (program) => {
    work.add(NEW[0], program);
    shelf?.sheet.toggle(false);
  };
  element("new").addEventListener("click", () => begin(EMPTY));
  element("new-python").addEventListener("click", () => import("./examples.js")
    .then(({ NEW_PYTHON }) => begin(NEW_PYTHON), notLoaded));
  element("title").addEventListener("change", ({ target }) => { target.value = clean(target.value); });
  element("newer").addEventListener("click", () => {
    const { id, state: { newer } } = work.kept;
    void work.openNewer({ id, version: newer });
  });
  return work;
}

async function openShelf(work) {
  const loaded = await import("./shelf.js");
  shelf ??= new loaded.Shelf(work, rows);
  shelf.sheet.toggle(true);
}

function list(now) {
  rows = now;
  shelf?.list(now);
}

// A screen reader says what a change has led to, not that there is one.
function say(text, bad, newer) {
  element("kept").setAttribute("aria-live", text === NOT_YET ? "off" : "polite");
  setText(element("kept"), text);
  element("kept").dataset.level = bad ? "warning" : "";
  element("newer").hidden = !newer;
}
