// What fills the page: driving, on a small screen the list of all robots, or the codes. STOP is part of each.

import { element } from "./dom.js";

const VIEWS = { "show-fleet": "fleet", "show-codes": "codes" };

// opened(view) is called when a person has opened one
export function prepareViews(opened) {
  for (const [id, view] of Object.entries(VIEWS)) {
    element(id).addEventListener("click", () => {
      const next = document.body.dataset.view === view ? "drive" : view;
      showView(next);
      opened(next);
    });
  }
  element("close-codes").addEventListener("click", () => showView("drive"));
  element("print-codes").addEventListener("click", () => print());
}

export function showView(view) {
  document.body.dataset.view = view;
  element("codes").hidden = view !== "codes";
  for (const [id, own] of Object.entries(VIEWS)) element(id).setAttribute("aria-pressed", view === own);
}
