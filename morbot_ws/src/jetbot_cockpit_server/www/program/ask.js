// Asks the cockpit for what it keeps; docs/protocol.md explains it.

const [BUSY, FULL] = [503, 507]; // what is over by itself, perhaps

// The cockpit's own sentence why not; again: whether it may be asked again.
export class NotKept extends Error {
  constructor(text, again) {
    super(text);
    this.again = again;
  }
}

// Returns the cockpit's answer; throws a NotKept, or a TypeError if there is none.
export async function ask(fields) {
  const headers = { "Content-Type": "application/json" };
  const answer = await fetch("/work", { method: "POST", headers, body: JSON.stringify(fields) });
  if (answer.ok) return answer.json();
  const { text } = await answer.json().catch(() => ({ text: "The cockpit has refused this." }));
  throw new NotKept(text, [BUSY, FULL].includes(answer.status));
}

// Returns 16 random hexadecimal digits.
export function newId() {
  return Array.from(crypto.getRandomValues(new Uint8Array(8)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
