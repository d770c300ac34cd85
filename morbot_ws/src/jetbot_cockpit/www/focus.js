// The keyboard's focus is never lost: if what had it is hidden, disabled or gone, something else gets it. That is what
// its data-next names, else what is now in its place in its part of the page, else what the part's data-next names.

const FOCUSABLE = "a[href], button, input, select, summary, [tabindex]";

let [last, part, place] = /** @type {any[]} */ ([null, null, 0]); // what had the focus, in which part, at which place

addEventListener("focusin", ({ target }) => {
  last = target;
  part = last.closest("section, dialog");
  place = usable(part).indexOf(last);
});
addEventListener("click", () => keepFocus()); // by Enter, too: it may have closed what it is in

// Something on the page has changed.
export function keepFocus() {
  const { activeElement, body } = document;
  if (last && !isUsable(last) && (activeElement === body || activeElement === last)) successor()?.focus();
}

// Lets the keyboard reach each text that scrolls, only while it does.
export function reachScrollers() {
  for (const each of document.querySelectorAll(".scrolls")) {
    if (each.scrollHeight > each.clientHeight) each.setAttribute("tabindex", "0");
    else each.removeAttribute("tabindex");
  }
}

function isUsable(each) {
  return each?.isConnected && each.getClientRects().length > 0 && !each.disabled && !each.closest("[inert]");
}

/** @returns {any[]} */
function usable(around) {
  return [...around?.querySelectorAll(FOCUSABLE) ?? []].filter(isUsable);
}

function successor() {
  const [named, others] = [(each) => document.getElementById(each?.dataset.next ?? ""), usable(part)];
  return [named(last), others[place], others.at(-1), named(part)].find(isUsable) ?? usable(document)[0];
}
