// The line through the values of a series, as steps. Of the values in one column of pixels, only those are drawn that
// exceed the others there.

export class Path {
  /** @type {([number, number, boolean?] | null)[]} */
  points = []; // in px, and whether a value came there; null: the line is interrupted
  #before = -Infinity; // the time of the last value
  #down = NaN; // and where it is drawn
  #column = NaN;
  #low = Infinity; // of what is drawn in this column
  #high = -Infinity;

  // hold: s for which a value holds
  constructor(hold) {
    this.hold = hold;
  }

  // Adds a value. stamp: its time in s; right, down: in px; NaN: something is missing here
  add(stamp, right, down) {
    const follows = stamp - this.#before <= this.hold && !Number.isNaN(this.#down);
    const column = Math.floor(right);
    if (column !== this.#column) [this.#column, this.#low, this.#high] = [column, Infinity, -Infinity];
    if (!follows) this.points.push(null);
    if (!follows || !(down >= this.#low && down <= this.#high)) this.#draw(right, down, follows);
    [this.#before, this.#down] = [stamp, down];
  }

  #draw(right, down, follows) {
    if (follows) this.points.push([right, this.#down]);
    if (!Number.isNaN(down)) this.points.push([right, down, true]);
    [this.#low, this.#high] = [Math.min(this.#low, down), Math.max(this.#high, down)];
  }
}
