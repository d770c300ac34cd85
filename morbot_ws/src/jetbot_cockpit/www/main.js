// The cockpit's page: connects what the person does, what the cockpit sends, and what is shown.

import { Choice } from "./choice.js";
import { showCodes } from "./codes.js";
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
import { Person } from "./person.js";
import { Stops } from "./stop.js";
import { prepareViews, showView } from "./views.js";
import { showWheels } from "./wheels.js";
import { World, describeDriver, summarize } from "./world.js";

let problem = "Connecting"; // why there is no connection
let driven = null; // the robot that the commands go to
let wasDriver = false;
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
const report = (text) => notice.show(text);
const stops = new Stops(world, { chosen, send, report, stopped: () => driving.lift() });
const fleet = new Fleet(world, chosen, choose, send);
const map = new RobotMap(element("map"), world, { chosen, choose, redraw: show });
const person = new Person(send);

const RECEIVERS = {
  hello(message) {
    world.hello(message);
    choice.begin();
    person.announce();
  },
  robots(message) {
    const known = world.robots.length;
    world.list(message);
    if (driving.active && !world.robot(driven)) driving.lift();
    choice.begin();
    fleet.list();
    if (!known && world.teacher && world.robots.length > 1) fitOnce();
  },
  state(message) {
    world.update(message);
    noticeLostLease();
    fitOnce.due?.();
  },
  trail: (message) => world.trail(message),
  notice: ({ text }) => report(text),
  lift({ robot, text }) {
    if (robot === driven) driving.lift();
    report(text);
  },
  codes: ({ codes }) => showCodes(codes),
};

function receive(message) {
  RECEIVERS[message.type]?.(message);
  show();
}

// A class is seen as a whole first, as soon as the places are known.
function fitOnce() {
  fitOnce.due = () => {
    if (!world.placed().length) return;
    fitOnce.due = null;
    map.fit();
  };
}

function command(forward, left) {
  if (forward || left) driven = chosen();
  const message = { type: "drive", robot: driven, forward, left };
  return forward || left ? link.sendFresh(message) : link.send(message);
}

function noticeLostLease() {
  const isDriver = world.state(driven).driver?.id === world.me.id;
  if (driving.active && wasDriver && !isDriver) driving.lift();
  wasDriver = driving.active && isDriver;
}

function changeRobot() {
  driving.interrupt();
  map.follow(true);
  show();
}

function connectionChanged(sentence) {
  problem = sentence;
  if (sentence) {
    driving.lift();
    setText(element("link"), "–");
  }
  show();
}

function askForCode() {
  driving.lift();
  login.ask();
}

function showRoundTrip(milliseconds) {
  const text = `${Math.max(1, Math.round(milliseconds))} ms`;
  setText(element("link"), text);
  element("link").dataset.quality = milliseconds < 60 ? "good" : milliseconds < 200 ? "fair" : "poor";
  element("link").setAttribute("aria-label", `Connection: ${text} to the cockpit and back`);
}

// Returns the sentence of #status and how urgent it is.
function currentStatus() {
  if (problem) return { text: problem, level: "warning" };
  if (world.robot(chosen())) return summarize(world, chosen());
  const own = world.me.robot ?? chosen();
  const missing = own ? `${own.slice(1) || "The robot"} is not running.` : "No robot is running: start one.";
  return { text: `${missing} This page shows it as soon as it runs.`, level: "waiting" };
}

function show() {
  frame ??= requestAnimationFrame(showNow);
}

function showNow() {
  frame = null;
  const robot = world.robot(chosen());
  const state = world.state(chosen());
  const { text, level } = currentStatus();
  setText(element("status"), text);
  element("status").dataset.level = level;
  setText(element("driver"), robot ? describeDriver(world, chosen()) : "");
  if (robot) document.documentElement.style.setProperty("--robot", robot.color);
  showTeachersTools(robot, state);
  setClass(document.body, "driving", driving.active);
  setClass(document.body, "offline", problem);
  showWheels(robot, state);
  stops.show();
  map.draw();
}

function showTeachersTools(robot, { driver }) {
  const several = world.teacher && world.robots.length > 1;
  element("fleet").hidden = element("show-fleet").hidden = !several;
  element("fit").hidden = world.robots.length < 2;
  element("show-codes").hidden = !world.teacher;
  element("take").hidden = !(world.teacher && driver && driver.id !== world.me.id);
  element("reset").hidden = !(world.teacher && robot?.simulated);
  setClass(document.body, "several", several);
  if (several) fleet.show();
  else if (document.body.dataset.view === "fleet") showView("drive");
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

new Pad(element("pad"), element("thumb"), (...deflection) => driving.deflect("pad", ...deflection));
new Gamepads((...deflection) => driving.deflect("gamepad", ...deflection));
driving.changed = show;
prepareViews((view) => view === "codes" && send({ type: "codes" }));
element("speed").addEventListener("input", setSpeed);
element("take").addEventListener("click", () => send({ type: "take", robot: chosen() }));
element("reset").addEventListener("click", () => send({ type: "reset", robot: chosen() }));
addEventListener("blur", leave);
addEventListener("pagehide", leave);
document.addEventListener("visibilitychange", () => document.hidden && leave());

async function start() {
  setSpeed();
  show();
  const code = takeCodeFromAddress();
  const error = code && await logIn(code);
  if (error) login.ask(error);
  else link.open();
}

addEventListener("hashchange", start);
start();
