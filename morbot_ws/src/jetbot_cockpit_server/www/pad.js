// The joystick: one pointer, from the centre of a ring.

const RADIUS = 0.36; // how far the thumb goes, as a share of the ring's width

export class Pad {
  // deflect(forward, left): each in [-1, 1]
  constructor(ring, thumb, deflect) {
    Object.assign(this, { ring, thumb, deflect, pointer: null });
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
    const radius = box.width * RADIUS;
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
    const radius = this.ring.clientWidth * RADIUS;
    this.thumb.style.transform = `translate(${right * radius}px, ${down * radius}px)`;
  }
}
