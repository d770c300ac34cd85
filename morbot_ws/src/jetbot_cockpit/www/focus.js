// The keyboard's focus is never lost: if what had it is hidden, disabled or gone, what is next on the page has it.

const FOCUSABLE = "a[href], button, input, select, [tabindex]";

let [last, part] = /** @type {any[]} */ ([null, null]); // what had the focus, and in which part of the page

addEventListener("focusin", ({ target }) => {
  last = target;
  part = last.closest("section, dialog");
});

// Something on the page has changed.
export function keepFocus() {
  const { activeElement, body } = document;
  if (last && !isUsable(last) && (activeElement === body || activeElement === last)) nextOf(last)?.focus();
}

function isUsable(each) {
  return each.isConnected && each.getClientRects().length > 0 && !each.disabled && !each.closest("[inert]");
}

// Returns the next one in its part, else the one before, else the page's first.
function nextOf(lost) {
  const others = [...part?.querySelectorAll(FOCUSABLE) ?? []].filter(isUsable);
  const after = others.find((each) => lost.compareDocumentPosition(each) & Node.DOCUMENT_POSITION_FOLLOWING);
  return after ?? others.at(-1) ?? [...document.querySelectorAll(FOCUSABLE)].find(isUsable);
}
