// The page for programs: connects the blocks, what runs them, the cockpit, and what is shown.

import { element, onPress } from "../dom.js";
import { t } from "../language.js";
import { LOST, NOT_LOADED, Shell } from "../shell.js";
import { calledOf } from "../world.js";
import { setUnits } from "./blocks.js";
import { showControls } from "./controls.js";
import { selectBlock } from "./editor.js";
import { ending } from "./endings.js";
import { blockVariables, clearOutput, setOutcome, showOutput, showPlace } from "./output.js";
import { NEW, openWork } from "./keeping.js";
import { Run } from "./run.js";
import { Shown } from "./shown.js";
import { Side } from "./side.js";
import { Tasks } from "./tasks.js";
import { TeachersSheet } from "./teachers_sheet.js";

const DELAYS = [1000, 500, 200, 0]; // ms before each statement, from slow to fast
const HIDDEN = t("The page was hidden, so the program was stopped.");
const ENDED = t("The program has ended.");
const CHANGED = t("The program was changed. Run it again.");
const STOPPED = t("Stopped.");

let run = null; // of a program, the last one
let starting = null; // promises the engine of a text that is to run

const shell = new Shell({
  receivers: {
    hello() {
      work.connected();
      void overview.hello();
      judging.hello();
    },
    robots() {
      showUnits();
      if (runs() && !world.robot(run.robot.id)) endBecause("ended", run.robot);
    },
    state() {
      endIfStopped();
      followRobot();
      judging.update();
    },
    tasks({ tasks: offered }) {
      tasks.list(offered);
      overview.show({ tasks: offered });
    },
    scores: ({ scores }) => overview.show({ scores }),
    judge: (message) => judging.answered(message),
    lift: (message) => message.robot === run?.robot.id && end(ending(message)),
    program: (message) => message.robot === run?.robot.id && run.senses.receive(message),
  },
  end: (sentence) => tasks.end(sentence),
  drives: runs,
  changed() {
    end(t("Another robot was chosen."));
    followRobot(); // what is added now is for this one
    showUnits();
  },
  draw,
});
const { world, notice, send } = shell;
const show = () => shell.show();
const notLoaded = () => notice.show(NOT_LOADED);
const side = new Side(shell, () => run, notLoaded);
const shown = new Shown({
  robot: () => world.robot(world.chosen),
  changed(differs) {
    if (differs) end(CHANGED);
    work.changed();
    show();
  },
  replaces(isText) {
    end(CHANGED);
    run = null;
    side.showText(isText);
  },
  keepText: () => work.keepEarlier(),
  say: (sentence) => notice.show(sentence),
  notLoaded,
});
const { workspace } = shown;
const work = openWork({
  show: open,
  current: () => ({ name: element("title").value, program: shown.program }),
  lock(on) {
    shown.lock(on);
    element("title").disabled = on;
  },
  notLoaded,
});
const followRobot = () => work.update(world.chosen, world.state(world.chosen).programs);
const tasks = new Tasks({ send, lost: () => !shell.link.connected, run: () => start(false), end, world });
const { judging } = tasks;
const overview = new TeachersSheet({ send, look: (row) => work.look(row), world });

// The cockpit also refuses the next command; this comes first where the program waits.
function endIfStopped() {
  if (!runs()) return;
  const obstacle = world.obstacle(run.robot.id);
  if (obstacle) endBecause(obstacle, run.robot);
}

function endBecause(code, { id, label }) {
  end(ending({ code, arguments: { robot: label, driver: calledOf(world.state(id).driver) } }));
}

function showUnits() {
  setUnits(workspace, world.robot(world.chosen)?.workshop);
  shown.write();
}

// The program

function start(stepping) {
  const robot = world.robot(world.chosen);
  clearOutput();
  end();
  judging.forget();
  if (!shell.link.connected || !robot) return refuse(robot ? LOST : world.describeAbsence("was"));
  const engine = shown.engine(robot);
  if (!(engine instanceof Promise)) return begin(engine, robot, stepping);
  starting = engine;
  engine.then((loaded) => engine === starting && begin(loaded, robot, stepping),
    () => engine === starting && end(NOT_LOADED));
  setOutcome(t("Starting"));
  showControls(null, true); // now: Stop may be pressed at once
  show();
}

function begin(engine, robot, stepping) {
  starting = null;
  world.trails.set(robot.id, []); // the map shows this drive alone
  const delay = () => DELAYS[element("speed").value];
  run = new Run(engine, robot, stepping, { send, printed, changed: show, ended, delay });
  showControls(run, false);
  show();
}

function runs() {
  return run !== null && !run.over;
}

// Ends the program, if one runs or is about to.
function end(sentence) {
  if (starting && sentence) refuse(sentence);
  starting = null;
  run?.end(sentence);
  show();
}

function printed(event) {
  side.print(event);
  shell.showSoon();
}

function ended(sentence, place) {
  const { limit } = run;
  judging.programEnded(Boolean(sentence));
  const why = sentence || ENDED;
  setOutcome(limit ? t("{sentence} {limit}", { sentence: why, limit: limit.text }) : why, Boolean(sentence || limit));
  shown.failed = place ?? limit?.place ?? null;
  selectBlock(workspace, shown.failed ?? "");
  draw(); // now: with what it printed last
  show();
}

// The program does not run at all.
function refuse(sentence) {
  judging.programEnded(true);
  setOutcome(sentence, true);
}

// Shows a program from elsewhere, or says in a sentence why it is refused. Returns whether it is shown.
function open(title, program) {
  try {
    shown.open(program);
  } catch ({ message }) {
    notice.show(message);
    return false;
  }
  judging.forget();
  element("title").value = title;
  setOutcome(t("Press Run."));
  showUnits();
  return true;
}

// What is shown

function draw() {
  const [running, isText] = [runs() ? run : null, shown.text !== null];
  showControls(running, judging.isWaiting || starting !== null);
  element("language").disabled = runs() || judging.state.name !== "idle"; // it loads the page again
  showPlace(workspace, isText ? null : running);
  shown.mark(running?.at ?? null);
  const values = run?.engine.variables ?? new Map();
  showOutput(isText ? [...values] : blockVariables(workspace, values), Boolean(running?.held));
  side.draw();
}

// What a person does

function onFiles(id, event, act) {
  element(id).addEventListener(event, () => import("./files.js").then(act, notLoaded));
}

onPress(element("run"), () => start(false), () => false);
onPress(element("end"), () => end(STOPPED));
element("pause").addEventListener("click", () => (run.held ? run.resume() : run.pause()));
element("step").addEventListener("click", () => (runs() ? run.step() : start(true)));
element("title").addEventListener("change", () => shown.write());
element("open").addEventListener("click", () => element("file").click());
onFiles("file", "change", ({ openFile }) => openFile(element("file"), work));
onFiles("save", "click", ({ save }) => save(element("title").value, shown.text, shown.program));
onFiles("package", "click", ({ savePackage }) => savePackage(element("title").value, shown.python, shown.program));
element("examples").addEventListener("change", ({ target }) => {
  const name = target.value;
  if (name) import("./examples.js").then(({ EXAMPLES }) => work.add(name, EXAMPLES[name]), notLoaded);
  target.value = "";
});
addEventListener("keydown", (event) => event.key === "Escape" && end(STOPPED), true);
for (const event of ["pagehide", "freeze"]) addEventListener(event, () => end(HIDDEN));
document.addEventListener("visibilitychange", () => document.hidden && end(HIDDEN));

work.restore(...NEW);
show();
void shell.start();
