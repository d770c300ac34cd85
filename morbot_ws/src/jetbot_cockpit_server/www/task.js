// The chosen robot's task: its title, what its judge says, the time, and the score at the end.

import { element, setClass, setText } from "./dom.js";

export function showTask(task) {
  element("task").hidden = !task;
  setClass(document.body, "task", task);
  setText(element("task-news"), task && task.state !== "driving" ? sentence(task) : ""); // the seconds are not read
  if (!task) return;
  element("task").dataset.state = task.state;
  setText(element("task-title"), task.title);
  setText(element("task-result"), result(task));
  setText(element("task-text"), task.state === "driving" ? "" : task.text);
}

export function inSeconds(seconds) {
  return seconds === null ? "" : `${seconds.toFixed(1)} s`;
}

function result({ state, score, seconds }) {
  if (score !== null) return [`${score.toFixed(1)} points`, inSeconds(seconds)].filter(Boolean).join(", ");
  return state === "driving" ? inSeconds(seconds) : "";
}

function sentence(task) {
  return [`${task.title}:`, result(task) && `${result(task)}.`, task.text].filter(Boolean).join(" ");
}
