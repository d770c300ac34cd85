// The buttons that run a program, and what is said of it while it runs.

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { setOutcome } from "./output.js";
import { newsOf } from "./remarks.js";

// run: a Run that is not over, or null; waiting: whether Judge me waits
export function showControls(run, waiting) {
  const held = Boolean(run?.held);
  element("run").disabled = Boolean(run);
  element("pause").disabled = !run;
  element("end").disabled = !run && !waiting;
  element("step").disabled = Boolean(run) && !held;
  element("pause").setAttribute("aria-pressed", String(held));
  setText(element("pause"), held ? t("Go on") : t("Pause"));
  if (run) setOutcome(...newsOf(run));
}
