// What this device remembers, and texts as the cockpit takes them.

const UNWANTED = /(?! )[\p{C}\p{Z}]/gu; // control characters and the like, which the cockpit refuses in a name

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

// Returns a name that the cockpit takes, or "".
export function toName(text) {
  return text.replace(UNWANTED, "").trim();
}
