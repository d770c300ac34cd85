// The choice of the page's language, in the bar and in the login: another one loads the page again.

import { language, LANGUAGES, WORDS_TIMEOUT } from "./language.js";
import { remember } from "./storage.js";

export function offerLanguages() {
  for (const each of document.querySelectorAll(".language")) offer(each);
}

function offer(select) {
  const option = ([code, name]) => Object.assign(new Option(name, code, false, code === language), { lang: code });
  select.replaceChildren(...Object.entries(LANGUAGES).map(option));
  let byKeys = false; // each arrow key is a change then: Enter or leaving the list ends it
  const choose = async (event) => {
    if (select.value === language) return;
    event.preventDefault(); // Enter opens no list
    const chosen = select.value;
    if (!await reachesCockpit()) return void (select.value = language);
    remember("language", chosen);
    history.replaceState({ ...history.state, byKeys }, "");
    location.reload();
  };
  if (history.state?.byKeys) select.focus(); // where it was before the page was loaded again
  history.replaceState({ ...history.state, byKeys: false }, "");
  for (const type of ["keydown", "pointerdown"]) select.addEventListener(type, () => { byKeys = type === "keydown"; });
  select.addEventListener("change", (event) => byKeys || choose(event));
  select.addEventListener("blur", choose);
  select.addEventListener("keydown", (event) => {
    if (event.key === "Enter") void choose(event);
    if (event.key === "Escape") select.value = language;
  });
}

// Whether the page could be loaded again: one that cannot stays, with its STOP.
async function reachesCockpit() {
  const signal = AbortSignal.timeout?.(WORDS_TIMEOUT);
  return fetch(location.href, { cache: "no-store", signal }).then(() => true, () => false);
}
