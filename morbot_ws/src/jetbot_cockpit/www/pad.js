// The joystick: one pointer, from the centre of a ring.

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
    const radius = box.width * 0.36; // the thumb stays inside the ring
    const right = (event.clientX - box.left - box.width / 2) / radius;
    const down = (event.clientY - box.top - box.height / 2) / radius;
    const length = Math.max(1, Math.hypot(right, down));
    this.show(right / length, down / length, radius);
    this.deflect(-down / length, -right / length);
  }

  lift(event) {
    if (event.pointerId !== this.pointer) return;
    this.pointer = null;
    this.show(0, 0, 0);
    this.deflect(0, 0);
  }

  show(right, down, radius) {
    this.thumb.style.transform = `translate(${right * radius}px, ${down * radius}px)`;
  }
}
