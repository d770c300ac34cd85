// Numbers as a person reads them.

// Returns the number with two places, with a real minus, and without "-0.00".
export function signed(value) {
  const text = value.toFixed(2);
  return Number(text) === 0 ? "0.00" : text.replace("-", "−");
}

// The same, in brackets if it is negative: after an operator.
export function operand(value) {
  const text = signed(value);
  return text.startsWith("−") ? `(${text})` : text;
}
