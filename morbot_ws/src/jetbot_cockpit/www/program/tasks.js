// The tasks that a pupil may choose, Judge me, and its score.

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { Judging } from "./judging.js";

export class Tasks {
  // page: what Judging asks of it, but say
  constructor(page) {
    this.world = page.world;
    this.endProgram = page.end;
    this.judging = new Judging({ ...page, say: (text) => this.say(text) });
    element("judge").addEventListener("click", () => this.press());
    for (const id of ["end", "run", "step"]) {
      for (const event of ["pointerdown", "click"]) element(id).addEventListener(event, () => this.judging.cancel());
    }
    element("pause").addEventListener("click", () => this.judging.paused());
    addEventListener("keydown", ({ key }) => key === "Escape" && this.judging.cancel(), true);
    document.addEventListener("visibilitychange", () => document.hidden && this.judging.cancel());
  }

  // Shows which tasks there are for this person.
  list(tasks) {
    const offered = tasks.filter(({ on }) => on || this.world.teacher);
    const { value } = element("task-choice");
    element("task-choice").replaceChildren(...offered.map(({ name, title }) => new Option(t(title), name)));
    if (offered.some(({ name }) => name === value)) element("task-choice").value = value;
    for (const id of ["task-choice", "judge"]) element(id).hidden = !offered.length;
    this.judging.list(tasks);
  }

  // Nothing drives any more, for this reason: a sentence.
  end(sentence) {
    this.judging.stop(sentence);
    this.endProgram(sentence);
  }

  press() {
    if (this.judging.isWaiting) this.judging.cancel();
    else this.judging.begin(this.world.chosen, element("task-choice").value);
  }

  say(text) {
    setText(element("score"), text);
    if (text) element("output").scrollIntoView({ block: "nearest" });
    setText(element("judge"), this.judging.isWaiting ? t("Cancel") : t("Judge me"));
  }
}
