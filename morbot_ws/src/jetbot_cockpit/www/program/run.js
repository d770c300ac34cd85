// One run of a program in this page: Pause, Step, Stop, how fast, and the robot that it drives.

/** @import { Send } from "../link.js" */
/** @import { Robot } from "../messages.js" */

import { t } from "../language.js";
import { Clock } from "./clock.js";
import { Interpreter } from "./interpreter.js";
import { HOLD, Motion } from "./motion.js";
import { ProgramError } from "./program_error.js";
import { excess, UNUSED } from "./remarks.js";
import { Senses } from "./senses.js";

const SLICE = 8; // ms that a program computes before the page has its turn
const HEARTBEAT = 50; // ms; no sleep is longer
const FROZEN = 300; // ms without a heartbeat: the cockpit has stopped the robot meanwhile
const READY_TIMEOUT = 4000; // ms until a robot's controller is connected, and its sensors report
const NOT_READY = t("The robot did not get ready in time. Try again, or tell your teacher.");
const NOTHING = t("Nothing is below \"when the program starts\": drag blocks there.");
const INTERRUPTED = t("This page was interrupted, so the robot stopped.");

export class Run {
  clock = new Clock();
  over = false;
  held = false; // whether the person has paused it
  at = null; // the id of the block whose statement runs
  entered = false; // whether that is a loop that has named itself twice: it begins its first round
  /** @type {{ text: string, block: string | null } | null} */
  limit = null; // of the first command that is more than the wheels can, or of the last one if it was never driven
  published = [0, 0]; // x, z: what the robot drove last
  drivenAt = Infinity; // when the program waited last, by its clock; Infinity: it waits
  awakeAt = performance.now(); // when the page had its last turn

  // robot: as the cockpit describes it; stepping: it pauses before its first statement; send(message); printed(text);
  // changed(); delay(): ms before each statement;
  // ended(sentence, block): why, "" at the program's end; block: the id of where it failed
  /** @param program @param {Robot} robot @param stepping @param {Record<string, any> & { send: Send }} page */
  constructor(program, robot, stepping, { send, printed, changed, ended, delay }) {
    this.robot = robot;
    this.stepping = stepping;
    this.send = send;
    this.printed = printed;
    this.changed = changed;
    this.ended = ended;
    this.delay = delay;
    this.senses = new Senses(program, () => send({ type: "program", robot: robot.id }));
    const { clock } = this;
    this.interpreter = new Interpreter(program, robot, () => ({ ...this.senses.values, seconds: clock.seconds }));
    this.motion = new Motion((forward, left) => this.command(forward, left));
    this.motion.end(); // the cockpit obeys this page again only after a zero
    this.execute().catch((error) => {
      if (!(error instanceof ProgramError)) console.error(error);
      this.end(error.message, error.block);
    });
  }

  // Ends the program, and stops the robot.
  end(sentence = "", block = null) {
    if (this.over) return;
    this.motion.end();
    this.over = true;
    this.ended(sentence, block);
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
    const { start } = this.interpreter;
    if (!start?.next) throw new ProgramError(NOTHING, start?.id);
    await this.prepare();
    if (this.over) return;
    this.senses.begin();
    this.clock.begin();
    this.drivenAt = this.clock.now;
    this.motion.begin();
    for (const event of this.interpreter.run()) {
      if ("print" in event) this.printed(event.print);
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

  // Whether it has computed for so long that the robot stands still.
  get waitless() {
    return this.clock.now - this.drivenAt > HOLD;
  }

  noteLimit() {
    const text = excess(this.interpreter.motion, this.robot);
    if (text) this.limit ??= { text, block: this.at };
  }

  noteUnused() {
    const { motion } = this.interpreter;
    if (motion !== this.published && motion.some(Boolean)) this.limit ??= { text: UNUSED, block: null };
  }

  // Comes before each statement: shows it, and waits if the program is slow or paused.
  async before(block) {
    this.noteLimit();
    this.entered = block === this.at && !this.entered;
    this.at = block;
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
    while (this.held && !this.over) await this.sleep();
  }

  // Lets the robot stand for a moment before a statement of a slow program.
  async rest() {
    this.stand();
    const end = performance.now() + this.delay();
    while (!this.over && !this.held && performance.now() < end) await this.sleep(end - performance.now());
    if (!this.held) this.clock.goOn();
  }

  async drive({ wait, tick }) {
    this.noteLimit();
    this.publish();
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
      if (!this.over && !this.clock.stands && this.clock.now < due) this.publish();
    }
  }

  publish() {
    this.published = this.interpreter.motion;
    this.motion.publish(this.published, this.robot);
  }

  async sleep(ms = HEARTBEAT) {
    await new Promise((resolve) => { setTimeout(resolve, Math.min(ms, HEARTBEAT)); });
    this.wakeUp();
  }

  wakeUp() {
    this.endIfFrozen();
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
