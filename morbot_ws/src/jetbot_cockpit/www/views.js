// What fills the page instead of driving: on a small screen the list of all robots, the codes to hand out, the best
// scores. STOP is part of each.

import { create, element, inSeconds, setClass } from "./dom.js";
import { number, t } from "./language.js";

const VIEWS = { "show-fleet": "fleet", "show-codes": "codes", "show-scores": "scores" };

export function prepareViews() {
  for (const [id, view] of Object.entries(VIEWS)) {
    element(id).addEventListener("click", () => showView(document.body.dataset.view === view ? "drive" : view));
  }
  element("close-scores").addEventListener("click", () => showView("drive"));
  addEventListener("ask", () => showView("drive")); // what it shows may be old
}

export function showView(view) {
  document.body.dataset.view = view;
  setClass(document.body, "covered", view !== "drive");
  for (const id of ["codes", "scores"]) element(id).hidden = view !== id;
  for (const [id, own] of Object.entries(VIEWS)) element(id).setAttribute("aria-pressed", view === own);
}

// Returns to driving if this view is open and has nothing to show any more.
export function leaveView(view) {
  if (document.body.dataset.view === view) showView("drive");
}

// scores: the best of each robot in each task, rows of {task, robot, score, seconds, name}, the best of each task first
export function showScores(scores) {
  element("show-scores").hidden = !scores.length;
  if (!scores.length) leaveView("scores");
  element("scores-list").replaceChildren(...scores.map((score, index) => scoreRow(score, scores[index - 1]?.task)));
}

function scoreRow({ task, robot, score, seconds, name }, before) {
  const row = create("tr", task === before ? "" : "best");
  const heading = create("th", "", t(task));
  heading.scope = "row";
  const driver = name ? `${name} (${robot})` : robot;
  row.append(heading, ...[driver, number(score.toFixed(1)), inSeconds(seconds)].map((text) => create("td", "", text)));
  return row;
}
