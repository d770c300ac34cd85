// How the chosen robot is, by what its battery and its computer measure: warnings at once, all else when asked for.

/** @import { Health, Robot } from "./messages.js" */
/** @import { State, World } from "./world.js" */

import { create, element, setText } from "./dom.js";
import { t } from "./language.js";

const LEVELS = ["ok", "warning", "bad"];
let shown = ""; // what the list shows

export function prepareHealth(changed) {
  element("show-health").addEventListener("click", () => {
    element("show-health").setAttribute("aria-expanded", String(!isOpen()));
    changed();
  });
}

function isOpen() {
  return element("show-health").getAttribute("aria-expanded") === "true";
}

// Returns what a teacher or pupil can do something about.
/** @param {State} state */
export function warningsOf({ health }) {
  return (health ?? []).filter(({ level }) => level !== "ok");
}

// Returns how full the battery is, such as "86 %", or "" if it is not known.
/** @param {State} state */
export function batteryOf({ health }) {
  const percent = health?.find(({ code }) => code === "battery")?.arguments.percent;
  return percent ? `${percent} %` : "";
}

// Shows the chosen robot's.
/** @param {World} world */
export function showHealth(world) {
  const [robot, state] = [world.robot(world.chosen), world.state(world.chosen)];
  const known = robot && (state.health?.length || robot.address);
  element("show-health").hidden = !known;
  showButton(state);
  const rows = known && isOpen() ? state.health ?? [] : warningsOf(state);
  showRows(robot ? rows : []);
  showLink(robot, known && isOpen());
  element("health").hidden = !robot || !rows.length && element("own-page").hidden;
  announce(robot && world.isAway(robot.id) ? [] : warningsOf(state));
}

function showButton(state) {
  const button = element("show-health");
  const battery = batteryOf(state);
  button.dataset.health = LEVELS[Math.max(0, ...warningsOf(state).map(({ level }) => LEVELS.indexOf(level)))];
  setText(button, battery || t("Health"));
  button.setAttribute("aria-label", battery ? t("Health: battery {percent}", { percent: battery }) : t("Health"));
}

/** @param {Health[]} rows */
function showRows(rows) {
  const sentences = rows.map(({ template, arguments: values, level }) => ({ text: t(template, values), level }));
  const next = JSON.stringify(sentences);
  if (next === shown) return;
  shown = next;
  element("health-list").replaceChildren(...sentences.map(({ text, level }) => {
    const item = create("li", "", text);
    item.dataset.health = level;
    return item;
  }));
}

/** @param {Robot | undefined} robot */
function showLink(robot, open) {
  const link = element("own-page");
  link.hidden = !open || !robot?.address;
  if (link.hidden) return;
  link.href = robot?.address;
  setText(link, t("Page of {robot}", { robot: robot?.label }));
}

// A screen reader says a warning when it begins, not whenever its numbers change.
/** @param {Health[]} rows */
function announce(rows) {
  const news = element("health-news");
  const codes = rows.map(({ code, level }) => `${code} ${level}`).join();
  if (news.dataset.codes === codes) return;
  news.dataset.codes = codes;
  setText(news, rows.map(({ template, arguments: values }) => t(template, values)).join(" "));
}
