// One sentence for the person: for a while, and no longer than it is true.

import { element } from "./dom.js";

const SHOWN = 6000; // ms

export class Notice {
  over = () => false;

  // over(): whether it is no longer true; more than what update() knows
  show(text, over = () => false) {
    Object.assign(this, { over, wasBlocked: false, rested: false });
    element("notice").textContent = text;
    element("notice").hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.hide(), SHOWN);
  }

  // blocked: whether this person cannot drive the robot now; driving: whether this page drives it
  update(blocked, driving) {
    if (element("notice").hidden) return;
    const unblocked = this.wasBlocked && !blocked;
    const drivesAgain = this.rested && driving;
    this.wasBlocked ||= blocked;
    this.rested ||= !driving;
    if (unblocked || drivesAgain || this.over()) this.hide();
  }

  hide() {
    element("notice").hidden = true;
  }
}
