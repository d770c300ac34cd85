// What fills the page: driving, on a small screen the list of all robots, the codes or the scores.
// STOP is part of each.

import { element } from "./dom.js";

const VIEWS = { "show-fleet": "fleet", "show-codes": "codes", "show-scores": "scores" };

// opened(view) is called when a person has opened one
export function prepareViews(opened) {
  for (const [id, view] of Object.entries(VIEWS)) {
    element(id).addEventListener("click", () => {
      const next = document.body.dataset.view === view ? "drive" : view;
      showView(next);
      opened(next);
    });
  }
  for (const id of ["close-codes", "close-scores"]) element(id).addEventListener("click", () => showView("drive"));
  element("print-codes").addEventListener("click", () => print());
}

export function showView(view) {
  document.body.dataset.view = view;
  for (const id of ["codes", "scores"]) element(id).hidden = view !== id;
  for (const [id, own] of Object.entries(VIEWS)) element(id).setAttribute("aria-pressed", view === own);
}
