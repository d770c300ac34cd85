// The keyboard: arrows and WASD drive while they are held; Escape and Space stop, Escape also while typing.

import { isTextField } from "./dom.js";

const DIRECTIONS = {
  ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1],
  KeyW: [1, 0], KeyS: [-1, 0], KeyA: [0, 1], KeyD: [0, -1],
};

export class Keys {
  // deflect(forward, left): each in [-1, 1]; stop()
  constructor(deflect, stop) {
    this.deflect = deflect;
    this.stop = stop;
    this.held = new Set();
    addEventListener("keydown", (event) => this.press(event), true);
    addEventListener("keyup", (event) => this.lift(event), true);
  }

  press(event) {
    const typing = isTextField(event.target);
    if (event.key === "Escape" || event.code === "Space" && !typing) return this.pressStop(event);
    const shortcut = event.ctrlKey || event.altKey || event.metaKey;
    if (!(event.code in DIRECTIONS) || typing || shortcut || this.belongsTo(event)) return;
    event.preventDefault();
    if (event.repeat) return; // a key that was held before a break must be lifted first
    this.held.add(event.code);
    this.report();
  }

  // Space must not press the button that has the focus.
  pressStop(event) {
    if (event.code === "Space") event.preventDefault();
    if (!event.repeat) this.stop();
  }

  // The slider uses the arrow keys itself, a list letters, too.
  belongsTo({ target, code }) {
    const slider = target instanceof HTMLInputElement && code.startsWith("Arrow");
    return slider || target instanceof HTMLSelectElement;
  }

  lift(event) {
    if (event.code === "Space" && !isTextField(event.target)) event.preventDefault();
    if (this.held.delete(event.code)) this.report();
  }

  // The keyboard belongs to another window: it reports no key that is lifted there.
  clear() {
    this.held.clear();
    this.report();
  }

  report() {
    const clamp = (value) => Math.max(-1, Math.min(1, value));
    const sum = (axis) => clamp([...this.held].reduce((total, code) => total + DIRECTIONS[code][axis], 0));
    this.deflect(sum(0), sum(1));
  }
}
