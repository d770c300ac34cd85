// One sentence for the person, shown for a while.

import { element } from "./dom.js";

const SHOWN = 8000; // ms

export class Notice {
  show(text) {
    element("notice").textContent = text;
    element("notice").hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.hide(), SHOWN);
  }

  hide() {
    element("notice").hidden = true;
  }
}
