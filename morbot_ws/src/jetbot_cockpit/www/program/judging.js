// Judge me: the robot goes to the start of a task, the program runs, and the judge's score comes. It knows no page.
//
//   idle -- begin --> waiting -- the robot is at its start --> driving -- the program's own end --> ended
//   waiting -- a refusal, an obstacle, too late --> idle
//   waiting, ended -- cancel --> idle
//   driving -- a pause, another end of the program --> idle
//   driving, ended -- the judge's result, or its end --> idle, and the program ends
//   all -- begin --> waiting

/** @import { Send } from "../link.js" */
/** @import { World } from "../world.js" */

import { inSeconds } from "../dom.js";
import { said, t } from "../language.js";
import { hasPassed, holds } from "../refusals.js";
import { saidOf } from "../task.js";
import { calledOf } from "../world.js";

const READY_TIMEOUT = 20000; // ms until the robot is at its start
const DRIVE_TIMEOUT = 4000; // ms from the program's end until the judge must have seen a drive
const KEEP_INTERVAL = 1000; // ms between two messages that keep the robot this page's
const STARTING = t("The robot goes to the start of the task.");
const MEASURING = t("The judge measures until the robot has stopped for 3 s, or the time is over.");
const ENDED = t("Judge me ended this program.");
const NOT_CONNECTED = t("There is no connection to the cockpit.");
const NO_ANSWER = t("The judge did not put the robot at its start. Try again.");
const NOT_DRIVEN = t("The program has ended, and the robot did not drive: no score.");
const JUDGE_GONE = t("The judge does not answer any more. Try again.");
const CANCELLED = t("Judge me was cancelled.");
const SWITCHED_OFF = t("Judge me was cancelled: your teacher has switched this task off.");
const NOBODY_JUDGES = t("Judge me was cancelled: nobody judges this task any more.");
const OTHER_ROBOT = t("Judge me was cancelled: another robot was chosen.");
const NOT_COUNTED = t("The drive does not count.");
const PAUSED = t("The drive does not count: the program was paused.");
const SEEN = t("The judge has seen enough.");
const NOT_JUDGED = t("This drive is not judged any more.");

export class Judging {
  // robot, task: what is judged, in all states but idle; request: what its judge's reports are about, once accepted;
  // since: when this state began
  /** @type {any} */
  state = { name: "idle" };
  unanswered = 0; // messages "judge"
  keptAt = -Infinity;
  isOver = () => false; // whether what is said is not so any more

  // send(message) returns whether it was sent; lost(): whether there is no connection; run(): runs the program;
  // end(sentence): ends one that runs; say(text); world
  /** @param {{ send: Send, lost: () => boolean, run: () => void, end: (sentence: string) => void,
   * say: (text: string) => void, world: World }} page */
  constructor({ send, lost, run, end, say, world }) {
    this.send = send;
    this.lost = lost;
    this.run = run;
    this.end = end;
    this.say = say;
    this.world = world;
  }

  get isWaiting() {
    return this.state.name === "waiting";
  }

  // The task of the robot that is judged, as the judge reports it that was asked here.
  get report() {
    const { robot, request } = this.state;
    const { task } = this.world.state(robot);
    return task && request && task.request === request ? task : null;
  }

  enter(name, text, data = {}) {
    this.state = { name, since: performance.now(), ...data };
    this.isOver = () => false;
    this.say(text);
  }

  // Nothing is judged; this is said as long as it is so.
  rest(text, isSo) {
    this.enter("idle", text);
    this.isOver = hasPassed(isSo);
  }

  // Another program is shown, or one runs: what is said of an earlier one is over.
  forget() {
    if (this.state.name === "idle") this.enter("idle", "");
  }

  // The program that runs ends, and its drive is not judged; one that commands the robot from elsewhere waits.
  begin(robot, task) {
    this.disarm();
    if (!this.world.robot(robot)) return this.rest(this.world.describeAbsence(), this.isAbsent);
    const { program, state } = this.world.state(robot);
    const waits = t("The robot goes to the start of the task. {program} waits until the end.", { program });
    this.enter("waiting", program && state === "driving" ? waits : STARTING, { robot, task });
    this.end(ENDED);
    this.send({ type: "drive", robot, forward: 0, left: 0 }); // who had to let go, has
    if (!this.ask(task)) this.rest(NOT_CONNECTED, this.lost);
  }

  isAbsent = () => !this.world.robot(this.world.chosen);

  // Asks for a task, or "" for the end of it; the cockpit answers one after the other.
  ask(task) {
    const sent = this.send({ type: "judge", robot: this.state.robot, task });
    this.unanswered += Number(sent);
    return sent;
  }

  // The judge gives no score for this drive.
  disarm() {
    if (this.state.name !== "idle") this.ask("");
  }

  // A connection begins: what was asked before is not answered any more.
  hello() {
    this.unanswered = 0;
  }

  answered({ request, refusal }) {
    this.unanswered -= 1;
    if (!this.isWaiting || this.unanswered) return;
    const { world, state: { robot } } = this;
    if (refusal) this.rest(said(refusal), () => holds(refusal.code, world, robot, false));
    else this.state.request = request;
  }

  // These are the tasks now.
  list(tasks) {
    const task = tasks.find(({ name }) => name === this.state.task);
    if (this.isWaiting && !(task?.on || task && this.world.teacher)) this.cancel(task ? SWITCHED_OFF : NOBODY_JUDGES);
  }

  cancel(text = CANCELLED) {
    if (!["waiting", "ended"].includes(this.state.name)) return;
    this.disarm();
    this.enter("idle", text);
  }

  // Nothing drives any more, for this reason: a sentence.
  stop(sentence) {
    this.cancel(this.isWaiting ? t("{sentence} Judge me was cancelled.", { sentence })
      : t("{sentence} The drive does not count.", { sentence }));
  }

  // The person pauses the program.
  paused() {
    this.interrupt(PAUSED);
  }

  // early: before its own end
  programEnded(early) {
    if (early) this.interrupt(NOT_COUNTED);
    else if (this.state.name === "driving") this.state = { ...this.state, name: "ended", since: performance.now() };
  }

  interrupt(text) {
    if (this.state.name !== "driving") return;
    this.disarm();
    this.enter("idle", text);
  }

  // A state has arrived.
  update() {
    if (this.isWaiting) this.wait();
    else if (this.state.name !== "idle") this.follow();
    else if (this.isOver()) this.forget();
    this.keep();
  }

  wait() {
    const { report, world, state: { robot, request, since } } = this;
    const obstacle = request && whyCancelled(world, robot); // before, the cockpit says it
    if (robot !== world.chosen) this.cancel(OTHER_ROBOT);
    else if (obstacle) this.cancel(obstacle);
    else if (report?.state === "ready") this.drive();
    else if (report?.state === "cancelled") this.enter("idle", saidOf(report));
    else if (performance.now() - since > READY_TIMEOUT) this.cancel(NO_ANSWER);
  }

  drive() {
    const { robot, task, request } = this.state;
    this.enter("driving", MEASURING, { robot, task, request });
    this.run();
  }

  follow() {
    const { report, world, state: { name, robot, since } } = this;
    if (robot !== world.chosen) this.cancel(OTHER_ROBOT);
    else if (!report) this.conclude(JUDGE_GONE, NOT_JUDGED);
    else if (report.state === "done") this.score(report);
    else if (report.state === "cancelled") this.conclude(saidOf(report), NOT_JUDGED);
    else if (name === "ended" && report.state === "ready" && performance.now() - since > DRIVE_TIMEOUT) {
      this.cancel(NOT_DRIVEN);
    }
  }

  // It is shown until the robot gets another task, or is put back.
  score(report) {
    const { world, state: { robot } } = this;
    this.conclude(result(report), SEEN);
    this.isOver = hasPassed(() => world.chosen === robot && world.state(robot).task?.request === report.request);
  }

  // The judge is done: a program that still runs ends, and the robot stops.
  conclude(text, sentence) {
    this.enter("idle", text);
    this.end(sentence);
  }

  // While no program does so, the robot stays this page's, and programs from elsewhere wait.
  keep() {
    const { name, robot, request } = this.state;
    const now = performance.now();
    if (!request || name === "driving" || now - this.keptAt < KEEP_INTERVAL) return;
    this.keptAt = now;
    this.send({ type: "program", robot });
  }
}

// Returns that the robot is not this page's any more, and why, or "".
function whyCancelled(world, id) {
  const { driver, answers } = world.state(id);
  if (!world.isBlocked(id)) return "";
  if (driver && !world.isMine(id)) {
    return t("Judge me was cancelled: {driver} drives the robot.", { driver: calledOf(driver) });
  }
  if (world.isTaken(id)) return t("Judge me was cancelled: your teacher has taken the robot.");
  return answers ? t("Judge me was cancelled: the robot was stopped.")
    : t("Judge me was cancelled: the robot does not answer.");
}

function result(task) {
  const { title, score, seconds } = task;
  const values = { task: t(title), count: score.toFixed(1), time: inSeconds(seconds), losses: saidOf(task) };
  return t("{task}: {count} points, {time}. {losses}", values);
}
