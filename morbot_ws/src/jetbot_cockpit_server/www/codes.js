// The addresses and codes that a teacher hands out, with their QR codes; can be printed. The teacher's own is shown
// only when asked for, and is never printed: a class sees this page on a projector.

import { create, element, setText } from "./dom.js";

const QUIET_ZONE = 4; // modules around a QR code
const NONE = "Only this computer can open this page now. Start the cockpit with lan:=true to get codes for others.";
const HOW = "Scan a code, or open the address and type the code.";

export function prepareCodes() {
  element("show-teacher").addEventListener("click", () => showTeacher(element("teacher-codes").hidden));
}

export function showCodes(codes) {
  setText(element("codes-text"), codes.length ? HOW : NONE);
  const teachers = codes.filter(({ role }) => role === "teacher");
  element("teacher-codes").replaceChildren(...teachers.map(card));
  element("codes-list").replaceChildren(...codes.filter((code) => !teachers.includes(code)).map(card));
  showTeacher(false);
}

function showTeacher(shown) {
  element("teacher-codes").hidden = !shown;
  setText(element("show-teacher"), shown ? "Hide the teacher's code" : "Show the teacher's code");
}

function card({ label, url, code, rows }) {
  const item = create("li");
  if (rows?.length) item.append(drawQr(rows, `QR code for ${label}`));
  const address = url.split("#")[0];
  item.append(create("h3", "", label), create("p", "address", address), create("p", "code", code));
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
