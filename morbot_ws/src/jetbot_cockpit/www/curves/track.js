// Rows of numbers, each with its time first, in the order of their times. Its memory is bounded: the oldest half goes.

const FIRST = 128; // rows that there is room for at first
export const MOST = 32768; // rows: ten minutes of what a robot reports most often

export class Track {
  count = 0;

  /** @param {number} width numbers of a row */
  constructor(width) {
    this.width = width;
    this.data = new Float64Array(FIRST * width);
  }

  /** @param {number[]} row */
  add(row) {
    if (this.count === MOST) this.forget(MOST / 2);
    if (this.count * this.width === this.data.length) this.grow();
    this.data.set(row, this.count * this.width);
    this.count += 1;
  }

  // What comes next does not follow what was there: values in between are missing.
  interrupt() {
    const last = this.count - 1;
    if (last >= 0 && !this.isGap(last)) this.add([this.at(last), ...Array(this.width - 1).fill(NaN)]);
  }

  at(index, column = 0) {
    return this.data[index * this.width + column];
  }

  row(index) {
    return this.data.slice(index * this.width, (index + 1) * this.width);
  }

  isGap(index) {
    return Number.isNaN(this.at(index, 1));
  }

  // Returns how many rows came until this time.
  until(time) {
    let [low, high] = [0, this.count];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.at(middle) <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  forget(rows) {
    this.data.copyWithin(0, rows * this.width);
    this.count -= rows;
  }

  grow() {
    const data = new Float64Array(2 * this.data.length);
    data.set(this.data);
    this.data = data;
  }
}
