// Draws the curves: strips above each other, which share the time. A value holds until the next one, as nothing else
// is known of the time in between; where there is room, a dot shows each value that came.

/** @import { Series, Strip } from "./series.js" */
/** @import { Timeline } from "./timeline.js" */
/** @typedef {["best" | "earlier" | "current", any, number]} Row */

import { number, t } from "../language.js";
import { Path } from "./path.js";
import { axis, scaleOf, ticks } from "./scale.js";
import { COLORS, DASHES, digits, trackOf, valueAt } from "./series.js";
import { LEFT } from "./timeline.js";

const [TITLE, FOOT, GAP] = [22, 18, 4]; // px: above a strip, below all, between two
const STRIP = 62; // px of a strip, at least
const [LINE, KEY, DIGITS] = [17, 27, 54]; // px: a line of a legend; a series' dash, and room for its value
const FONT = "12px system-ui, sans-serif";
const NOTHING = t("Nothing was reported.");
const DOTS = 7; // px between two values from which on each has a dot
const STYLES = { // of the drives
  best: { globalAlpha: 0.3, lineWidth: 5 },
  earlier: { globalAlpha: 0.4, lineWidth: 1.5 },
  current: { globalAlpha: 1, lineWidth: 2 },
};

// Returns the height in px that these strips need.
/** @param {Strip[]} strips @param {CanvasRenderingContext2D} context */
export function heightOf(strips, context, width) {
  const heights = strips.map((strip) => STRIP + GAP + legend(strip, context, width).height);
  return heights.reduce((sum, each) => sum + each, FOOT);
}

// Returns where the legend of a strip has each series, [left, down] in px, and its height below the first line.
// It does not depend on the values: nothing jumps while they change.
function legend({ title, unit, series }, context, width) {
  context.font = FONT;
  const measure = (text) => context.measureText(text).width;
  let [left, down] = [14 + measure(unit ? `${title} (${unit})` : title), 0];
  const places = series.map(({ name }) => {
    const room = KEY + measure(name) + DIGITS;
    if (left + room > width && left > 4) [left, down] = [4, down + LINE];
    left += room;
    return [left - room, down];
  });
  return { places, height: down };
}

export class Plot {
  // colors: by the names of the page's styles
  /** @param {CanvasRenderingContext2D} context @param {Timeline} timeline @param {Record<string, string>} colors */
  constructor(context, timeline, colors) {
    this.context = context;
    this.timeline = timeline;
    this.colors = colors;
    context.font = FONT;
  }

  // drives: rows of [kind, drive, until], kinds of STYLES, the current one last; until: s, what is newer is not shown
  /** @param {Strip[]} strips @param {Row[]} drives */
  draw(strips, drives, height) {
    const { context, timeline: { width } } = this;
    context.fillStyle = this.colors.surface;
    context.fillRect(0, 0, width, height);
    const free = (height - heightOf(strips, context, width)) / Math.max(1, strips.length);
    let top = 0;
    for (const strip of strips) {
      const { places, height: below } = legend(strip, context, width);
      const bottom = top + STRIP + below + free;
      this.title(strip, drives.slice(-1)[0], places, top + TITLE - 13);
      this.strip(strip, drives, { left: LEFT, top: top + TITLE + below, right: width, bottom });
      top = bottom + GAP;
    }
    this.times(height);
    this.cursor(height);
  }

  strip(strip, drives, box) {
    const scale = scaleOf(strip, drives, this.timeline, box);
    this.grid(scale, box);
    if (!scale.known) return this.text(NOTHING, (box.left + box.right) / 2, (box.top + box.bottom) / 2, "center");
    this.inside(box, () => {
      for (const [kind, drive, until] of drives) {
        Object.assign(this.context, STYLES[kind]);
        for (const series of strip.series) this.trace(drive, series, until, scale, kind === "current");
      }
    });
  }

  inside({ left, top, right, bottom }, draw) {
    const { context } = this;
    context.save();
    context.beginPath();
    context.rect(left, top - 2, right - left, bottom - top + 4);
    context.clip();
    draw();
    context.restore();
  }

  // The name of a strip, and of each series how it is drawn, its name, and its value.
  title({ title, unit, places, series: all }, [, drive, until], keys, top) {
    Object.assign(this.context, STYLES.current);
    this.text(unit ? `${title} (${unit})` : title, 4, top, "left", "muted");
    const moment = Math.min(this.timeline.cursor ?? Infinity, until - drive.start, drive.length);
    all.forEach((each, index) => {
      const [left, middle] = [keys[index][0], top + keys[index][1]];
      const shown = digits(valueAt(drive, each, moment), places);
      this.line(each, [[left, middle], [left + KEY - 5, middle]]);
      this.text(`${each.name} ${shown}`.trim(), left + KEY, middle, "left", "text");
    });
  }

  grid({ low, high, y }, { left, right, top, bottom }) {
    const { context, colors } = this;
    const values = ticks(low, high, (bottom - top) / 22);
    for (const value of values) {
      context.fillStyle = Math.abs(value) < 1e-9 ? colors.axis : colors.grid;
      context.fillRect(left, Math.round(y(value)), right - left, 1);
      this.text(number(axis(value, values)), left - 5, y(value), "right", "muted", left - 7);
    }
  }

  times(height) {
    const { timeline } = this;
    const [from, to] = timeline.shown;
    const values = ticks(from, to, (timeline.width - LEFT) / 60);
    for (const value of values) {
      const right = Math.min(timeline.right(value), timeline.width - 14);
      this.text(t("{seconds} s", { seconds: axis(value, values) }), right, height - 8, "center", "muted");
    }
  }

  cursor(height) {
    const { timeline: { cursor, width }, timeline } = this;
    if (cursor === null || timeline.right(cursor) < LEFT || timeline.right(cursor) > width) return;
    this.context.fillStyle = this.colors.text;
    this.context.fillRect(Math.round(timeline.right(cursor)), 0, 1, height - FOOT);
  }

  // A series of a drive, until a time.
  trace(drive, series, until, { y }, dots) {
    const track = trackOf(drive, series);
    if (!track) return;
    const [from, to] = this.timeline.shown.map((time) => drive.start + time);
    const path = new Path(series.hold);
    const last = Math.min(track.count, track.until(Math.min(to, until)) + 1);
    for (let index = Math.max(0, track.until(from) - 1); index < last && track.at(index) <= until; index += 1) {
      const stamp = track.at(index);
      path.add(stamp, this.timeline.right(stamp - drive.start), y(track.at(index, series.column)));
    }
    this.line(series, path.points);
    if (dots) this.dots(path.points);
  }

  // points: in px; null: the line is interrupted
  line({ style }, points) {
    const { context } = this;
    context.strokeStyle = context.fillStyle = this.colors[`curve-${style % COLORS}`];
    context.setLineDash(DASHES[style % DASHES.length]);
    context.beginPath();
    let draws = false;
    for (const point of points) {
      if (point) context[draws ? "lineTo" : "moveTo"](point[0], point[1]);
      draws = point !== null;
    }
    context.stroke();
    context.setLineDash([]);
  }

  dots(points) {
    const values = points.filter((point) => point?.[2]);
    if (!values.length || (values.at(-1)[0] - values[0][0]) / values.length < DOTS && values.length > 1) return;
    for (const [right, down] of values) {
      this.context.beginPath();
      this.context.arc(right, down, 2.5, 0, 7);
      this.context.fill();
    }
  }

  // Draws a text, made narrower where it is wider than most, in px.
  /** @param {number} [most] */
  text(text, right, down, textAlign, color = "muted", most) {
    Object.assign(this.context, { textAlign, textBaseline: "middle", fillStyle: this.colors[color] });
    this.context.fillText(text, right, down, most);
  }
}
