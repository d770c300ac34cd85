// The left stick of a gamepad, only while this page has the focus.

const INTERVAL = 50; // ms
const IN_USE = 0.2; // share of the way to the edge

export class Gamepads {
  // deflect(forward, left): each in [-1, 1]
  constructor(deflect) {
    this.deflect = deflect;
    this.timer = null;
    addEventListener("gamepadconnected", () => this.start());
  }

  start() {
    if (this.timer === null) this.timer = setInterval(() => this.poll(), INTERVAL);
  }

  poll() {
    const sticks = navigator.getGamepads().filter((gamepad) => gamepad?.connected);
    if (!sticks.length) this.end();
    else if (document.hasFocus()) this.report(sticks);
  }

  report(sticks) {
    const used = sticks.find(({ axes }) => Math.hypot(axes[0], axes[1]) > IN_USE) ?? sticks[0];
    const [right, down] = used.axes;
    this.deflect(-down, -right);
  }

  end() {
    clearInterval(this.timer);
    this.timer = null;
    this.deflect(0, 0);
  }
}
