// What the cockpit and its pages agree about: numbers, which "hello" brings.

export const limits = /** @type {import("./messages.js").Limits} */ ({});
