// What fills the page instead of driving: on a small screen the list of all robots, the codes to hand out, the best
// scores. STOP is part of each.

import { create, element, inSeconds, setClass, setText } from "./dom.js";

const VIEWS = { "show-fleet": "fleet", "show-codes": "codes", "show-scores": "scores" };
const QUIET_ZONE = 4; // modules around a QR code
const NO_CODES = "Only this computer can open this page now. Start the cockpit with lan:=true to get codes for others.";
const HOW = "Scan a code, or open the address and type the code.";

// askForCodes(): a person has opened them
export function prepareViews(askForCodes) {
  for (const [id, view] of Object.entries(VIEWS)) {
    element(id).addEventListener("click", () => showView(document.body.dataset.view === view ? "drive" : view));
  }
  for (const id of ["close-codes", "close-scores"]) element(id).addEventListener("click", () => showView("drive"));
  addEventListener("ask", () => showView("drive")); // what it shows may be old
  element("show-codes").addEventListener("click", askForCodes);
  element("print-codes").addEventListener("click", () => print());
  element("show-teacher").addEventListener("click", () => showTeachersCode(element("teacher-codes").hidden));
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

// Shows the addresses and codes that a teacher hands out, and can print. The teacher's own is shown only when asked
// for, and is never printed: a class sees this page on a projector.
export function showCodes(codes) {
  setText(element("codes-text"), codes.length ? HOW : NO_CODES);
  const cards = (isWanted) => codes.filter(isWanted).map(card);
  element("teacher-codes").replaceChildren(...cards(({ role }) => role === "teacher"));
  element("codes-list").replaceChildren(...cards(({ role }) => role !== "teacher"));
  showTeachersCode(false);
}

function showTeachersCode(shown) {
  element("teacher-codes").hidden = !shown;
  setText(element("show-teacher"), shown ? "Hide the teacher's code" : "Show the teacher's code");
}

function card({ label, url, code, rows }) {
  const item = create("li");
  if (rows?.length) item.append(drawQr(rows, `QR code for ${label}`));
  const address = url.split("#")[0];
  item.append(create("h3", "", label), create("p", "address", address), create("p", "code", code),
    create("p", "own-name", "Name:")); // printed, to be written on
  return item;
}

// Returns a canvas of black and white modules; rows are texts of 0 and 1.
function drawQr(rows, label) {
  const canvas = create("canvas");
  canvas.width = canvas.height = rows.length + 2 * QUIET_ZONE;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  const context = canvas.getContext("2d");
  context.fillStyle = "white";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "black";
  rows.forEach((row, y) => [...row].forEach((module, x) => {
    if (module === "1") context.fillRect(x + QUIET_ZONE, y + QUIET_ZONE, 1, 1);
  }));
  return canvas;
}

// scores: the best of each robot in each task, rows of {task, robot, score, seconds, name}, the best of each task first
export function showScores(scores) {
  element("show-scores").hidden = !scores.length;
  if (!scores.length) leaveView("scores");
  element("scores-list").replaceChildren(...scores.map((score, index) => scoreRow(score, scores[index - 1]?.task)));
}

function scoreRow({ task, robot, score, seconds, name }, before) {
  const row = create("tr", task === before ? "" : "best");
  const heading = create("th", "", task);
  heading.scope = "row";
  const driver = name ? `${name} (${robot})` : robot;
  row.append(heading, ...[driver, score.toFixed(1), inSeconds(seconds)].map((text) => create("td", "", text)));
  return row;
}
