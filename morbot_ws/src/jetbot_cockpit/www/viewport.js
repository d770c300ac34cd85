// Which part of the floor the map shows: metres to pixels, moved by drag, wheel and pinch.

const MIN_SCALE = 15, MAX_SCALE = 1500; // pixels per metre
const TAP = 6; // pixels that a tap may move

export class Viewport {
  // changed(): it shows another part; tapped(x, y): in pixels; dragged(), zoomed(): by a person
  constructor(canvas, { changed, tapped, dragged, zoomed }) {
    this.canvas = canvas;
    this.changed = changed;
    this.tapped = tapped;
    this.dragged = dragged;
    this.zoomed = zoomed;
    this.x = 0;
    this.y = 0;
    this.scale = 220;
    this.covered = { above: 0, below: 0 }; // pixels of the map below its tools; its legend and its scale
    this.pointers = new Map(); // where each is, by its id
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.lift(event));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  get width() {
    return this.canvas.clientWidth;
  }

  get height() {
    return this.canvas.clientHeight;
  }

  // The height of the centre: the middle of what is free.
  get middle() {
    return (this.height + this.covered.above - this.covered.below) / 2;
  }

  toPixels(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.middle - (y - this.y) * this.scale];
  }

  toMetres(right, down) {
    return [this.x + (right - this.width / 2) / this.scale, this.y - (down - this.middle) / this.scale];
  }

  centre(x, y) {
    this.x = x;
    this.y = y;
  }

  // Zooms so that this place stays where it is.
  zoom(factor, right = this.width / 2, down = this.middle) {
    const [x, y] = this.toMetres(right, down);
    this.scale = Math.min(MAX_SCALE, Math.max(MIN_SCALE, this.scale * factor));
    const [newX, newY] = this.toMetres(right, down);
    this.centre(this.x + x - newX, this.y + y - newY);
    this.zoomed();
    this.changed();
  }

  // Shows all these places, with room for labels and tools.
  fit(places) {
    if (!places.length || !this.width) return;
    const [xs, ys] = [places.map(([x]) => x), places.map(([, y]) => y)];
    const [left, right, bottom, top] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    this.centre((left + right) / 2, (bottom + top) / 2);
    const height = Math.max(40, this.height - this.covered.above - this.covered.below - 50);
    const scale = Math.min((this.width - 60) / (right - left + 0.3), height / (top - bottom + 0.3));
    this.scale = Math.min(300, Math.max(MIN_SCALE, scale));
    this.changed();
  }

  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    this.start = this.pointers.size === 1 ? [event.offsetX, event.offsetY] : null;
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.offsetX, event.offsetY];
    if (this.start && distance(this.start, now) < TAP) return;
    this.start = null;
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.pointers.set(event.pointerId, now);
    if (other) this.pinch(other, before, now);
    else this.drag(now[0] - before[0], now[1] - before[1]);
  }

  drag(right, down) {
    this.centre(this.x - right / this.scale, this.y + down / this.scale);
    this.dragged();
    this.changed();
  }

  pinch(other, before, now) {
    const factor = Math.max(1, distance(other, now)) / Math.max(1, distance(other, before));
    this.zoom(factor, (other[0] + now[0]) / 2, (other[1] + now[1]) / 2);
  }

  lift(event) {
    if (this.start && event.type === "pointerup") this.tapped(...this.start);
    this.pointers.delete(event.pointerId);
    this.start = null;
  }

  wheel(event) {
    event.preventDefault();
    const pixels = event.deltaMode === 0 ? event.deltaY : event.deltaY * 30; // else in lines
    this.zoom(Math.exp(-pixels / 400), event.offsetX, event.offsetY);
  }
}

function distance(/** @type {number[]} */ [x, y], /** @type {number[]} */ [otherX, otherY]) {
  return Math.hypot(x - otherX, y - otherY);
}
