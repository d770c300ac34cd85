// The blocks on the page: Blockly's workspace, in the page's colours.

import { element } from "../dom.js";
import { t } from "../language.js";
import { defineBlocks, TOOLBOX } from "./blocks.js";
import { NO_PROGRAM, Refusal, writeProgram } from "./check.js";
import { prepareGenerator } from "./python.js";
import { Room } from "./room.js";
import { describeBlocks } from "./spoken.js";

const { Blockly } = globalThis;
const DARK = matchMedia("(prefers-color-scheme: dark)");
const COLORS = { // of Blockly's parts: the page's names
  workspaceBackgroundColour: "--ground", toolboxBackgroundColour: "--surface", toolboxForegroundColour: "--text",
  flyoutBackgroundColour: "--calm-ground", flyoutForegroundColour: "--text", scrollbarColour: "--muted",
};

const [HEIGHT, PADDING] = matchMedia("(any-pointer: coarse)").matches ? [40, 14] : [26, 8]; // for a finger, a mouse
const SIZES = { // of the fields, and of what has none
  FIELD_BORDER_RECT_HEIGHT: HEIGHT, FIELD_DROPDOWN_BORDER_RECT_HEIGHT: HEIGHT, FIELD_BORDER_RECT_X_PADDING: PADDING,
  EMPTY_INLINE_INPUT_HEIGHT: HEIGHT, DUMMY_INPUT_MIN_HEIGHT: HEIGHT, MIN_BLOCK_HEIGHT: HEIGHT,
};
const MEDIA = new URL("../vendor/blockly/media/", import.meta.url).href;
const STYLES = { // of Blockly's own blocks, on which white text stands out
  logic_blocks: "#2a6a8a", loop_blocks: "#3c7a1f", math_blocks: "#4a55b5", text_blocks: "#6a4fb5",
  variable_blocks: "#a03060", procedure_blocks: "#8a4a9a",
};

const BLOCKLYS = ".injectionDiv, .blocklyWidgetDiv, .blocklyDropDownDiv"; // which take keys themselves
const { registry } = Blockly.ShortcutRegistry;
const { mover } = Blockly.KeyboardMover;
const { bumpNeighbours } = Blockly.BlockSvg.prototype;
let dropped = false; // whether a person has just dropped a block

// Blockly moves blocks apart whenever it draws them: a program that is opened would not stay as it was saved.
/** @this {any} */
function bumpDropped() {
  if (dropped) bumpNeighbours.call(this);
}

function bump(block, group) {
  dropped = true;
  Blockly.Events.setGroup(group);
  block?.bumpNeighbours();
  Blockly.Events.setGroup(false);
  dropped = false;
}

// Returns a new workspace in this element. changed(): the program is another one
export function openEditor(target, changed) {
  defineBlocks();
  prepareGenerator();
  describeBlocks();
  Blockly.BlockSvg.prototype.bumpNeighbours = bumpDropped;
  const workspace = Blockly.inject(target, {
    toolbox: TOOLBOX, media: MEDIA, renderer: "thrasos", theme: theme(), sounds: false,
    trashcan: true, comments: false, collapse: false, disable: false, maxInstances: { robot_start: 1 },
    rendererOverrides: SIZES,
    zoom: { controls: true, pinch: true, wheel: false, startScale: 0.9, minScale: 0.4, maxScale: 2 },
    move: { scrollbars: true, drag: true, wheel: true }, grid: { spacing: 24, length: 2, colour: "#8884", snap: false },
  });
  Blockly.ShortcutItems.registerNavigationShortcuts();
  target.querySelector("[role=tree]").setAttribute("aria-label", t("Kinds of blocks"));
  addEventListener("keydown", (event) => isForBlocks(event) && registry.onKeyDown(workspace, event));
  endMovesOutside(target);
  workspace.addChangeListener(Blockly.Events.disableOrphans);
  workspace.addChangeListener((event) => event.isUiEvent || changed());
  workspace.addChangeListener(() => workspace.updateAriaLabel()); // how many stacks there are
  workspace.addChangeListener((event) => event.type === Blockly.Events.BLOCK_DRAG && !event.isStart
    && bump(workspace.getBlockById(event.blockId), event.group));
  DARK.addEventListener("change", () => workspace.setTheme(theme()));
  new ResizeObserver(() => Blockly.svgResize(workspace)).observe(target);
  return workspace;
}

// T and W lead from anywhere to the toolbox and the workspace, except where a key is text or a choice.
function isForBlocks({ key, ctrlKey, altKey, metaKey, target }) {
  return /^[tw]$/i.test(key) && !(ctrlKey || altKey || metaKey) && element("text").hidden && !element("blocks").inert
    && !target.closest(`input:not([type=range]), select, dialog, #text, ${BLOCKLYS}`);
}

// Tab, or a press elsewhere, ends a move. Blockly itself does so once the focus has left the block, and takes it back.
function endMovesOutside(target) {
  addEventListener("keydown", ({ key }) => key === "Tab" && endMove(), true);
  addEventListener("pointerdown", (event) => event.composedPath().includes(target) || endMove(), true);
}

function endMove() {
  if (mover.isMoving()) mover.abortMove(); // by keys
}

function theme() {
  const style = getComputedStyle(document.documentElement);
  const colors = Object.entries(COLORS).map(([part, name]) => [part, style.getPropertyValue(name).trim()]);
  const styles = Object.entries(STYLES).map(([name, colourPrimary]) => [name, { colourPrimary }]);
  return Blockly.Theme.defineTheme(DARK.matches ? "night" : "day", {
    name: DARK.matches ? "night" : "day", base: Blockly.Themes.Classic,
    blockStyles: Object.fromEntries(styles),
    componentStyles: { ...Object.fromEntries(colors), flyoutOpacity: 1, scrollbarOpacity: 0.6 },
  });
}

// Shows this program, or the one before and throws a Refusal; its first block is always there.
export function showProgram(workspace, program) {
  endMove();
  const before = currentProgram(workspace);
  try {
    Blockly.serialization.workspaces.load(program, workspace);
  } catch {
    Blockly.serialization.workspaces.load(before, workspace);
    throw new Refusal(NO_PROGRAM);
  }
  const [start] = workspace.getBlocksByType("robot_start");
  const first = start ?? Blockly.serialization.blocks.append({ type: "robot_start", x: 30, y: 30 }, workspace);
  first.setDeletable(false);
  workspace.clearUndo();
  workspace.scroll(0, 0);
}

// Selects the block with this id, if it is there. The keyboard's focus stays where it is, unless that is in the blocks.
export function selectBlock(workspace, id) {
  const block = workspace.getBlockById(id);
  const focused = /** @type {any} */ (document.activeElement);
  if (!block) return;
  Blockly.common.setSelected(block);
  if (!focused.closest("#blocks")) focused.focus();
}

const room = new Room();

// Undoes the last change if it makes the program too large to be kept, or to be opened again; says why.
export function limitProgram(workspace, say) {
  const problem = room.change(writeProgram(currentProgram(workspace)), workspace.getUndoStack().length > 0);
  if (!problem) return;
  workspace.undo(false);
  say(problem);
}

export function currentProgram(workspace) {
  return Blockly.serialization.workspaces.save(workspace);
}

// Returns it as it is saved and kept. python: of a program that is a text
export function textOf(workspace, python) {
  return writeProgram({ ...currentProgram(workspace), python });
}
