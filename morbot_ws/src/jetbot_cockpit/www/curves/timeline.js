// Which part of the time the curves show: all, or what a person has chosen by wheel, pinch and drag; and which moment
// is read: a mouse rests there, or a finger has tapped. Seconds count from the beginning of a drive.

import { Viewport } from "../viewport.js";

export const LEFT = 46; // px beside the curves: the numbers of the vertical axes
const SHORTEST = 0.2; // s
const AT_LEAST = 5; // s that are shown of a drive that begins

export class Timeline extends Viewport {
  /** @type {[number, number] | null} */
  part = null; // from, to; null: all
  /** @type {number | null} */
  cursor = null;
  length = 0; // of all, in s

  /** @param {() => void} changed */
  constructor(canvas, changed) {
    super(canvas, { changed, tapped: (right) => this.point(right), dragged() {}, zoomed() {} });
    canvas.addEventListener("pointermove", ({ pointerType, buttons, offsetX }) => {
      if (pointerType === "mouse" && !buttons) this.point(offsetX);
    });
    canvas.addEventListener("pointerleave", ({ pointerType }) => pointerType === "mouse" && this.read(null));
  }

  // The first and the last moment that are shown.
  get shown() {
    return this.part ?? [0, Math.max(AT_LEAST, this.length)];
  }

  get span() {
    const [from, to] = this.shown;
    return to - from;
  }

  right(time) {
    return LEFT + (time - this.shown[0]) / this.span * (this.width - LEFT);
  }

  time(right) {
    return this.shown[0] + (right - LEFT) / (this.width - LEFT) * this.span;
  }

  point(right) {
    this.read(right < LEFT ? null : this.time(right));
  }

  read(time) {
    this.cursor = time;
    this.changed();
  }

  all() {
    this.part = null;
    this.changed();
  }

  // Zooms so that this moment stays where it is.
  zoom(factor, right = (this.width + LEFT) / 2) {
    const [from, kept] = [this.shown[0], this.time(Math.max(LEFT, right))];
    const span = Math.max(SHORTEST, this.span / factor);
    this.show(kept - (kept - from) / this.span * span, span);
  }

  // Moves what is shown; where all is shown, there is nothing to move, and the finger reads.
  drag(right) {
    const [pointer] = this.pointers.values();
    if (!this.part) return this.point(pointer[0]);
    this.show(this.part[0] - right / (this.width - LEFT) * this.span, this.span);
  }

  show(from, span) {
    const longest = Math.max(AT_LEAST, this.length);
    const start = Math.max(0, Math.min(from, longest - span));
    this.part = span < longest ? [start, start + span] : null;
    this.changed();
  }
}
