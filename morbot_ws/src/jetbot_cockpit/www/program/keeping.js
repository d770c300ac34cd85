// What the page shows of the program that is kept: a line over the blocks, and the sheet with all of the robot.

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { EMPTY } from "./examples.js";
import { clean } from "./names.js";
import { Shelf } from "./shelf.js";
import { Work } from "./work.js";

export const NEW = [t("my program"), EMPTY];

// Returns the Work of the page; for what it shows, current and lock see there.
export function openWork({ show, current, lock }) {
  const work = new Work({ show, current, lock, say, list: (rows) => shelf.list(rows) });
  const shelf = new Shelf(work);
  element("new").addEventListener("click", () => {
    work.add(...NEW);
    shelf.sheet.toggle(false);
  });
  element("title").addEventListener("change", ({ target }) => { target.value = clean(target.value); });
  element("newer").addEventListener("click", () => {
    const { id, state: { newer } } = work.kept;
    work.openNewer({ id, version: newer });
  });
  return work;
}

function say(text, bad, newer) {
  setText(element("kept"), text);
  element("kept").dataset.level = bad ? "warning" : "";
  element("newer").hidden = !newer;
}
