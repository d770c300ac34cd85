// A task from the page: Judge me puts the robot at its start, runs the program, and shows the score.

import { element, inSeconds, setText } from "../dom.js";

const READY_TIMEOUT = 20000; // ms until the robot is at its start
const NO_ANSWER = "The judge did not put the robot at its start. Try again.";
const NOT_DRIVEN = "The program has ended, and the robot stands at the start.";
const JUDGE_ENDED = "The judge has ended. Try again.";
const CANCELLED = "Judge me was cancelled.";

export class Judging {
  waiting = null; // { robot, task, since, text } until the robot is at its start; text: what the judge says of the task
  judged = null; // { robot, task } until the result is shown

  // send(message); run(): runs the program; world
  constructor({ send, run, world }) {
    Object.assign(this, { send, run, world });
    element("judge").addEventListener("click", () => (this.waiting ? this.cancel() : this.begin()));
    for (const id of ["end", "stop", "run", "step"]) {
      for (const event of ["pointerdown", "click"]) element(id).addEventListener(event, () => this.cancel());
    }
    element("pause").addEventListener("click", () => this.disarm(this.judged));
    addEventListener("keydown", ({ key }) => key === "Escape" && this.cancel(), true);
    document.addEventListener("visibilitychange", () => document.hidden && this.cancel());
  }

  // Shows which tasks there are for this person.
  list(tasks) {
    const offered = tasks.filter(({ on }) => on || this.world.teacher);
    const { value } = element("task-choice");
    element("task-choice").replaceChildren(...offered.map(({ name, title }) => new Option(title, name)));
    if (offered.some(({ name }) => name === value)) element("task-choice").value = value;
    for (const id of ["task-choice", "judge"]) element(id).hidden = !offered.length;
  }

  begin() {
    const [robot, task] = [this.world.chosen, element("task-choice").value];
    this.waiting = { robot, task, since: performance.now(), text: this.world.state(robot).task?.text };
    this.judged = null;
    this.send({ type: "drive", robot, forward: 0, left: 0 }); // who had to let go, has
    if (!this.isReady(this.waiting)) this.send({ type: "judge", robot, task });
    this.say("The robot goes to the start of the task.");
  }

  // Returns whether the robot stands at the start of this task, and its judge waits.
  isReady({ robot, task }) {
    const { name, state } = this.world.state(robot).task ?? {};
    return name === task && state === "ready";
  }

  // A notice has arrived, perhaps why the cockpit refuses this.
  refused(text) {
    if (this.waiting) this.cancel(text);
  }

  cancel(text = CANCELLED) {
    if (!this.waiting) return;
    this.disarm(this.waiting);
    this.waiting = null;
    this.say(text);
  }

  // The judge gives no score for this drive, and says so.
  disarm(drive) {
    if (drive) this.send({ type: "judge", robot: drive.robot, task: "" });
  }

  // A state has arrived.
  update() {
    if (this.waiting) this.wait(this.world.state(this.waiting.robot).task);
    else if (this.judged) this.follow(this.world.state(this.judged.robot).task);
  }

  wait(task) {
    const { robot, since, text } = this.waiting;
    if (robot !== this.world.chosen || this.world.isBlocked(robot)) return this.cancel();
    if (this.isReady(this.waiting)) return this.start();
    const refused = task?.state === "cancelled"; // perhaps what was asked for before
    if (refused && task.text !== text) this.say(task.text);
    this.waiting.text = task?.text;
    if (performance.now() - since > READY_TIMEOUT) this.cancel(refused ? task.text : NO_ANSWER);
  }

  start() {
    this.judged = this.waiting;
    this.waiting = null;
    this.say("The judge measures from the first motion until the robot has stood still for 3 s.");
    this.run();
  }

  // early: before its own end
  programEnded(early) {
    if (early) this.disarm(this.judged);
    else if (this.judged) this.judged.over = true;
  }

  // Says so if there is nothing to judge; who drives on by hand gets the score all the same.
  follow(task) {
    if (this.judged.over && this.isReady(this.judged)) return this.say(NOT_DRIVEN);
    const gone = task?.name !== this.judged.task;
    if (!gone && !["done", "cancelled"].includes(task.state)) return;
    this.judged = null;
    if (gone) return this.say(JUDGE_ENDED);
    const { state, title, score, seconds, text } = task;
    this.say(state === "done" ? `${title}: ${score.toFixed(1)} points, ${inSeconds(seconds)}. ${text}` : text);
  }

  say(text) {
    setText(element("score"), text);
    setText(element("judge"), this.waiting ? "Cancel" : "Judge me");
  }
}
