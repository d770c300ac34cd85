// The buttons that run a program, and what is said of it while it runs.

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { setOutcome } from "./output.js";
import { newsOf } from "./remarks.js";

// A button that can do nothing now keeps the keyboard's focus, which browsers take from one that is disabled.
for (const event of ["pointerdown", "pointerup", "click"]) {
  element("running").addEventListener(event, (press) => {
    if (press.target.closest("[aria-disabled=true]")) press.stopPropagation();
  }, true);
}

function enable(id, on) {
  element(id).setAttribute("aria-disabled", String(!on));
}

// run: a Run that is not over, or null; waiting: whether Judge me waits
export function showControls(run, waiting) {
  const held = Boolean(run?.held);
  enable("run", !run);
  enable("pause", run);
  enable("end", run || waiting);
  enable("step", !run || held);
  setText(element("pause"), held ? t("Go on") : t("Pause"));
  if (run) setOutcome(...newsOf(run));
}
