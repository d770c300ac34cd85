// Runs a program in this page: Run, Pause, Step, Stop, how fast, and the clock by which it waits.

import { Interpreter, ProgramError } from "./interpreter.js";
import { Motion } from "./motion.js";

const SLICE = 8; // ms that a program computes before the page has its turn
const TICK = 100; // ms
const LATE = 25; // ms by which a timer may be late
const HEARTBEAT = 50; // ms
const FROZEN = 300; // ms without a heartbeat: the cockpit has stopped the robot meanwhile
const SENSE_INTERVAL = 90; // ms between two questions what the robot senses
const SENSE_TIMEOUT = 100; // ms
const READY_TIMEOUT = 4000; // ms until a robot's controller is connected
const LINE_TIMEOUT = 2000; // ms of these, for its line sensor
const SENSORS = /"type":"robot_(here|eye|wheel)"/; // blocks that ask the robot
const EYES = /"type":"robot_eye"/;
const NOT_READY = "The robot is not connected to the cockpit. Start its controller again.";
const INTERRUPTED = "This page was interrupted, so the robot stopped.";

export class Runner {
  robot = null; // the one that runs the program, as the cockpit describes it; null: no program runs
  held = false; // whether the person has paused it
  delay = 0; // ms before each statement
  at = null; // the id of the block whose statement runs
  interpreter = null;

  // send(message); printed(text); changed(); ended(sentence, block): why, "" at the program's end; block: the id of
  // where it failed
  constructor({ send, printed, changed, ended }) {
    Object.assign(this, { send, printed, changed, ended });
    this.motion = new Motion((forward, left) => this.command(forward, left));
    setInterval(() => this.alive(), HEARTBEAT);
  }

  get runs() {
    return this.robot !== null;
  }

  // Starts the program; stepping: it pauses before its first statement.
  start(program, robot, stepping = false) {
    this.end();
    Object.assign(this, { robot, stepping, held: false, frozenAt: null, lost: 0, at: null, ready: false, senses: {} });
    [this.sensing, this.looking] = [SENSORS, EYES].map((pattern) => pattern.test(JSON.stringify(program)));
    this.beatenAt = this.sensedAt = performance.now();
    const interpreter = new Interpreter(program, robot, () => this.sensed());
    this.interpreter = interpreter;
    this.motion.end(); // the cockpit obeys this page again only after a zero
    this.execute(interpreter).catch((error) => {
      if (!(error instanceof ProgramError)) console.error(error);
      if (this.interpreter === interpreter) this.end(error.message, error.block);
    });
    this.changed();
  }

  // Ends the program, and stops the robot.
  end(sentence = "", block = null) {
    if (!this.runs) return;
    this.motion.end();
    this.robot = null;
    this.wake?.();
    this.ended(sentence, block);
    this.changed();
  }

  // Pauses: the robot stands, and so does the clock.
  pause() {
    if (!this.runs || this.held) return;
    this.held = true;
    this.freeze();
    this.changed();
  }

  resume() {
    this.held = this.stepping = false;
    if (this.frozenAt !== null) this.thaw();
    this.changed();
  }

  // Runs one statement.
  step() {
    this.resume();
    this.stepping = true;
  }

  freeze() {
    this.frozenAt ??= performance.now();
    this.motion.set(0, 0);
    this.wake?.();
  }

  thaw() {
    this.lost += performance.now() - this.frozenAt;
    this.frozenAt = null;
    this.wake?.();
  }

  // Takes an answer of the cockpit.
  receive({ robot, ready, ...senses }) {
    if (robot !== this.robot?.id) return;
    Object.assign(this, { ready, senses });
    this.answered?.();
  }

  // The program's time in ms.
  get now() {
    return (this.frozenAt ?? performance.now()) - this.lost;
  }

  async execute(interpreter) {
    const over = () => this.interpreter !== interpreter || !this.runs;
    await this.prepare(over);
    if (over()) return;
    this.origin = this.senses.pose;
    this.startedAt = this.due = this.tickedAt = this.now;
    this.motion.begin();
    for (const event of interpreter.run()) {
      if ("print" in event) this.printed(event.print);
      else if ("step" in event) await this.before(event.step);
      else if ("breathe" in event) await this.between();
      else await this.drive(event, interpreter.motion);
      if (over()) return;
    }
    this.end();
  }

  // Waits until the robot is this page's, and its sensors report: else the first command would arrive late.
  async prepare(over) {
    const start = performance.now();
    const patient = (ms) => performance.now() - start < ms;
    while (!over() && !(this.ready && !(this.looking && !this.senses.line && patient(LINE_TIMEOUT)))) {
      if (!patient(READY_TIMEOUT)) throw new ProgramError(NOT_READY);
      this.sense();
      await this.sleep(SENSE_INTERVAL / 2);
    }
  }

  // Comes before each statement: shows it, and waits if the program is slow or paused.
  async before(block) {
    this.at = block;
    if (this.stepping) this.pause();
    else if (this.delay) await this.rest();
    await this.between();
  }

  // Lets the page have its turn if the program has computed for long, and waits while it is paused.
  async between() {
    if (performance.now() - this.awakeAt > SLICE) await this.breathe();
    while (this.held && this.runs) await this.sleep();
  }

  // Lets the robot stand for a moment before a statement of a slow program.
  async rest() {
    this.freeze();
    const until = performance.now() + this.delay;
    while (this.runs && !this.held && performance.now() < until) await this.sleep(until - performance.now());
    if (this.runs && !this.held && this.frozenAt !== null) this.thaw();
  }

  async breathe() {
    if (this.sensing) this.senseAgain();
    await this.sleep(0);
  }

  async drive({ wait, tick }, motion) {
    const command = [...motion];
    this.motion.publish(command, this.robot);
    if (tick) await this.until(this.nextTick(), command);
    else if (wait > 0) await this.until(this.due = this.startOfWait() + wait * 1000, command);
    if (this.sensing && this.runs) await this.freshSenses();
  }

  // Waits as rospy.Rate(10) does: for the next tenth of a second after the last.
  nextTick() {
    const [now, due] = [this.now, this.tickedAt + TICK];
    this.tickedAt = now - due > 2 * TICK ? now : due;
    this.due = Math.max(now, due);
    return due;
  }

  // A timer is late by some ms: the next wait makes up for it.
  startOfWait() {
    return this.now - this.due < LATE ? this.due : this.now;
  }

  async until(due, command) {
    while (this.runs && (this.frozenAt !== null || this.now < due)) {
      this.motion.changesAt = due + this.lost;
      if (this.frozenAt === null) await this.sleep(due - this.now);
      else await this.sleep();
      if (this.runs && this.frozenAt === null && this.now < due) this.motion.publish(command, this.robot);
    }
  }

  // Ends early if something has changed; without a time, only then.
  async sleep(ms = Infinity) {
    await new Promise((resolve) => {
      const timer = ms < Infinity ? setTimeout(resolve, Math.min(ms, HEARTBEAT)) : null;
      this.wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
    this.awakeAt = performance.now();
  }

  sense() {
    this.sensedAt = performance.now();
    this.send({ type: "program", robot: this.robot.id });
  }

  // Asks what the robot senses, not too often; returns whether it has asked.
  senseAgain() {
    const due = performance.now() - this.sensedAt >= SENSE_INTERVAL;
    if (due) this.sense();
    return due;
  }

  async freshSenses() {
    if (!this.senseAgain()) return;
    await new Promise((resolve) => {
      this.answered = resolve;
      setTimeout(resolve, SENSE_TIMEOUT);
    });
    this.awakeAt = performance.now();
  }

  // Returns what the robot senses; what is not known is undefined.
  sensed() {
    const { pose, line, wheels } = this.senses;
    const here = pose && this.origin ? relative(pose, this.origin) : undefined;
    return { here, line, wheels, seconds: (this.now - this.startedAt) / 1000 };
  }

  // Returns whether the program runs: not after the page was frozen, when the cockpit has stopped the robot.
  alive() {
    if (!this.runs) return false;
    const gap = performance.now() - this.beatenAt;
    this.beatenAt = performance.now();
    if (gap > FROZEN) this.end(INTERRUPTED);
    return gap <= FROZEN;
  }

  command(forward, left) {
    const stops = !forward && !left;
    if (this.runs && (stops || this.alive())) this.send({ type: "drive", robot: this.robot.id, forward, left });
  }
}

// Returns where a pose (m, m, rad) is as seen from another one: m ahead, m to the left, degrees to the left.
function relative([x, y, yaw], [fromX, fromY, fromYaw]) {
  const [ahead, left, turn] = [x - fromX, y - fromY, yaw - fromYaw];
  const [cosine, sine] = [Math.cos(fromYaw), Math.sin(fromYaw)];
  const heading = Math.atan2(Math.sin(turn), Math.cos(turn)) * 180 / Math.PI;
  return { X: ahead * cosine + left * sine, Y: left * cosine - ahead * sine, HEADING: heading };
}
