// The cockpit's page: connects what the person does, what the cockpit sends, and what is shown.

import { Camera } from "./camera.js";
import { Codes } from "./codes.js";
import { calmly, element, setClass, setText } from "./dom.js";
import { Driving } from "./driving.js";
import { Fleet } from "./fleet.js";
import { prepareHealth, showHealth } from "./health.js";
import { Keys, Pad, watchGamepads } from "./inputs.js";
import { t } from "./language.js";
import { RobotMap } from "./map.js";
import { showPanel } from "./panel.js";
import { describeSteering } from "./place.js";
import { NOT_LOADED, Shell } from "./shell.js";
import { showSwitches } from "./switches.js";
import { prepareViews, showScores } from "./views.js";
import { calledOf } from "./world.js";

let driven = null; // the robot that the commands go to
let wasDriver = false;
let curves = null; // until they are shown first
let fitted = false; // a teacher sees a class as a whole first

const choose = (id) => shell.choice.choose(id);
const shell = new Shell({
  receivers: {
    hello() {
      camera.forget();
      showScores([]);
      codes.openIfAddressed();
    },
    robots() {
      if (driving.active && !world.robot(driven)) driving.lift();
      fleet.list();
      codes.showNames();
    },
    state() {
      noticeLostLease();
      fitOnce();
      codes.complete();
    },
    scores: ({ scores }) => showScores(scores),
    lift(message) {
      if (message.robot !== driven) return; // all pages are told of a robot that is put back
      const late = !driving.active && notice.visible; // a command was on its way: the first reason counts
      driving.lift();
      if (!late) shell.refuse(message, message.robot);
    },
    codes: (message) => codes.list(message.codes),
    tasks: ({ tasks }) => showTasks(tasks),
    cameras: ({ on }) => camera.allow(on),
    picture: (message) => camera.begin(message),
    part: ({ bytes }) => void camera.take(bytes),
  },
  end: () => driving.lift(),
  drives: () => driving.active && world.isMine(driven),
  changed: () => driving.interrupt(),
  draw,
});
const { world, notice, send } = shell;
shell.openMap(RobotMap, choose);
const fleet = new Fleet(world, choose, send);
const camera = new Camera(world, send);
const codes = new Codes(world, send); // before the keys: see there
const driving = new Driving({
  send: command, ready: () => shell.link.connected && Boolean(world.robot(world.chosen)), changed: () => shell.show(),
});
const deflect = (source) => (forward, left) => driving.deflect(source, forward, left);
const pad = new Pad(element("pad"), element("thumb"), deflect("pad"));
const keys = new Keys(element("pad"), deflect("keys"), () => shell.login.asking || shell.stops.stop());
const saySteering = calmly((text) => setText(element("pad-news"), text));

function command(forward, left) {
  if (forward || left) driven = world.chosen;
  if (driven === null) return;
  send({ type: "drive", robot: driven, forward, left });
}

function fitOnce() {
  if (fitted || !world.teacher || world.robots.length < 2 || !world.placed.length) return;
  fitted = true;
  shell.map?.fit();
}

function noticeLostLease() {
  if (wasDriver && !world.isMine(driven)) {
    driving.lift();
    const [robot, { driver }] = [driven, world.state(driven)];
    const drives = () => driver?.id === world.state(robot).driver?.id;
    if (driver) notice.show(taken(calledOf(driver), world.robot(robot)?.label), drives);
  }
  wasDriver = world.isMine(driven);
}

function taken(name, robot) {
  return robot ? t("{name} has taken {robot}.", { name, robot }) : t("{name} has taken the robot.", { name });
}

function draw() {
  showPanel(world, shell.problem);
  showHealth(world);
  setClass(document.body, "driving", driving.active);
  pad.point(...driving.command);
  saySteering(describeSteering(driving.command));
  fleet.show();
  camera.show();
  shell.map?.draw();
  curves?.draw();
}

function showTasks(tasks) {
  element("codes-tasks").hidden = !tasks.length;
  showSwitches(element("task-switches"), tasks, send);
}

function showCurves(on) {
  const load = ({ loadCurves }) => loadCurves(shell, element("view"), () => null, () => showCurves(false));
  import("./curves/panel.js").then(load).then((loaded) => {
    curves = loaded;
    curves.show(on);
  }, () => notice.show(NOT_LOADED));
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
  element("speed").setAttribute("aria-valuetext", t("{percent} % of full speed", { percent }));
}

watchGamepads(deflect("gamepad"), () => driving.pause("gamepad")
  && notice.show(t("Move the stick a little to go on"), () => !driving.active));
prepareViews();
prepareHealth(() => shell.show());
element("speed").addEventListener("input", setSpeed);
element("show-curves").addEventListener("click", () => showCurves(true));
element("show-camera").addEventListener("click", () => curves && showCurves(false));
element("take").addEventListener("click", () => send({ type: "take", robot: world.chosen }));
element("go-on").addEventListener("click", () => send({ type: "go_on", robot: world.chosen }));
element("reset").addEventListener("click", () => send({ type: "reset", robot: world.chosen }));
addEventListener("blur", leave);
addEventListener("pagehide", leave);
matchMedia("(orientation: portrait)").addEventListener("change", leave); // the pad moves away below the finger
document.addEventListener("visibilitychange", () => document.hidden && leave());
setSpeed();
shell.show();
void shell.start();
