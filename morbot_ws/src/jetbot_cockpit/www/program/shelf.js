// The sheet with the programs of the chosen robot: open, copy, delete.

import { create, element, setText } from "../dom.js";
import { ask, newId } from "./ask.js";
import { copyOf } from "./kept.js";
import { Sheet } from "./sheet.js";

export class Shelf {
  rows = []; // as the cockpit lists them

  // open(id); isShown(id); deleted(id): a program was deleted, or is there again
  constructor({ open, isShown, deleted }) {
    Object.assign(this, { open, isShown, deleted });
    this.sheet = new Sheet("work", "programs", () => this.show());
  }

  list(rows) {
    this.rows = rows;
    if (this.sheet.isOpen) this.show();
  }

  show() {
    const { activeElement: focused } = document;
    const [row, place] = [focused.closest("#work-list li"), [...focused.parentElement.children].indexOf(focused)];
    element("work-list").replaceChildren(...this.rows.map((each) => this.item(each)));
    const again = row && element("work-list").querySelector(`[data-id="${row.dataset.id}"]`);
    if (row) (again?.children[place] ?? again?.lastChild ?? element("work")).focus();
  }

  item(row) {
    const item = create("li", row.deleted ? "deleted" : "");
    const name = button(row.name, row.name, () => this.open(row.id));
    const remove = (text) => button(text, `${text}: ${row.name}`, () => this.act(() => this.remove(row)));
    item.dataset.id = row.id;
    name.className = "name";
    name.disabled = row.deleted;
    if (this.isShown(row.id)) name.setAttribute("aria-current", "true");
    item.append(name, ...row.deleted ? [remove("Undo")] : [
      button("Copy", `Copy: ${row.name}`, () => this.act(() => this.copy(row))), remove("Delete")]);
    return item;
  }

  async copy({ id, robot }) {
    const { name, program } = await ask({ do: "open", robot, id });
    await ask({ do: "save", robot, id: newId(), version: 0, name: copyOf(name), program });
  }

  async remove({ id, robot, deleted }) {
    await ask({ do: deleted ? "restore" : "delete", robot, id });
    this.deleted(id);
  }

  // Says why the cockpit refuses it.
  async act(action) {
    setText(element("work-problem"), "");
    await action().catch(({ message }) => setText(element("work-problem"), message));
  }
}

function button(text, label, action) {
  const made = create("button", "", text);
  made.setAttribute("aria-label", label);
  made.addEventListener("click", action);
  return made;
}
