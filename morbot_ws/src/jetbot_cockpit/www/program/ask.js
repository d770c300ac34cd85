// Asks the cockpit for what it keeps; docs/protocol.md explains it.

import { said, t } from "../language.js";

const AGAIN = [403, 503, 507]; // once the code is entered, the disk is idle, or has room
const NO_ANSWER = t("The cockpit does not answer.");
const REFUSED = t("The cockpit has refused this.");

// A sentence why not, the cockpit's own if it has one, with its code; again: whether the same may be asked again.
export class NotKept extends Error {
  constructor(text, code, again) {
    super(text);
    this.code = code;
    this.again = again;
  }
}

// Returns the cockpit's answer; throws a NotKept.
export async function ask(fields) {
  const headers = { "Content-Type": "application/json" };
  const answer = await fetch("/work", { method: "POST", headers, body: JSON.stringify(fields) }).catch(() => null);
  const content = await answer?.json().catch(() => null);
  if (answer?.ok && content) return content;
  const lost = !answer || answer.ok; // perhaps in the middle
  const text = lost ? NO_ANSWER : said(content ?? { text: REFUSED });
  throw new NotKept(text, content?.code ?? "", lost || AGAIN.includes(answer.status));
}

// Returns 16 random hexadecimal digits.
export function newId() {
  return Array.from(crypto.getRandomValues(new Uint8Array(8)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
