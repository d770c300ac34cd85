// The codes that a teacher hands out: all of them, to print, each with its pupil's name; or one alone, large.

/** @import { Send } from "./link.js" */
/** @import { Code } from "./messages.js" */
/** @import { World } from "./world.js" */

import { create, element, onSurePress, setClass, setText } from "./dom.js";
import { t } from "./language.js";
import { limits } from "./limits.js";
import { toName } from "./storage.js";
import { showView } from "./views.js";

const QUIET_ZONE = 2; // modules around the 2 that a QR code has already
const NO_CODES = t("Only this computer can open this page now. "
  + "Start the cockpit with lan:=true to get codes for others.");
const ASK_INTERVAL = 1000; // ms
const CARDS = { teacher: t("teacher"), pupils: t("pupils") }; // of no robot
const HOW = t("Scan a code, or open the address and type the code.");

export class Codes {
  /** @type {Code[]} */
  codes = [];
  /** @type {string | null} */
  large = null; // the label of the one that is shown alone
  askedAt = 0; // ms

  /** @param {World} world @param {Send} send */
  constructor(world, send) {
    this.world = world;
    this.send = send;
    element("show-codes").addEventListener("click", () => this.open());
    element("close-codes").addEventListener("click", () => (this.large ? this.enlarge(null) : showView("drive")));
    element("print-codes").addEventListener("click", () => print());
    element("show-teacher").addEventListener("click", () => this.showTeachers(element("teacher-codes").hidden));
    const renew = () => send({ type: "new_code", robot: this.codes.find(({ label }) => label === this.large)?.robot });
    this.askNoMore = onSurePress(element("new-code"), t("End the old code?"), renew);
    const cameras = /** @type {HTMLInputElement} */ (element("cameras-switch"));
    cameras.addEventListener("change", () => send({ type: "cameras", on: cameras.checked }));
    addEventListener("keydown", (event) => this.escape(event), true);
  }

  // A person has opened them.
  open() {
    this.enlarge(null);
    this.ask();
  }

  ask() {
    this.askedAt = performance.now();
    this.send({ type: "codes" });
  }

  // ./morbot fleet cards opens the page with them.
  openIfAddressed() {
    if (location.search !== "?codes") return;
    history.replaceState(history.state, "", location.pathname);
    element("show-codes").click();
  }

  // A robot of a hub that is connected only now has a card, too; nobody's typing is disturbed.
  complete() {
    const shown = this.codes.map(({ robot }) => robot);
    const missing = ({ id, address }) => address && this.world.state(id).answers && !shown.includes(id);
    const wanted = document.body.dataset.view === "codes" && !this.large && this.world.robots.some(missing)
      && !nameFields().some((field) => field === document.activeElement);
    if (wanted && performance.now() - this.askedAt > ASK_INTERVAL) this.ask();
  }

  // What the cockpit has sent: all codes, or the answer to a new one.
  list(codes) {
    this.codes = codes;
    this.show();
  }

  // label: of the code that is shown alone, null: all of them. The keyboard's focus stays at its card.
  enlarge(label) {
    const pressed = label ?? this.large;
    this.large = label;
    this.askNoMore();
    this.show();
    const cards = /** @type {HTMLElement[]} */ ([...document.querySelectorAll("#codes-list .enlarge")]);
    cards.find(({ dataset }) => dataset.label === pressed)?.focus();
  }

  // Escape ends the large one, and stops no robot then: it comes before the keys that drive.
  escape(event) {
    if (event.key !== "Escape" || !this.large || document.body.dataset.view !== "codes") return;
    event.stopImmediatePropagation();
    this.enlarge(null);
  }

  // The teacher's own code is shown only when asked for, and is never printed: a class sees this page on a projector.
  show() {
    const { codes, large } = this;
    const ofPupils = codes.filter(({ role, label }) => role !== "teacher" && label === (large ?? label));
    setText(element("codes-text"), codes.length ? HOW : NO_CODES);
    element("teacher-codes").replaceChildren(...codes.filter(({ role }) => role === "teacher").map(card));
    element("codes-list").replaceChildren(...ofPupils.map((code) => this.pupilsCard(code)));
    setClass(document.body, "enlarged", large);
    element("new-code").hidden = !large;
    element("show-teacher").hidden = Boolean(large);
    this.showTeachers(false);
    this.showNames();
  }

  showTeachers(shown) {
    element("teacher-codes").hidden = !shown;
    setText(element("show-teacher"), shown ? t("Hide the teacher's code") : t("Show the teacher's code"));
  }

  // Returns a card that a press on its QR code enlarges, or makes small again.
  pupilsCard(code) {
    const [item, enlarge] = [card(code), create("button", "enlarge")];
    enlarge.dataset.label = code.label;
    enlarge.title = this.large ? t("Show all codes") : t("Show this code large");
    enlarge.setAttribute("aria-label", `${enlarge.title}: ${item.querySelector("h3").textContent}`);
    enlarge.append(item.querySelector("canvas") ?? "⤢"); // without a QR code
    enlarge.addEventListener("click", () => this.enlarge(this.large ? null : code.label));
    item.prepend(enlarge);
    item.append(this.nameLine(code));
    return item;
  }

  // Returns the line for the pupil's name: to type in where there is a robot to which it belongs, else to write on.
  nameLine({ robot, label }) {
    const [line, field] = [create("label", robot ? "own-name" : "own-name blank", t("Name:")), create("input")];
    if (!robot) return line;
    Object.assign(field, { maxLength: limits.name, autocomplete: "off", spellcheck: false });
    field.dataset.robot = robot;
    field.setAttribute("aria-label", t("Name of the pupil of {robot}", { robot: label }));
    field.addEventListener("change", () => this.send({ type: "pupil", robot, name: toName(field.value) }));
    field.addEventListener("keydown", (event) => event.key === "Enter" && focusNext(event));
    line.append(field);
    return line;
  }

  // The robots have come, with the names of their pupils; nobody's typing is disturbed.
  showNames() {
    for (const field of nameFields()) {
      const robot = this.world.robot(field.dataset.robot ?? null);
      field.disabled = !robot;
      if (field !== document.activeElement) field.value = robot?.pupil ?? "";
    }
  }
}

function nameFields() {
  return /** @type {HTMLInputElement[]} */ ([...document.querySelectorAll("#codes-list input")]);
}

// Enter goes on to the next name.
function focusNext(event) {
  event.preventDefault();
  const [fields, field] = [nameFields(), event.target];
  (fields[fields.indexOf(field) + 1] ?? element("print-codes")).focus();
}

function card({ label, url, code, rows }) {
  const [item, robot] = [create("li"), CARDS[label] ?? label];
  if (rows?.length) item.append(drawQr(rows, t("QR code for {robot}", { robot })));
  item.append(create("h3", "", robot), create("p", "address", url.split("#")[0]), create("p", "code", code));
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
