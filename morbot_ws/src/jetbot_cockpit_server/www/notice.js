// One sentence for the person: for a while, and no longer than it is true.

import { element } from "./dom.js";

const SHOWN = 6000; // ms

export class Notice {
  // over(): whether it is no longer true; without it, it is over once nothing keeps this person from driving
  show(text, over = null) {
    Object.assign(this, { over, wasBlocked: false, rested: false });
    element("notice").textContent = text;
    element("notice").hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.hide(), SHOWN);
  }

  get visible() {
    return !element("notice").hidden;
  }

  // blocked: whether this person cannot drive the robot now; driving: whether this page drives it
  update(blocked, driving) {
    if (!this.visible) return;
    const over = this.over ? this.over() : this.wasBlocked && !blocked;
    const drivesAgain = this.rested && driving;
    this.wasBlocked ||= blocked;
    this.rested ||= !driving;
    if (over || drivesAgain) this.hide();
  }

  hide() {
    element("notice").hidden = true;
  }
}
