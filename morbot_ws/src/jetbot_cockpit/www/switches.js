// The switches with which a teacher lets pupils choose tasks.

/** @import { Send } from "./link.js" */
/** @import { Task } from "./messages.js" */

import { create } from "./dom.js";
import { t } from "./language.js";

// Shows a switch for each task. The same ones stay, with the keyboard's focus.
/** @param {HTMLElement} target @param {Task[]} tasks @param {Send} send */
export function showSwitches(target, tasks, send) {
  const names = String(tasks.map(({ name }) => name));
  if (target.dataset.names !== names) target.replaceChildren(...tasks.map((task) => toSwitch(task, send)));
  target.dataset.names = names;
  target.querySelectorAll("input").forEach((box, index) => { box.checked = tasks[index].on; });
}

function toSwitch({ name, title }, send) {
  const [label, box] = [create("label", "", t(title)), create("input")];
  box.type = "checkbox";
  box.addEventListener("change", () => send({ type: "offer", task: name, on: box.checked }));
  label.prepend(box);
  return label;
}
