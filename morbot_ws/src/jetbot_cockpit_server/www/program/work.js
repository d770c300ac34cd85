// Where the work is kept: on this device.

const KEY = "program";

// Returns { title, program }, both texts, or null.
export function loadWork() {
  try {
    return JSON.parse(localStorage.getItem(KEY));
  } catch { // a browser that stores nothing, or something else is there
    return null;
  }
}

export function keepWork(work) {
  try {
    localStorage.setItem(KEY, JSON.stringify(work));
  } catch { /* it is there until the page is closed */ }
}
