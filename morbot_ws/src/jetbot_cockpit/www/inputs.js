// Where a person's hand is: on the joystick, on the keys, on a gamepad. Each input reports deflect(forward, left), both
// in [-1, 1]; (0, 0) is released.

const THUMB_TRAVEL = 0.36; // how far the thumb goes, as a share of the ring's width
const DIRECTIONS = {
  ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1],
  KeyW: [1, 0], KeyS: [-1, 0], KeyA: [0, 1], KeyD: [0, -1],
};
const POLL_INTERVAL = 50; // ms between two looks at the gamepads
const IN_USE = 0.2; // share of the way to the edge
const STILL = 1500; // ms; a dead gamepad's robot stops within 2 s

// The joystick: one pointer, from the centre of a ring.
export class Pad {
  constructor(ring, thumb, deflect) {
    this.ring = ring;
    this.thumb = thumb;
    this.deflect = deflect;
    this.pointer = null;
    ring.addEventListener("pointerdown", (event) => this.press(event));
    ring.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      ring.addEventListener(end, (event) => this.lift(event));
    }
    ring.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  press(event) {
    if (this.pointer !== null || event.button !== 0) return;
    event.preventDefault();
    this.pointer = event.pointerId;
    this.ring.setPointerCapture(event.pointerId);
    this.ring.focus({ preventScroll: true, focusVisible: false });
    this.move(event);
  }

  move(event) {
    if (event.pointerId !== this.pointer) return;
    const box = this.ring.getBoundingClientRect();
    const radius = box.width * THUMB_TRAVEL;
    const right = (event.clientX - box.left - box.width / 2) / radius;
    const down = (event.clientY - box.top - box.height / 2) / radius;
    const length = Math.max(1, Math.hypot(right, down));
    this.show(right / length, down / length);
    this.deflect(-down / length, -right / length);
  }

  lift(event) {
    if (event.pointerId !== this.pointer) return;
    this.pointer = null;
    this.show(0, 0);
    this.deflect(0, 0);
  }

  // Shows what another input commands.
  point(forward, left) {
    if (this.pointer === null) this.show(-left, -forward);
  }

  show(right, down) {
    const radius = this.ring.clientWidth * THUMB_TRAVEL;
    this.thumb.style.transform = `translate(${right * radius}px, ${down * radius}px)`;
  }
}

// Arrows and WASD drive while they are held, if the pad is in sight; Escape and Space call stop(), Escape also while
// typing.
export class Keys {
  constructor(pad, deflect, stop) {
    this.pad = pad;
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
    const drives = event.code in DIRECTIONS && this.pad.getClientRects().length > 0;
    if (!drives || typing || shortcut || belongsToTarget(event)) return;
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

function isTextField(target) {
  return target instanceof HTMLInputElement && target.type !== "range";
}

// The slider and a text that scrolls use the arrow keys themselves, a list letters, too.
function belongsToTarget({ target, code }) {
  return target.matches("select") || target.matches("input, .scrolls") && code.startsWith("Arrow");
}

// Reports the left stick of the gamepad that is in use, only while this page has the focus. heldStill(): it is off
// centre, but has reported the same for STILL: it may be dead. Its timestamp cannot tell: Chromium sets it at each poll
// on Windows and macOS, at changes alone on Linux and Android.
export function watchGamepads(deflect, heldStill) {
  const seen = []; // what each gamepad has reported last, and since when
  let timer = null;
  const moves = ({ index, axes }) => {
    if (String(axes) !== seen[index]?.axes) seen[index] = { axes: String(axes), since: performance.now() };
    return performance.now() - seen[index].since < STILL;
  };
  const report = () => {
    const pads = navigator.getGamepads().filter((pad) => pad !== null);
    const used = pads.filter(moves).find(isOffCentre);
    if (used) deflect(-used.axes[1], -used.axes[0]);
    else if (pads.some(isOffCentre)) heldStill();
    else deflect(0, 0);
  };
  addEventListener("gamepadconnected", () => {
    timer ??= setInterval(() => document.hasFocus() && report(), POLL_INTERVAL);
  });
}

function isOffCentre({ axes }) {
  return Math.hypot(axes[0], axes[1]) > IN_USE;
}
