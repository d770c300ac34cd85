// The clock of a program, in ms: it stands while the program is paused. A wait begins when the one before was to end,
// as timers are late by some ms; a tick comes ten times per second, as from rospy.Rate(10).

const TICK = 100; // ms
const LATE = 25; // ms by which a timer may be late

export class Clock {
  start = 0;
  due = 0; // when the last wait was to end
  tickedAt = 0;
  lost = 0; // while it stood
  /** @type {number | null} */
  stoodAt = null; // since when it stands, as performance.now() counts

  begin() {
    this.start = this.due = this.tickedAt = this.now;
  }

  get now() {
    return (this.stoodAt ?? performance.now()) - this.lost;
  }

  get stands() {
    return this.stoodAt !== null;
  }

  stop() {
    this.stoodAt ??= performance.now();
  }

  goOn() {
    if (this.stoodAt !== null) this.lost += performance.now() - this.stoodAt;
    this.stoodAt = null;
  }

  get seconds() {
    return (this.now - this.start) / 1000;
  }

  // Returns when a wait of so many seconds ends that begins now.
  afterWait(seconds) {
    const begin = this.now - this.due < LATE ? this.due : this.now;
    this.due = begin + seconds * 1000;
    return this.due;
  }

  nextTick() {
    const [now, next] = [this.now, this.tickedAt + TICK];
    this.tickedAt = now - next > 2 * TICK ? now : next;
    this.due = Math.max(now, next);
    return next;
  }
}
