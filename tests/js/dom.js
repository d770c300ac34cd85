// What modules of the page ask of the browser as they begin; a test changes it.

export const style = { "--calm-ground": "#ffffff", "--text": "#000000" }; // the page's colours
const elements = {};
const darkens = [];

Object.assign(globalThis, {
  document: { documentElement: {}, getElementById: (id) => elements[id] ??= { hidden: true } },
  matchMedia: () => ({ addEventListener: (_, call) => darkens.push(call) }),
  getComputedStyle: () => ({ getPropertyValue: (name) => ` ${style[name]}` }),
  Path2D: class {
    points = [];

    lineTo(...point) {
      this.points.push(point);
    }
  },
});

// The person chooses a dark page, or a light one.
export function restyle(colors) {
  Object.assign(style, colors);
  darkens.forEach((call) => call());
}
