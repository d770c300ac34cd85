// What fills the page: driving, on a small screen the list of all robots, or the codes. STOP is part of each.

import { element } from "./dom.js";

const VIEWS = { "show-fleet": "fleet", "show-codes": "codes" };

export function prepareViews() {
  for (const [id, view] of Object.entries(VIEWS)) {
    element(id).addEventListener("click", () => {
      showView(document.body.dataset.view === view ? "drive" : view);
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
