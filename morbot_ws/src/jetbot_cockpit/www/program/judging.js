// Judge me: the robot goes to the start of a task, the program runs, and the judge's score comes. It knows no page.
//
//   idle -- begin --> waiting -- the robot is at its start --> driving -- the program's own end --> ended
//   waiting -- cancel, a refusal, too late --> idle
//   driving, ended -- the judge's result, or its end --> idle
//   all -- begin --> waiting

/** @import { Send } from "../link.js" */
/** @import { World } from "../world.js" */

import { inSeconds } from "../dom.js";

const READY_TIMEOUT = 20000; // ms until the robot is at its start
const STARTING = "The robot goes to the start of the task.";
const MEASURING = "The judge measures from the first motion until the robot has stood still for 3 s.";
const NO_ANSWER = "The judge did not put the robot at its start. Try again.";
const NOT_DRIVEN = "The program has ended, and the robot stands at the start.";
const JUDGE_ENDED = "The judge has ended. Try again.";
const CANCELLED = "Judge me was cancelled.";

export class Judging {
  // robot, task: what is judged, in all states but idle; waiting has since, and heard: what the judge has said of it
  state = { name: "idle" };

  // send(message); run(): runs the program; say(text); world
  /** @param {{ send: Send, run: () => void, say: (text: string) => void, world: World }} page */
  constructor({ send, run, say, world }) {
    this.send = send;
    this.run = run;
    this.say = say;
    this.world = world;
  }

  get isWaiting() {
    return this.state.name === "waiting";
  }

  // The task of the robot that is judged, as its judge reports it.
  get report() {
    return this.world.state(this.state.robot).task ?? null;
  }

  // Whether the robot is at the start of this task, and its judge waits.
  get isReady() {
    return this.report?.name === this.state.task && this.report?.state === "ready";
  }

  enter(name, text, data = {}) {
    this.state = { name, ...data };
    this.say(text);
  }

  begin(robot, task) {
    const heard = this.world.state(robot).task?.text;
    this.enter("waiting", STARTING, { robot, task, heard, since: performance.now() });
    this.send({ type: "drive", robot, forward: 0, left: 0 }); // who had to let go, has
    if (!this.isReady) this.send({ type: "judge", robot, task });
  }

  cancel(text = CANCELLED) {
    if (!this.isWaiting) return;
    this.disarm();
    this.enter("idle", text);
  }

  // The judge gives no score for this drive, and says so.
  disarm() {
    this.send({ type: "judge", robot: this.state.robot, task: "" });
  }

  // The person pauses the program.
  paused() {
    if (this.isDriving) this.disarm();
  }

  get isDriving() {
    return this.state.name === "driving" || this.state.name === "ended";
  }

  // early: before its own end
  programEnded(early) {
    if (!this.isDriving) return;
    if (early) this.disarm();
    else this.state = { ...this.state, name: "ended" };
  }

  // A state has arrived.
  update() {
    if (this.isWaiting) this.wait();
    else if (this.isDriving) this.follow();
  }

  wait() {
    const { robot, task, since, heard } = this.state;
    if (robot !== this.world.chosen || this.world.isBlocked(robot)) return this.cancel();
    if (this.isReady) {
      this.enter("driving", MEASURING, { robot, task });
      return this.run();
    }
    const text = this.report?.text;
    const refusal = this.report?.state === "cancelled" && text; // perhaps of what was asked for before
    if (refusal && text !== heard) this.say(text);
    this.state.heard = text;
    if (performance.now() - since > READY_TIMEOUT) this.cancel(refusal || NO_ANSWER);
  }

  // Says so if there is nothing to judge; who drives on by hand gets the score all the same.
  follow() {
    const { report, state: { name, task } } = this;
    if (name === "ended" && this.isReady) this.say(NOT_DRIVEN);
    else if (!report || report.name !== task) this.enter("idle", JUDGE_ENDED);
    else if (report.state === "done") this.enter("idle", result(report));
    else if (report.state === "cancelled") this.enter("idle", report.text);
  }
}

function result({ title, score, seconds, text }) {
  return `${title}: ${score.toFixed(1)} points, ${inSeconds(seconds)}. ${text}`;
}
