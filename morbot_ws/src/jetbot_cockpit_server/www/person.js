// What the person wants to be called: kept on this device, sent to the cockpit.

import { element } from "./dom.js";

const STORED = "name";
const UNWANTED = /(?! )[\p{C}\p{Z}]/gu; // control characters and the like, which the cockpit refuses

export class Person {
  // send(message)
  constructor(send) {
    this.send = send;
    element("name").value = load();
    element("name").addEventListener("change", () => this.announce());
    element("name").addEventListener("keydown", (event) => event.key === "Enter" && event.target.blur());
  }

  announce() {
    const name = element("name").value.replace(UNWANTED, "").trim();
    element("name").value = name;
    store(name);
    if (name) this.send({ type: "name", name });
  }
}

function load() {
  try {
    return localStorage.getItem(STORED) ?? "";
  } catch {
    return "";
  }
}

function store(name) {
  try {
    localStorage.setItem(STORED, name);
  } catch { /* the browser stores nothing: the name is typed again next time */ }
}
