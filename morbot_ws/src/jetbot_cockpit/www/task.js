// What a judge says of a robot's task, in the page's language.

/** @import { JudgedTask } from "./messages.js" */

import { t } from "./language.js";

/** @param {Pick<JudgedTask, "text" | "sentences" | "lost">} task */
export function saidOf({ text, sentences, lost }) {
  if (!sentences.length) return text; // of a judge that publishes no data
  const said = sentences.map(({ template, arguments: values }) => t(template, values)).join(" ");
  return lost === null ? said : t("Largest loss: {loss} ({count} points).", { loss: said, count: lost.toFixed(1) });
}
