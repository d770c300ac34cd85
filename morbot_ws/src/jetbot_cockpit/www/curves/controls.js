// The buttons above the curves: what is shown of the robot, of which drives, of which time; and the table as a file.

import { create, download, setText } from "../dom.js";
import { number, t } from "../language.js";
import { recall, remember } from "../storage.js";
import { toCsv } from "./csv.js";
import { PRINTED, STRIPS } from "./series.js";

const FIRST = "wheels speed printed"; // what is shown until a person chooses
const ZOOM = 1.6;

export class Controls {
  on = new Set((recall("curves") || FIRST).split(" "));
  hidden = new WeakSet(); // drives
  /** @type {any[]} */
  listed = []; // drives, each with its button

  // curves: see panel.js; close(): shows what was there before, null: something else does
  constructor(curves, close) {
    this.curves = curves;
    const { timeline } = curves;
    const [tools, toggles] = [create("div"), create("div")];
    this.root = create("div", "controls");
    this.pause = button("pause", t("Pause"), () => curves.hold(!curves.held));
    this.earlier = create("span");
    this.strips = [...STRIPS, PRINTED].map(({ id, title }) => [id, button(id, title, () => this.toggle(id))]);
    tools.append(...close ? [button("close", t("Map"), close)] : [], this.pause,
      button("in", "+", () => timeline.zoom(ZOOM), t("Zoom in")),
      button("out", "−", () => timeline.zoom(1 / ZOOM), t("Zoom out")),
      button("fit", t("Fit"), () => timeline.all(), t("Show the whole drive")),
      button("save", t("CSV"), () => this.save(), t("Save as a table")));
    toggles.append(...this.strips.map(([, each]) => each));
    this.root.append(tools, toggles, this.earlier);
  }

  isOn(id) {
    return this.on.has(id);
  }

  shows(drive) {
    return !this.hidden.has(drive);
  }

  toggle(id) {
    if (!this.on.delete(id)) this.on.add(id);
    remember("curves", [...this.on].join(" ") || "none");
    this.curves.shell.show();
  }

  toggleDrive(drive) {
    if (!this.hidden.delete(drive)) this.hidden.add(drive);
    this.curves.shell.show();
  }

  draw() {
    setText(this.pause, this.curves.held ? t("Go on") : t("Pause"));
    for (const [id, each] of this.strips) each.ariaPressed = String(this.isOn(id));
    const { kept } = this.curves.held ?? this.curves.drives;
    if (!this.lists(kept)) this.list(kept);
    for (const [drive, each] of this.listed.slice(1)) each.ariaPressed = String(this.shows(drive));
  }

  lists(kept) {
    return kept.length === this.listed.length && kept.every((drive, index) => {
      const [known, { textContent }] = this.listed[index];
      return drive === known && titleOf(drive) === textContent;
    });
  }

  // The newest drive is always shown.
  list([newest, ...earlier]) {
    const made = (drive) => button(`drive-${drive.number}`, titleOf(drive), () => this.toggleDrive(drive));
    this.listed = [[newest, create("b", "", titleOf(newest))], ...earlier.map((drive) => [drive, made(drive)])];
    this.earlier.replaceChildren(...this.listed.map(([, each]) => each));
  }

  save() {
    const { shown, of } = this.curves;
    download(`curves${(of ?? "").replaceAll("/", "_")}.csv`, toCsv(shown), "text/csv");
  }
}

function titleOf({ number: count, score }) {
  if (!count) return "";
  return score === null ? t("Drive {number}", { number: count })
    : t("Drive {number}: {score}", { number: count, score: number(score.toFixed(1)) });
}

function button(id, text, press, title = "") {
  const made = Object.assign(create("button", "", text), { id: `curves-${id}`, type: "button", title });
  if (text.length === 1) made.ariaLabel = title;
  made.addEventListener("click", press);
  return made;
}
