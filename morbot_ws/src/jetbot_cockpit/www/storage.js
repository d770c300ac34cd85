// What this device remembers, and texts as the cockpit takes them.

// Control characters, ends of lines, what reverses the text around it, and halves of characters; as in jetbot/text.py.
const HARMFUL = /[\p{Cc}\p{Cs}\u2028-\u202e\u2066-\u2069]/gu;
const VISIBLE = /[^\p{C}\p{Z}]/u;

// Returns the text that is kept under this key, or "".
export function recall(key) {
  try {
    return localStorage.getItem(key) ?? "";
  } catch { // a browser that stores nothing
    return "";
  }
}

export function remember(key, text) {
  try {
    localStorage.setItem(key, text);
  } catch { /* it is asked for again next time, or the cockpit keeps it */ }
}

// Returns the text without what is harmful where it is shown: one line, in the scripts and emoji of all languages.
export function toText(text) {
  return text.replace(HARMFUL, "");
}

// Returns the beginning of a text, of so many UTF-16 units at most, in whole characters: an emoji family is one.
export function beginning(text, longest) {
  let end = 0;
  for (const { length } of characters(text)) {
    if (end + length > longest) break;
    end += length;
  }
  return text.slice(0, end).replace(/\u200d+$/, ""); // a joiner that joins nothing
}

function characters(text) {
  if (!Intl.Segmenter) return text; // Firefox before 125: its iterator yields code points
  return Array.from(new Intl.Segmenter().segment(text), ({ segment }) => segment);
}

// Returns a name that the cockpit takes, or "" if there is nothing to see.
export function toName(text) {
  const name = toText(text).trim();
  return VISIBLE.test(name) ? name : "";
}
