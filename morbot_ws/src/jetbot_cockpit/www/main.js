// The cockpit's page: connects what the person does, what the cockpit sends, and what is shown.

import { Camera } from "./camera.js";
import { element, setClass, setText } from "./dom.js";
import { Driving } from "./driving.js";
import { Keys, Pad, watchGamepads } from "./inputs.js";
import { Link } from "./link.js";
import { LoginForm, logIn, NameField, takeCodeFromAddress } from "./login.js";
import { RobotMap } from "./map.js";
import { showPanel, showRoundTrip } from "./panel.js";
import { Choice, Fleet } from "./robots.js";
import { Notice, Stops } from "./stops.js";
import { prepareViews, showCodes, showScores } from "./views.js";
import { World } from "./world.js";

let problem = "Connecting"; // why there is no connection
let driven = null; // the robot that the commands go to
let wasDriver = false;
let fitted = false; // a teacher sees a class as a whole first
let codeError = ""; // why the code in the address was refused
let frame = null; // the next one shows what has changed

const world = new World();
const link = new Link({ receive, changed: connectionChanged, refused: askForCode, measured: showRoundTrip });
const send = (message) => link.send(message);
const notice = new Notice();
const login = new LoginForm(() => link.open());
const nameField = new NameField(send);
const choice = new Choice(world, changeRobot);
const choose = (id) => choice.choose(id);
const fleet = new Fleet(world, choose, send);
const map = new RobotMap(element("map"), world, { choose, redraw: show });
const camera = new Camera(world, send);
const driving = new Driving({
  send: command, ready: () => link.connected && Boolean(world.robot(world.chosen)), changed: show,
});
const stops = new Stops(world, { send, notice, stopped: () => driving.lift() });
const deflect = (source) => (forward, left) => driving.deflect(source, forward, left);
const pad = new Pad(element("pad"), element("thumb"), deflect("pad"));
const keys = new Keys(deflect("keys"), () => stops.stop());

const RECEIVERS = {
  hello(message) {
    world.hello(message);
    camera.forget();
    showScores([]);
    nameField.announce();
  },
  robots(message) {
    const changes = world.list(message);
    if (changes) notice.show(changes, () => false);
    if (driving.active && !world.robot(driven)) driving.lift();
    choice.begin();
    fleet.list();
  },
  state(message) {
    world.update(message);
    stops.update();
    noticeLostLease();
    fitOnce();
  },
  trail: ({ robot, points }) => world.trails.set(robot, points),
  scene(message) {
    if (world.scene(message)) map.showCourse(message.robot);
  },
  scores: ({ scores }) => showScores(scores),
  notice: ({ text }) => notice.show(text),
  lift({ robot, text }) {
    const late = !driving.active && notice.visible; // a command was on its way: the first reason counts
    if (robot === driven) driving.lift();
    if (!late) notice.show(text);
  },
  codes: ({ codes }) => showCodes(codes),
  picture: (message) => camera.begin(message),
};

function receive(message) {
  if (message.type === "part") return camera.take(message.bytes);
  RECEIVERS[message.type]?.(message);
  show();
}

function command(forward, left) {
  if (forward || left) driven = world.chosen;
  if (driven === null) return;
  const message = { type: "drive", robot: driven, forward, left };
  if (forward || left) link.sendFresh(message);
  else link.send(message);
}

function fitOnce() {
  if (fitted || !world.teacher || world.robots.length < 2 || !world.placed.length) return;
  fitted = true;
  map.fit();
}

function noticeLostLease() {
  if (wasDriver && !world.isMine(driven)) {
    driving.lift();
    const { driver } = world.state(driven);
    if (driver) notice.show(`${driver.name} has taken ${world.robot(driven)?.label ?? "the robot"}.`);
  }
  wasDriver = world.isMine(driven);
}

function changeRobot() {
  driving.interrupt();
  map.follow(true);
  map.showCourse(world.chosen);
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
  showPanel(world, problem);
  notice.update(world.isBlocked(world.chosen), driving.active && world.isMine(driven));
  setClass(document.body, "driving", driving.active);
  pad.point(...driving.command);
  stops.show();
  fleet.show();
  camera.show();
  map.draw();
}

// The page sees no finger and no key any more.
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

async function start() {
  const code = takeCodeFromAddress();
  codeError = code && await logIn(code);
  login.close();
  link.open(); // after a wrong code, too: an earlier one may still hold
}

watchGamepads(deflect("gamepad"), () => driving.pause("gamepad") && notice.show("Move the stick a little to go on"));
prepareViews(() => send({ type: "codes" }));
element("speed").addEventListener("input", setSpeed);
element("take").addEventListener("click", () => send({ type: "take", robot: world.chosen }));
element("go-on").addEventListener("click", () => send({ type: "go_on", robot: world.chosen }));
element("reset").addEventListener("click", () => send({ type: "reset", robot: world.chosen }));
addEventListener("blur", leave);
addEventListener("pagehide", leave);
matchMedia("(orientation: portrait)").addEventListener("change", leave); // the pad moves away below the finger
document.addEventListener("visibilitychange", () => document.hidden && leave());
addEventListener("hashchange", () => location.hash && start());
setSpeed();
show();
start();
