// What is said before the program becomes a text, or its blocks again: a sheet over it with a sentence and two buttons.

import { create, element } from "../dom.js";
import { t } from "../language.js";
import { Sheet } from "../program/sheet.js";

// Returns the sheet that asks whether the program is to be a text; act(): it is.
export function beText(act) {
  return ask("edit", t("From now on this program is text. The blocks stay as a copy."), t("Edit as text"), act);
}

// The same for its blocks.
export function beBlocks(act) {
  return ask("to-blocks", t("This program becomes blocks again, as they were. " +
    "The text stays as an earlier version in Programs."), t("Back to blocks"), act);
}

// button: the id of what opens the sheet
function ask(button, sentence, answer, act) {
  const id = `${button}-question`;
  const [question, buttons] = [create("section", "sheet question"), create("div")];
  const [yes, no] = [create("button", "", answer), create("button", "", t("Cancel"))];
  Object.assign(question, { id, tabIndex: -1, hidden: true, ariaLabel: answer });
  Object.assign(yes, { id: `${id}-yes`, type: "button" });
  Object.assign(no, { id: `close-${id}`, type: "button" });
  buttons.append(yes, no);
  question.append(create("p", "", sentence), buttons);
  element("text").before(question);
  const sheet = new Sheet(id, button, () => {});
  yes.addEventListener("click", () => {
    sheet.toggle(false);
    act();
  });
  return sheet;
}
