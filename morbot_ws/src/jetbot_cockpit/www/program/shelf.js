// The sheet with the programs of the chosen robot: open, copy, delete, and open an earlier version.

import { create, element, setText } from "../dom.js";
import { t } from "../language.js";
import { ask, newId } from "./ask.js";
import { freeName } from "./names.js";
import { Sheet } from "./sheet.js";

export class Shelf {
  // work: opens and deletes them, knows which one is shown; rows: as the cockpit lists them, null until it does
  constructor(work, /** @type {any} */ rows = null) {
    this.work = work;
    this.rows = rows;
    this.sheet = new Sheet("work", "programs", () => this.act(async () => this.show()));
  }

  list(rows) {
    this.rows = rows;
    if (this.sheet.isOpen) this.show();
  }

  show() {
    const focused = /** @type {any} */ (document.activeElement);
    const [row, place] = [focused.closest("#work-list li"), [...focused.parentElement.children].indexOf(focused)];
    element("work-list").replaceChildren(...this.rows?.flatMap((each) => this.items(each)) ?? []);
    element("no-programs").hidden = this.rows?.length !== 0;
    const again = row && element("work-list").querySelector(`[data-id="${row.dataset.id}"]`);
    if (row) (again?.children[place] ?? again?.lastChild ?? element("work")).focus();
  }

  // Returns the newest version of a program, and below it the earlier ones.
  items(row) {
    const { id, name, deleted, earlier } = row;
    const does = (text, label, action) => button(text, label, () => this.act(action));
    const newest = this.item(id, name, row, deleted
      ? [does(t("Undo"), t("Undo: {name}", { name }), () => this.work.undo(row))]
      : [does(t("Copy"), t("Copy: {name}", { name }), () => this.copy(row)),
        does(t("Delete"), t("Delete: {name}", { name }), () => this.work.remove(row))]);
    if (!deleted) return [newest, ...earlier.map((each) => this.earlierItem(id, each))];
    newest.className = "deleted";
    newest.firstChild.disabled = true;
    return [newest];
  }

  earlierItem(id, { name, version }) {
    const item = this.item(`${id} ${version}`, t("{name}, version {version}", { name, version }), { id, version });
    item.className = "earlier";
    return item;
  }

  // key: by which it is found again when the list is shown again
  item(key, text, { id, version }, buttons = []) {
    const [item, name] = [create("li"), button(text, text, () => this.act(() => this.open(id, version)))];
    item.dataset.id = key;
    name.className = "name";
    if (this.work.isShown(id, version)) name.setAttribute("aria-current", "true");
    item.append(name, ...buttons);
    return item;
  }

  async open(id, version) {
    await this.work.open(id, version);
    this.sheet.toggle(false);
  }

  async copy({ id, robot }) {
    const { name, program } = await ask({ do: "open", robot, id });
    await ask({ do: "save", robot, id: newId(), version: 0, name: freeName(name, this.rows), program });
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
