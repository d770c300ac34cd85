// The page for programs: connects the blocks, what runs them, the cockpit, and what is shown.

import { download, element, onPress } from "../dom.js";
import { t } from "../language.js";
import { LOST, Shell } from "../shell.js";
import { calledOf } from "../world.js";
import { setUnits } from "./blocks.js";
import { parseProgram } from "./check.js";
import { showControls } from "./controls.js";
import { currentProgram, limitProgram, openEditor, selectBlock, showProgram, textOf } from "./editor.js";
import { ending } from "./endings.js";
import { EXAMPLES } from "./examples.js";
import { setOutcome, showOutput, showPlace, showPrint, showPython } from "./output.js";
import { clearPrints } from "./prints.js";
import { NEW, openWork } from "./keeping.js";
import { packageName } from "./names.js";
import { toPython } from "./python.js";
import { Run } from "./run.js";
import { Side } from "./side.js";
import { Tasks } from "./tasks.js";
import { TeachersSheet } from "./teachers_sheet.js";

const MAX_FILE = 20e6; // bytes that are read at all
const DELAYS = [1000, 500, 200, 0]; // ms before each statement, from slow to fast
const HIDDEN = t("The page was hidden, so the program was stopped.");
const ENDED = t("The program has ended.");
const CHANGED = t("The program was changed. Run it again.");
const NOT_LOADED = t("This could not be loaded. Try again. If that does not help, reload the page.");
const STOPPED = t("Stopped.");
const DEFAULTS = { workshop: true, wheel_separation: 2, max_speed: 1 };

let run = null; // of a program, the last one
let python = { text: "", lines: new Map() };
let changing = null; // the next look at what was changed

const shell = new Shell({
  receivers: {
    hello() {
      work.connected();
      overview.hello();
      judging.hello();
    },
    robots() {
      showUnits();
      if (run && !world.robot(run.robot.id)) endBecause("ended", run.robot);
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
const side = new Side(shell, notLoaded);
const workspace = openEditor(element("blocks"), programChanged);
const work = openWork({
  show: open,
  current: () => ({ name: element("title").value, program: textOf(workspace) }),
  lock(on) {
    workspace.setIsReadOnly(on);
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
  writePython();
}

// The program

function start(stepping) {
  const robot = world.robot(world.chosen);
  clearPrints();
  end();
  judging.forget();
  if (!shell.link.connected || !robot) return refuse(robot ? LOST : world.describeAbsence("was"));
  const delay = () => DELAYS[element("speed").value];
  run = new Run(currentProgram(workspace), robot, stepping, { send, printed, changed: show, ended, delay });
  showControls(run, false); // now: Stop may be pressed at once
  show();
}

function runs() {
  return run !== null && !run.over;
}

// Ends the program, if one runs.
function end(sentence) {
  run?.end(sentence);
}

function printed(text) {
  showPrint(text);
  show();
}

function ended(sentence, block) {
  const { limit } = run;
  judging.programEnded(Boolean(sentence));
  const why = sentence || ENDED;
  setOutcome(limit ? t("{sentence} {limit}", { sentence: why, limit: limit.text }) : why, Boolean(sentence || limit));
  selectBlock(workspace, block ?? limit?.block ?? "");
  show();
}

// The program does not run at all.
function refuse(sentence) {
  judging.programEnded(true);
  setOutcome(sentence, true);
}

// Blockly reports each part of a change, also a little later; where a block lies is no change of the program.
function programChanged() {
  changing ??= setTimeout(() => {
    changing = null;
    limitProgram(workspace, (text) => notice.show(text));
    const before = python.text;
    writePython();
    if (python.text !== before) end(CHANGED);
  });
}

function writePython() {
  python = toPython(workspace, packageName(element("title").value), world.robot(world.chosen) ?? DEFAULTS);
  showPython(python);
  work.changed();
  show();
}

// Shows a program from elsewhere, or says in a sentence why it is refused. Returns whether it is shown.
function open(title, text) {
  try {
    showProgram(workspace, parseProgram(text));
  } catch ({ message }) {
    notice.show(message);
    return false;
  }
  end(CHANGED);
  judging.forget();
  element("title").value = title;
  setOutcome(t("Press Run."));
  showUnits();
  return true;
}

async function openFile({ target }) {
  const [file] = target.files;
  if (file) work.addFile(file.name.replace(/\.json$/, ""), await file.slice(0, MAX_FILE).text());
  target.value = "";
}

function saveProgram() {
  download(`${packageName(element("title").value)}.json`, textOf(workspace), "application/json");
}

function savePackage() {
  writePython();
  const name = packageName(element("title").value);
  import("./package.js").then(({ packageText }) => {
    download(`${name}.txt`, packageText(name, python.text, textOf(workspace)), "text/plain");
  }, notLoaded);
}

// What is shown

function draw() {
  const running = runs() ? run : null;
  showControls(running, judging.isWaiting);
  element("language").disabled = runs() || judging.state.name !== "idle"; // it loads the page again
  showPlace(workspace, running);
  showOutput(workspace, run?.interpreter.variables ?? new Map());
  side.draw();
}

// What a person does

onPress(element("run"), () => start(false), () => false);
onPress(element("end"), () => end(STOPPED));
element("pause").addEventListener("click", () => (run.held ? run.resume() : run.pause()));
element("step").addEventListener("click", () => (runs() ? run.step() : start(true)));
element("title").addEventListener("change", writePython);
element("open").addEventListener("click", () => element("file").click());
element("file").addEventListener("change", openFile);
element("save").addEventListener("click", saveProgram);
element("package").addEventListener("click", savePackage);
element("examples").append(...Object.keys(EXAMPLES).map((name) => new Option(name)));
element("examples").addEventListener("change", ({ target }) => {
  if (target.value) work.add(target.value, EXAMPLES[target.value]);
  target.value = "";
});
addEventListener("keydown", (event) => event.key === "Escape" && end(STOPPED), true);
for (const event of ["pagehide", "freeze"]) addEventListener(event, () => end(HIDDEN));
document.addEventListener("visibilitychange", () => document.hidden && end(HIDDEN));

work.restore(...NEW);
show();
shell.start();
