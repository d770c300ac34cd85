// A sheet that covers the blocks, one at a time: the keyboard's focus goes into it, and back.

import { element } from "../dom.js";

let open = null;

export class Sheet {
  // id: of the sheet; button: the id of what opens it; shown(): it is open
  constructor(id, button, shown) {
    this.sheet = element(id);
    this.button = element(button);
    this.shown = shown;
    this.button.addEventListener("click", () => this.toggle());
    element(`close-${id}`).addEventListener("click", () => this.toggle(false));
    addEventListener("keydown", ({ key }) => key === "Escape" && this.toggle(false));
    addEventListener("ask", () => this.toggle(false));
  }

  get isOpen() {
    return open === this;
  }

  toggle(on = !this.isOpen) {
    if (on === this.isOpen) return;
    if (on) open?.toggle(false);
    open = on ? this : null;
    this.sheet.hidden = !on;
    for (const id of ["blocks", "text"]) element(id).inert = on;
    this.button.setAttribute("aria-pressed", on);
    (on ? this.sheet : this.button).focus();
    if (on) this.shown();
  }
}
