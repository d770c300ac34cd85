// One run of a program in this page: Pause, Step, Stop, how fast, and the robot that it drives. An engine runs the
// program itself: interpreter.js blocks, python/engine.js a text.

/** @import { Send } from "../link.js" */
/** @import { Robot } from "../messages.js" */

import { t } from "../language.js";
import { Clock } from "./clock.js";
import { HOLD, Motion } from "./motion.js";
import { ProgramError } from "./program_error.js";
import { excess, UNUSED } from "./remarks.js";
import { Senses } from "./senses.js";

const SLICE = 8; // ms that a program computes before the page has its turn
const HEARTBEAT = 50; // ms
const FROZEN = 300; // ms without a heartbeat: the cockpit has stopped the robot meanwhile
const READY_TIMEOUT = 4000; // ms until a robot's controller is connected, and its sensors report
const NOT_READY = t("The robot did not get ready in time. Try again, or tell your teacher.");
const INTERRUPTED = t("This page was interrupted, so the robot stopped.");

export class Run {
  clock = new Clock();
  over = false;
  held = false; // whether the person has paused it
  at = null; // the statement that runs: its block's id, or its line's number
  entered = false; // whether that is a loop that has named itself twice: it begins its first round
  /** @type {{ text: string, place: any } | null} */
  limit = null; // of the first command that is more than the wheels can, or of the last one if it was never driven
  published = [0, 0]; // x, z: what the robot drove last
  drivenAt = Infinity; // when the program waited last, by its clock; Infinity: it waits
  awakeAt = performance.now(); // when the page had its last turn
  pulse = 0; // the timer that notices when the page gets no turn

  // engine: prepare(), run(state) yields the program's events, end(); motion, variables, needs, repeats; robot: as the
  // cockpit describes it; stepping: it pauses before its first statement; send(message); printed(event); changed();
  // delay(): ms before each statement; ended(sentence, place): why, "" at the program's end; place: where it failed
  /** @param {Record<string, any> & { prepare: () => Promise<void> }} engine @param {Robot} robot @param stepping
   * @param {Record<string, any> & { send: Send }} page */
  constructor(engine, robot, stepping, { send, printed, changed, ended, delay }) {
    this.engine = engine;
    this.robot = robot;
    this.stepping = stepping;
    this.send = send;
    this.printed = printed;
    this.changed = changed;
    this.ended = ended;
    this.delay = delay;
    this.senses = new Senses(engine.needs, () => send({ type: "program", robot: robot.id }));
    this.motion = new Motion((forward, left) => this.command(forward, left));
    this.motion.end(); // the cockpit obeys this page again only after a zero
    this.pulse = setInterval(() => this.wakeUp(), HEARTBEAT); // also while an engine elsewhere computes
    this.execute().catch((error) => {
      if (!(error instanceof ProgramError)) console.error(error);
      this.end(error.message, error.place);
    });
  }

  // Ends the program, and stops the robot.
  end(sentence = "", place = null) {
    if (this.over) return;
    clearInterval(this.pulse);
    this.motion.end();
    this.engine.end();
    this.over = true;
    this.ended(sentence, place);
  }

  // Pauses: the robot stands, and so does the clock.
  pause() {
    this.held = true;
    this.stand();
    this.changed();
  }

  resume() {
    this.held = this.stepping = false;
    this.clock.goOn();
    this.changed();
  }

  // Runs one statement.
  step() {
    this.resume();
    this.stepping = true;
  }

  stand() {
    this.clock.stop();
    this.motion.set(0, 0);
  }

  async execute() {
    await this.engine.prepare();
    await this.prepare();
    if (this.over) return;
    this.senses.begin();
    this.clock.begin();
    this.drivenAt = this.clock.now;
    this.wakeUp(); // a page that was busy until now has frozen no drive
    this.motion.begin();
    for await (const event of this.engine.run(() => this.state)) {
      if ("print" in event || "name" in event) this.printed(event);
      else if ("step" in event) await this.before(event.step);
      else if ("breathe" in event) await this.between();
      else await this.drive(event);
      if (this.over) return;
    }
    this.noteUnused();
    this.end();
  }

  // Waits until the robot is this page's.
  async prepare() {
    const end = performance.now() + READY_TIMEOUT;
    while (!this.over && !this.senses.complete && performance.now() < end) {
      this.senses.refresh();
      await this.sleep();
    }
    if (!this.senses.answer.ready) throw new ProgramError(NOT_READY);
  }

  // What the engine asks of the run.
  get state() {
    const slow = this.held || this.stepping || this.delay() > 0;
    return { slow, seconds: this.clock.seconds, senses: { ...this.senses.values, command: this.published } };
  }

  // Whether it has computed for so long that the robot stands still.
  get waitless() {
    return this.clock.now - this.drivenAt > HOLD;
  }

  noteLimit() {
    const text = excess(this.engine.motion, this.robot);
    if (text) this.limit ??= { text, place: this.at };
  }

  noteUnused() {
    const { motion } = this.engine;
    if (motion !== this.published && motion.some(Boolean)) this.limit ??= { text: UNUSED, place: null };
  }

  // Comes before each statement: shows it, and waits if the program is slow or paused.
  async before(place) {
    this.noteLimit();
    this.entered = place === this.at && !this.entered;
    this.at = place;
    if (this.stepping && !this.entered) this.pause();
    else if (this.delay() && !this.entered) await this.rest();
    await this.between();
  }

  // Lets the page have its turn if the program has computed for long, and waits while it is paused.
  async between() {
    if (performance.now() - this.awakeAt > SLICE) {
      if (this.senses.used) this.senses.refresh();
      await this.sleep(0);
    }
    await this.goAhead();
  }

  // Waits while it is paused.
  async goAhead() {
    while (this.held && !this.over) await this.sleep();
  }

  // Lets the robot stand for a moment before a statement of a slow program.
  async rest() {
    this.stand();
    const end = performance.now() + this.delay();
    while (!this.over && !this.held && performance.now() < end) await this.sleep(end - performance.now());
    if (!this.held) this.clock.goOn();
  }

  async drive({ wait, tick, publish }) {
    await this.goAhead(); // several commands of a text come at a time
    this.noteLimit();
    if (publish || this.engine.repeats) this.publish();
    this.drivenAt = Infinity;
    if (tick) await this.until(this.clock.nextTick());
    else if (wait > 0) await this.until(this.clock.afterWait(wait));
    this.drivenAt = this.clock.now;
    if (this.over || !this.senses.used || !this.senses.refresh()) return;
    await this.senses.wait();
    this.wakeUp();
  }

  async until(due) {
    while (!this.over && (this.clock.stands || this.clock.now < due)) {
      this.motion.changesAt = due + this.clock.lost;
      await this.sleep(this.clock.stands ? HEARTBEAT : due - this.clock.now);
      if (this.engine.repeats && !this.over && !this.clock.stands && this.clock.now < due) this.publish();
    }
  }

  publish() {
    this.published = this.engine.motion;
    this.motion.publish(this.published, this.robot);
  }

  async sleep(ms = HEARTBEAT) {
    await new Promise((resolve) => { setTimeout(resolve, Math.min(Math.ceil(ms), HEARTBEAT)); });
    this.wakeUp();
  }

  wakeUp() {
    if (this.motion.timer) this.endIfFrozen(); // a slow tablet may take its time to load Python
    this.awakeAt = performance.now();
  }

  endIfFrozen() {
    if (performance.now() - this.awakeAt > FROZEN) this.end(INTERRUPTED);
  }

  command(forward, left) {
    const moves = forward || left;
    if (moves) this.endIfFrozen();
    if (!moves || !this.over) this.send({ type: "drive", robot: this.robot.id, forward, left });
  }
}
