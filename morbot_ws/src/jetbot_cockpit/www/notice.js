// The one sentence that a page has for the person: for a while, and no longer than it is true.

import { element } from "./dom.js";

const NOTICE_TIME = 6000; // ms

export class Notice {
  isSo = () => true;
  wasSo = false;

  // isSo(): whether it is true now; it may become so a little later: states come after refusals
  show(text, isSo = () => true) {
    this.isSo = isSo;
    this.wasSo = false;
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
    const isSo = this.isSo();
    if (this.wasSo && !isSo) this.hide();
    this.wasSo ||= isSo;
  }

  hide() {
    element("notice").hidden = true;
  }
}
