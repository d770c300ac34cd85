// What the inputs command: one of them at a time, repeated while it is off centre, and one zero when it ends.

const INTERVAL = 50; // ms between two commands: 20 Hz
const DEAD_ZONE = 0.12; // share of the way to the edge
const TURN = 0.5; // full deflection to the side turns at half the speed: finer to steer

export class Driving {
  speed = 0.5; // of a wheel at full deflection, as a share of full power
  command = [0, 0];
  source = null; // which input drives
  blocked = new Set(); // inputs that must return to the centre first
  timer = 0; // of the repetition, 0 for none
  lastSent = -Infinity;

  // send(forward, left): both in [-1, 1]; ready(): whether a command can be sent at all; changed(): active or not
  constructor({ send, ready, changed }) {
    this.send = send;
    this.ready = ready;
    this.changed = changed;
  }

  get active() {
    return this.source !== null;
  }

  // An input reports where it is: deflections in [-1, 1]. (0, 0) is released.
  deflect(source, forward, left) {
    const [x, z] = shape(forward, left);
    const centred = x === 0 && z === 0;
    if (centred) this.centre(source);
    else if (this.active ? source !== this.source : !this.ready()) this.blocked.add(source);
    else if (!this.blocked.has(source)) this.drive(source, x, z);
  }

  drive(source, forward, left) {
    this.source = source;
    this.command = [forward, left];
    if (this.timer) return;
    this.timer = setInterval(() => this.repeat(), INTERVAL);
    if (performance.now() - this.lastSent >= INTERVAL) this.repeat();
    this.changed();
  }

  repeat() {
    const [forward, left] = this.command;
    this.lastSent = performance.now();
    this.send(forward * this.speed, left * this.speed * TURN);
  }

  // Each release is sent, also one after a break: the cockpit obeys this page again only from then on.
  centre(source) {
    const wasBlocked = this.blocked.delete(source);
    if (source === this.source) this.end(true);
    else if (wasBlocked && !this.active) this.send(0, 0);
  }

  // This input may be dead: one zero, until it reports something else. Returns whether it drove.
  pause(source) {
    const drove = source === this.source;
    if (drove) this.end(true);
    return drove;
  }

  // The page cannot see the input any more (hidden, another window): one zero, and the input must return first.
  interrupt() {
    this.lift(true);
  }

  // The robot was stopped from outside: be silent until the input has returned to the centre.
  lift(zero = false) {
    if (!this.active) return;
    this.blocked.add(this.source);
    this.end(zero);
  }

  end(zero) {
    clearInterval(this.timer);
    this.timer = 0;
    this.source = null;
    this.command = [0, 0];
    this.lastSent = performance.now();
    if (zero) this.send(0, 0);
    this.changed();
  }
}

// Returns the deflections without the dead zone, limited to the unit circle.
function shape(forward, left) {
  const radius = Math.hypot(forward, left);
  if (!(radius > DEAD_ZONE)) return [0, 0];
  const scale = Math.min(1, (radius - DEAD_ZONE) / (1 - DEAD_ZONE)) / radius;
  return [forward * scale, left * scale];
}
