// How a person gets in, by a code that is sent once for a cookie, and what they want to be called.

/** @import { Send } from "./link.js" */
/** @import { World } from "./world.js" */

import { element } from "./dom.js";
import { t } from "./language.js";
import { recall, remember, toName } from "./storage.js";

const WRONG = t("This code is wrong, or not valid any more. Ask for the new one.");
const TOO_MANY = t("Too many wrong codes. Wait a minute, and try again.");
const NO_ANSWER = t("The cockpit did not answer: check the network, and try again.");
const STORED_NAME = "name";

// Returns the code after the # of the address and takes it out of there, or "".
export function takeCodeFromAddress() {
  const code = location.hash.slice(1);
  if (location.hash) history.replaceState(history.state, "", location.pathname);
  return code;
}

// Sends the code; returns "" or the sentence why it was refused.
export async function logIn(code) {
  try {
    const headers = { "Content-Type": "application/json" };
    const answer = await fetch("/login", { method: "POST", headers, body: JSON.stringify({ code }) });
    if (answer.ok) return "";
    return answer.status === 429 ? TOO_MANY : WRONG;
  } catch {
    return NO_ANSWER;
  }
}

// Asks for the code, over all else; entered() is called once it is right. The event "ask" closes what else is open.
export class LoginForm {
  asking = false;

  constructor(entered) {
    this.entered = entered;
    this.dialog = element("login");
    this.dialog.addEventListener("cancel", (event) => event.preventDefault()); // by Escape
    this.dialog.addEventListener("close", () => this.asking && this.dialog.showModal()); // by Android's Back
    this.dialog.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.submit();
    });
  }

  ask(error = "") {
    this.asking = true;
    dispatchEvent(new Event("ask"));
    if (!this.dialog.open) this.dialog.showModal();
    element("login-error").textContent = error;
    element("code").focus();
  }

  async submit() {
    const error = await logIn(element("code").value.trim());
    if (error) return this.ask(error);
    this.close();
    this.entered();
  }

  close() {
    this.asking = false;
    this.dialog.close();
    element("code").value = "";
  }
}

// The person's name, kept on this device. send(message)
export class NameField {
  /** @param {World} world @param {Send} send */
  constructor(world, send) {
    this.world = world;
    this.send = send;
    element("name").value = storedName();
    element("name").addEventListener("change", () => this.announce());
    element("name").addEventListener("keydown",
      ({ key, target }) => key === "Enter" && element(target.dataset.next).focus());
  }

  announce() {
    const name = toName(element("name").value);
    element("name").value = name;
    remember(STORED_NAME, name);
    if (name) this.send({ type: "name", name });
  }

  // A teacher's name for the pupil counts. The field does not vanish below somebody's hands: the letters would drive.
  show() {
    const { pupil } = this.world.robot(this.world.me.robot) ?? {};
    element("name").hidden = Boolean(pupil) && element("name") !== document.activeElement;
  }
}

// Returns what the person wants to be called, or "".
export function storedName() {
  return recall(STORED_NAME);
}
