// What the cockpit and its pages agree about: numbers, which "hello" brings.

export const limits = {};
