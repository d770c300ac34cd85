// The class's best: a table with the best score of each robot in each task.

import { create, element } from "./dom.js";
import { inSeconds } from "./task.js";
import { showView } from "./views.js";

// scores: rows of {task, robot, score, seconds}, the best of each task first
export function showScores(scores) {
  element("show-scores").hidden = !scores.length;
  if (!scores.length && document.body.dataset.view === "scores") showView("drive");
  element("scores-list").replaceChildren(...scores.map((score, index) => row(score, scores[index - 1]?.task)));
}

function row({ task, robot, score, seconds }, before) {
  const made = create("tr", task === before ? "" : "best");
  const [title, ...cells] = [task, robot, score.toFixed(1), inSeconds(seconds)];
  const heading = create("th", "", title);
  heading.scope = "row";
  made.append(heading, ...cells.map((text) => create("td", "", text)));
  return made;
}
