// The one sentence that a page has for the person: for a while, and no longer than it is true.

import { element } from "./dom.js";
import { hasPassed } from "./refusals.js";

const NOTICE_TIME = 6000; // ms

export class Notice {
  isOver = () => false;

  // isSo(): whether it is true now; it may become so a little later: states come after refusals
  show(text, isSo = () => true) {
    this.isOver = hasPassed(isSo);
    element("notice").textContent = text;
    element("notice").hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.hide(), NOTICE_TIME);
  }

  get visible() {
    return !element("notice").hidden;
  }

  // Something has changed.
  update() {
    if (this.isOver()) this.hide();
  }

  hide() {
    element("notice").hidden = true;
  }
}
