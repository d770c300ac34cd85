// The code that lets a person in: from the address, or typed. It is sent once, for a cookie.

import { element } from "./dom.js";

const WRONG = "This code is wrong. Codes change when the cockpit starts again.";
const TOO_MANY = "Too many wrong codes. Wait a minute, and try again.";
const NO_ANSWER = "The cockpit does not answer: check the network, and try again.";

// Returns the code after the # of the address and takes it out of there, or "".
export function takeCodeFromAddress() {
  const code = decodeURIComponentOrNothing(location.hash.slice(1));
  if (location.hash) history.replaceState(null, "", location.pathname);
  return code;
}

function decodeURIComponentOrNothing(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return "";
  }
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

// Asks for the code; entered() is called once it is right.
export class LoginForm {
  constructor(entered) {
    this.entered = entered;
    element("login").addEventListener("submit", (event) => {
      event.preventDefault();
      this.submit();
    });
  }

  ask(error = "") {
    element("cockpit").inert = true;
    element("login").hidden = false;
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
    element("login").hidden = true;
    element("cockpit").inert = false;
    element("code").value = "";
  }
}
