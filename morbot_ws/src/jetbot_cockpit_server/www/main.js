// The cockpit's page: connects what the person does, what the cockpit sends, and what is shown.

import { Choice } from "./choice.js";
import { prepareCodes, showCodes } from "./codes.js";
import { element, setClass, setText } from "./dom.js";
import { Driving } from "./driving.js";
import { Fleet } from "./fleet.js";
import { Gamepads } from "./gamepad.js";
import { Keys } from "./keys.js";
import { Link } from "./link.js";
import { LoginForm, logIn, takeCodeFromAddress } from "./login.js";
import { RobotMap } from "./map.js";
import { Notice } from "./notice.js";
import { Pad } from "./pad.js";
import { showPanel, showRoundTrip } from "./panel.js";
import { Person } from "./person.js";
import { showScores } from "./scores.js";
import { Stops } from "./stop.js";
import { prepareViews } from "./views.js";
import { World } from "./world.js";

let problem = "Connecting"; // why there is no connection
let driven = null; // the robot that the commands go to
let wasDriver = false;
let fitDue = false; // a teacher sees a class as a whole first, as soon as the places are known
let codeError = ""; // why the code in the address was refused
let frame = null; // the next one shows what has changed

const world = new World();
const notice = new Notice();
const login = new LoginForm(() => link.open());
const link = new Link({ receive, changed: connectionChanged, refused: askForCode, measured: showRoundTrip });
const send = (message) => link.send(message);
const choice = new Choice(world, changeRobot);
const chosen = () => choice.id;
const choose = (id) => choice.choose(id);
const driving = new Driving(command, () => link.connected && Boolean(world.robot(chosen())));
const keys = new Keys((...deflection) => driving.deflect("keys", ...deflection), () => stops.stop());
const report = (...sentence) => notice.show(...sentence);
const stops = new Stops(world, { chosen, send, report, stopped: () => driving.lift() });
const fleet = new Fleet(world, chosen, choose, send);
const map = new RobotMap(element("map"), world, { chosen, choose, redraw: show });
const person = new Person(send);

const RECEIVERS = {
  hello(message) {
    world.hello(message);
    showScores(world.scores);
    choice.begin();
    person.announce();
  },
  robots(message) {
    fitDue ||= world.robots.length < 2 && message.robots.length > 1 && world.teacher;
    const changes = world.list(message);
    if (changes) report(changes, () => false);
    if (driving.active && !world.robot(driven)) driving.lift();
    choice.begin();
    fleet.list();
  },
  state(message) {
    world.update(message);
    stops.update();
    noticeLostLease();
    fitWhenPlaced();
  },
  trail: (message) => world.trail(message),
  scene(message) {
    if (world.scene(message)) map.showCourse(message.robot);
  },
  scores({ scores }) {
    world.scores = scores;
    showScores(scores);
  },
  notice: ({ text }) => report(text),
  lift({ robot, text }) {
    const late = !driving.active && notice.visible; // a command was on its way: the first reason counts
    if (robot === driven) driving.lift();
    if (!late) report(text);
  },
  codes: ({ codes }) => showCodes(codes),
};

function receive(message) {
  RECEIVERS[message.type]?.(message);
  show();
}

function command(forward, left) {
  if (forward || left) driven = chosen();
  if (driven === null) return;
  const message = { type: "drive", robot: driven, forward, left };
  if (forward || left) link.sendFresh(message);
  else link.send(message);
}

function fitWhenPlaced() {
  if (!fitDue || !world.placed().length) return;
  fitDue = false;
  map.fit();
}

function noticeLostLease() {
  if (wasDriver && !world.isMine(driven)) {
    driving.lift();
    const { driver } = world.state(driven);
    if (driver) report(`${driver.name} has taken ${world.robot(driven)?.label ?? "the robot"}.`);
  }
  wasDriver = world.isMine(driven);
}

function changeRobot() {
  driving.interrupt();
  map.follow(true);
  map.showCourse(chosen());
  show();
}

function connectionChanged(sentence) {
  problem = sentence;
  if (sentence) {
    driving.lift();
    setText(element("link"), "–");
  } else {
    stops.resend();
  }
  show();
}

function askForCode() {
  driving.lift();
  login.ask(codeError || (world.me.id === null ? "" : "The cockpit was started again: its codes are new."));
}

function show() {
  frame ??= requestAnimationFrame(showNow);
}

function showNow() {
  frame = null;
  showPanel(world, chosen(), problem);
  notice.update(world.isBlocked(chosen()), driving.active && world.isMine(driven));
  setClass(document.body, "driving", driving.active);
  pad.point(...driving.command);
  stops.show();
  fleet.show();
  map.draw();
}

function leave() {
  driving.interrupt();
  keys.clear();
}

function setSpeed() {
  const percent = Number(element("speed").value);
  driving.speed = percent / 100;
  setText(element("speed-value"), `${percent} %`);
  element("speed").setAttribute("aria-valuetext", `${percent} % of full speed`);
}

const pad = new Pad(element("pad"), element("thumb"), (...deflection) => driving.deflect("pad", ...deflection));
new Gamepads((...deflection) => driving.deflect("gamepad", ...deflection));
driving.changed = show;
prepareCodes();
prepareViews((view) => view === "codes" && send({ type: "codes" }));
element("speed").addEventListener("input", setSpeed);
element("take").addEventListener("click", () => send({ type: "take", robot: chosen() }));
element("reset").addEventListener("click", () => send({ type: "reset", robot: chosen() }));
addEventListener("blur", leave);
addEventListener("pagehide", leave);
matchMedia("(orientation: portrait)").addEventListener("change", leave); // the pad moves away below the finger
document.addEventListener("visibilitychange", () => document.hidden && leave());

async function start() {
  setSpeed();
  show();
  const code = takeCodeFromAddress();
  codeError = code && await logIn(code);
  login.close();
  link.open(); // after a wrong code, too: an earlier one may still hold
}

addEventListener("hashchange", () => location.hash && start());
start();
