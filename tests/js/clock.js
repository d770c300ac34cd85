// A clock that a test turns: performance.now() and the timers.

export class Clock {
  now = 1e6; // ms
  #timers = new Map();
  #last = 0;

  // t: the test, after which the real clock is back
  constructor({ mock }) {
    mock.method(performance, "now", () => this.now);
    mock.method(globalThis, "setTimeout", (call, ms = 0) => this.#begin({ call, due: this.now + ms }));
    mock.method(globalThis, "setInterval", (call, ms) => this.#begin({ call, due: this.now + ms, every: ms }));
    for (const name of ["clearTimeout", "clearInterval"]) {
      mock.method(globalThis, name, (timer) => this.#timers.delete(timer));
    }
  }

  #begin(timer) {
    this.#timers.set(this.#last += 1, timer);
    return this.#last;
  }

  // Lets so many ms pass: each timer runs when it is due, and what awaits it.
  async pass(ms) {
    await settled();
    const end = this.now + ms;
    for (let next = this.#next(end); next; next = this.#next(end)) {
      this.now = Math.max(this.now, next.due);
      next.call();
      await settled();
    }
    this.now = end;
  }

  // Lets so many ms pass while the page gets no turn.
  freeze(ms) {
    this.now += ms;
  }

  #next(end) {
    const due = [...this.#timers].filter(([, timer]) => timer.due <= end);
    if (!due.length) return null;
    const [id, timer] = due.reduce((one, other) => (other[1].due < one[1].due ? other : one));
    if (timer.every) this.#timers.set(id, { ...timer, due: timer.due + timer.every });
    else this.#timers.delete(id);
    return timer;
  }
}

// Waits until all that waits for nothing else has run.
export function settled() {
  return new Promise((resolve) => { setImmediate(resolve); });
}
