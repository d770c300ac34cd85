// The curves on a page: what the chosen robot does over time, above the drives before.

/** @import { Shell } from "../shell.js" */
/** @import { Drive } from "./drive.js" */
/** @import { Row } from "./plot.js" */

import { create, setClass } from "../dom.js";
import { t } from "../language.js";
import { Controls } from "./controls.js";
import { Drives } from "./drives.js";
import { heightOf, Plot } from "./plot.js";
import { COLORS, describe, printedStrip, STRIPS } from "./series.js";
import { Timeline } from "./timeline.js";

const SETTLED = 0.1; // s after which all topics' values have come: what a person holds does not change
const SILENCE_TIMEOUT = 3000; // ms without a value until the cockpit is asked again: the robot was away
const CURVES = Array.from({ length: COLORS }, (_, index) => `curve-${index}`);
const STYLES = ["surface", "text", "muted", "grid", "axis", ...CURVES];

/** @type {Promise<Curves> | null} */
let loaded = null; // promises those of this page

// Returns the page's curves, at first hidden in this part of it.
/** @param {Shell} shell @param {HTMLElement} place @param {() => any} run @param {(() => void) | null} close */
export function loadCurves(shell, place, run, close = null) {
  return loaded ??= load(shell, place, run, close);
}

async function load(shell, place, run, close) {
  const style = Object.assign(create("link"), { rel: "stylesheet", href: new URL("curves.css", import.meta.url).href });
  await new Promise((resolve) => {
    style.onload = style.onerror = resolve; // without it, the page still shows them
    document.head.append(style);
  });
  return new Curves(shell, place, run, close);
}

class Curves {
  drives = new Drives();
  /** @type {{ kept: any[], until: number } | null} */
  held = null; // the picture that a person holds: of which drives, until when
  asked = ""; // what, by which connection
  /** @type {string | null} */
  of = null; // the robot
  heardAt = 0; // when its last values came
  /** @type {Drive | null} */
  judged = null; // the drive that a judge watches
  ran = null; // the program's run that the newest drive is of

  constructor(shell, place, run, close) {
    this.shell = shell;
    this.run = run;
    this.root = Object.assign(create("div"), { id: "curves", hidden: true });
    this.canvas = Object.assign(create("canvas"), { role: "img", ariaLabel: t("Curves over time") });
    this.slider = Object.assign(create("input"), {
      id: "curves-moment", type: "range", min: "0", step: "0.01", ariaLabel: t("Moment"),
    });
    this.timeline = new Timeline(this.canvas, () => shell.show());
    this.controls = new Controls(this, close);
    this.box = create("div", "plot");
    this.box.append(this.slider, this.canvas);
    this.root.append(this.controls.root, this.box);
    place.insertBefore(this.root, place.querySelector("#output-title"));
    this.slider.addEventListener("input", () => this.timeline.read(Number(this.slider.value)));
    new ResizeObserver(() => shell.show()).observe(this.canvas);
    shell.receivers.curves = (message) => this.receive(message);
    document.addEventListener("visibilitychange", () => this.ask());
    this.ask();
  }

  show(on) {
    this.root.hidden = !on;
    this.root.parentElement?.classList.toggle("curved", on);
    this.shell.show();
  }

  // Asks for what the chosen robot reports, from the first time that a person has seen curves on.
  ask() {
    const { world, link } = this.shell;
    const { chosen } = world;
    const wanted = !document.hidden && world.robot(chosen) && world.state(chosen).answers ? chosen : null;
    const question = { type: /** @type {const} */ ("curves"), robot: wanted, eyes: this.controls.isOn("eyes") };
    const asked = JSON.stringify([question, world.me.id]);
    const isSilent = wanted && performance.now() - this.heardAt > SILENCE_TIMEOUT;
    if (!link.connected || asked === this.asked && !isSilent || !this.shell.send(question)) return;
    if (wanted && wanted !== this.of) this.forget(wanted);
    Object.assign(this, { asked, heardAt: performance.now() });
  }

  // Another robot is chosen.
  forget(robot) {
    this.of = robot;
    this.drives = new Drives();
    this.hold(false);
    this.timeline.all();
  }

  receive(message) {
    if (message.robot !== this.of) return;
    this.heardAt = performance.now();
    this.follow();
    this.drives.take(message);
  }

  // Looks whether the page's program has begun or ended.
  follow() {
    const run = this.run();
    if (this.drives.running && (run !== this.ran || run.over)) this.drives.ended();
    if (!run || run === this.ran || !run.clock.start) return;
    this.ran = run;
    this.drives.run(run.clock.start);
  }

  printed(name, value) {
    this.follow();
    if (this.drives.running) this.drives.print(String(name), value);
  }

  noteScore() {
    const { task } = this.shell.world.state(this.of);
    if (task?.state === "driving") this.judged = this.drives.current;
    if (task?.state !== "done" || !this.judged) return;
    Object.assign(this.judged, { score: task.score, task: task.name });
    this.judged = null;
  }

  hold(on) {
    const { kept, current } = this.drives;
    const until = current.start + current.length - SETTLED;
    this.held = on && until > 0 ? { kept, until } : null; // there is something to hold
    this.shell.show();
  }

  // The drives that a person wants to see, the newest first.
  get shown() {
    const { kept } = this.held ?? this.drives;
    return kept.filter((drive, index) => !index || this.controls.shows(drive));
  }

  get strips() {
    const strips = [...STRIPS, printedStrip(this.shown)];
    return strips.filter(({ id, series }) => this.controls.isOn(id) && series.length);
  }

  draw() {
    this.ask();
    this.follow();
    this.noteScore();
    if (!this.canvas.clientWidth) return;
    const { shown, strips, drives: { best } } = this;
    const context = this.canvas.getContext("2d");
    this.canvas.style.minHeight = `${heightOf(strips, context, this.canvas.clientWidth)}px`;
    setClass(this.box, "scrolled", this.canvas.clientHeight > this.box.clientHeight);
    const until = this.held?.until ?? Infinity;
    this.timeline.length = Math.max(...shown.map((drive) => Math.min(drive.length, until - drive.start)));
    const kind = (drive, index) => (index === 0 ? "current" : drive === best ? "best" : "earlier");
    const row = (drive, index) => /** @type {Row} */ ([kind(drive, index), drive, index ? Infinity : until]);
    const rows = shown.map(row).reverse();
    new Plot(this.fitCanvas(), this.timeline, this.colors()).draw(strips, rows, this.canvas.clientHeight);
    this.controls.draw();
    this.read(shown[0], strips, until);
  }

  // Says the values at the moment that the keyboard has chosen.
  read(drive, strips, until) {
    const { slider, timeline } = this;
    const moment = Math.min(timeline.cursor ?? Infinity, until - drive.start, drive.length);
    slider.max = String(timeline.length);
    slider.value = String(moment);
    slider.ariaValueText = describe(drive, strips, moment);
  }

  fitCanvas() {
    const { canvas } = this;
    const ratio = devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((each) => Math.round(each * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return context;
  }

  colors() {
    const style = getComputedStyle(this.root);
    return Object.fromEntries(STYLES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }
}
