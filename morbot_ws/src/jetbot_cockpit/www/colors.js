// The robots' colours, as they stand out from every ground of the page, light or dark.

const CONTRAST = 3; // to the ground, as WCAG 2.1 (1.4.11) asks for
const STEP = 0.05; // of the way to the text's colour

const seen = new Map(); // by the colour that a robot has elsewhere
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => seen.clear());

// Returns "#rrggbb" as this page shows it: mixed with the text's colour until its contrast suffices.
export function visible(color) {
  if (!seen.has(color)) seen.set(color, adjust(parts(color), styled("--calm-ground"), styled("--text")));
  return seen.get(color);
}

function adjust(color, ground, text, share = 0) {
  const mixed = color.map((part, index) => Math.round(part + share * (text[index] - part)));
  if (share < 1 && contrast(mixed, ground) < CONTRAST) return adjust(color, ground, text, share + STEP);
  return `#${mixed.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
}

function styled(name) {
  return parts(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
}

function parts(color) {
  return [1, 3, 5].map((place) => parseInt(color.slice(place, place + 2), 16));
}

function contrast(one, other) {
  const [dark, light] = [luminance(one), luminance(other)].sort((low, high) => low - high);
  return (light + 0.05) / (dark + 0.05);
}

// Returns the relative luminance, as WCAG defines it.
function luminance(color) {
  const linear = color.map((part) => part / 255).map((part) =>
    part <= 0.03928 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}
