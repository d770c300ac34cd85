// A cockpit that a test plays: what /work is asked, and what it answers.

import { settled } from "./clock.js";

export const LOST = null; // an answer

// Answers each request by answer(fields): an object, a refusal, LOST, or a promise. Returns all requests.
export function playCockpit({ mock }, answer) {
  const asked = [];
  mock.method(globalThis, "fetch", async (address, { body }) => {
    const fields = JSON.parse(body);
    asked.push(fields);
    const given = await answer(fields, asked.length);
    if (given === LOST) throw new TypeError("no network");
    const { status = 200, ...content } = given;
    return { ok: status === 200, status, json: async () => content };
  });
  return asked;
}

// text: in English; a page shows the template, in its own language
export function refuse(status, template, code = "") {
  return { status, code, template, arguments: {}, text: "in English" };
}

// Returns a promise, and what fulfils it.
export function later() {
  let answer;
  const promise = new Promise((resolve) => {
    answer = (given) => {
      resolve(given);
      return settled();
    };
  });
  return { promise, answer };
}
