// How the page looks, measured in the browser. The tests run each of these functions in the page.

const visible = (element) => element.checkVisibility({ opacityProperty: true, visibilityProperty: true })
  && element.getClientRects().length > 0;
const nameOf = (element) => element.id ? `#${element.id}` : `${element.tagName}.${element.className}`;

// Returns the screen's [width, height], also where the page is too wide for it.
function screenSize() {
  const { width, height, scale } = visualViewport;
  return scale < 1 ? [width * scale, height * scale].map(Math.round) : [innerWidth, innerHeight];
}

function misplaced(names) {
  return names.filter((name) => {
    const element = document.getElementById(name);
    const box = element.getBoundingClientRect();
    const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
    const inside = box.x >= 0 && box.y >= 0 && box.right <= innerWidth && box.bottom <= innerHeight;
    return !(inside && box.width > 0 && box.height > 0 && element.contains(top));
  });
}

// Returns the box of what is to be seen of an element: what it is in may hide a part of it.
function shownBox(element) {
  let { left, top, right, bottom } = element.getBoundingClientRect();
  for (let around = element.parentElement; around; around = around.parentElement) {
    if (around === document.body || getComputedStyle(around).overflow === "visible") continue;
    const box = around.getBoundingClientRect();
    [left, top] = [Math.max(left, box.left), Math.max(top, box.top)];
    [right, bottom] = [Math.min(right, box.right), Math.min(bottom, box.bottom)];
  }
  return { left, top, right, bottom };
}

// Returns whether something around an element scrolls down to it.
function scrolls(element) {
  for (let around = element; around; around = around.parentElement) {
    const shown = around === document.documentElement ? innerHeight : around.clientHeight;
    const { position, overflowY } = getComputedStyle(around);
    if (around.scrollHeight > shown + 1 && (overflowY !== "hidden" && overflowY !== "clip") && !around.closest("svg")
      && (around === document.documentElement || overflowY !== "visible")) return true;
    if (position === "fixed") return false;
  }
  return false;
}

// Returns whether the page scrolls below an element.
function isFixed(element) {
  return getComputedStyle(element.closest("section") ?? element).position === "fixed";
}

// What an element is part of: a sheet covers what is below it, and a dialog all.
const layerOf = (element) => element.closest(".sheet, dialog");
const CONTROLS = "button, input, select, a[href]";

// Returns the controls and texts that lie over each other, in pairs.
function overlapping() {
  const parts = [...document.querySelectorAll(`#cockpit :is(${CONTROLS}, p, h2, dl, #pad, .wheel > *)`)]
    .filter((element) => visible(element) && !element.closest(".unseen, meter, svg") && !isFixed(element));
  const boxes = parts.map(shownBox);
  const length = (one, other, start, end) => Math.min(one[end], other[end]) - Math.max(one[start], other[start]);
  const overlap = (one, other) => length(one, other, "left", "right") > 1 && length(one, other, "top", "bottom") > 1;
  return parts.flatMap((one, index) => parts.slice(0, index)
    .filter((other, place) => !other.contains(one) && layerOf(one) === layerOf(other) && overlap(boxes[index], boxes[place]))
    .map((other) => `${nameOf(other)}, ${nameOf(one)}`));
}

function smallControls(least) {
  const seen = (element) => visible(element) && !element.closest(".blocklyToast"); // a hint, which goes by itself
  return [...document.querySelectorAll(CONTROLS)].filter(seen).filter((element) => {
    const { width, height } = (element.closest("label") ?? element).getBoundingClientRect();
    return width < least - 0.1 || height < least - 0.1;
  }).map(nameOf);
}

// Returns what is wrong with the page on this screen, a sentence each. least: px of a control;
// absent: a selector of the controls that such a screen does not show
function faults(least, absent) {
  const say = (names, what) => names.map((name) => `${name} ${what}`);
  const all = [...document.querySelectorAll(`:is(${CONTROLS}, #pad, #sentence, #driver, #outcome)`)];
  const login = document.querySelector("dialog[open]");
  const top = all.filter((element) => !element.closest("[hidden], svg, .blocklyWidgetDiv, .blocklyToast")
    && (login ? login.contains(element) : !element.closest("dialog")));
  const shown = top.filter((element) => visible(element) && !element.closest(".unseen"));
  return [
    ...document.documentElement.scrollWidth > screenSize()[0] ? [`it scrolls sideways to ${widest()}`] : [],
    ...say(cutWords(), "is cut off"), ...login ? [] : say(overlapping(), "overlap"),
    ...say(smallControls(least), `is smaller than ${least} px`),
    ...say(top.filter((each) => !visible(each) && !each.matches(absent)).map(nameOf), "is not shown"),
    ...say(shown.filter(isBeside).map(nameOf), "is beside the screen, or cut off"),
    ...say(shown.filter((each) => isCovered(each) && !each.matches(absent)).map(nameOf), "is covered"),
  ];
}

// Notes from now on what has the focus.
function noteFocus() {
  window.focused ??= (addEventListener("focusin", ({ target }) => window.focused.add(target), true), 0) || new Set();
  window.focused.clear();
  window.focused.add(document.activeElement);
}

// Returns the controls that have not had the focus since then.
function unreached() {
  const around = document.querySelector("dialog[open]") ?? document;
  return [...around.querySelectorAll(`:is(${CONTROLS}, summary, #pad, #python, #output)`)].filter((each) => visible(each)
    && !each.disabled && !each.closest("svg, .blocklyWidgetDiv, #blocks, #text") && !window.focused.has(each))
    .map(nameOf);
}

// Returns the name of what reaches the farthest to the right.
function widest() {
  const right = (element) => element.getBoundingClientRect().right;
  return nameOf([...document.querySelectorAll("body *")].reduce((one, other) => right(other) > right(one) ? other : one));
}

// Returns whether a part of an element is not to be seen, and nothing scrolls to it.
function isBeside(element) {
  const [shown, box] = [shownBox(element), element.getBoundingClientRect()];
  if (box.left < -0.5 || box.right > innerWidth + 0.5 || shown.right - shown.left < box.width - 1) return true;
  return (box.top < -0.5 || box.bottom > innerHeight + 0.5 || shown.bottom - shown.top < box.height - 1) && !scrolls(element);
}

// Returns whether something else is over the middle of an element that is on the screen.
function isCovered(element) {
  const { left, right, top, bottom } = shownBox(element);
  const [x, y] = [(left + right) / 2, (top + bottom) / 2];
  const over = bottom - top > 1 && document.elementFromPoint(x, y);
  if (!over || element.contains(over) || over.contains(element)) return false;
  if (over.closest(".blocklyToast, .cm-tooltip")) return element.id === "stop"; // they go by themselves
  const sheet = over.closest(".sheet");
  if (sheet && !sheet.contains(element)) return element.closest("#stops") !== null;
  return !(isFixed(over) && scrolls(element));
}

// Returns [red, green, blue, alpha] of a computed colour; a canvas converts every notation.
function channels(color) {
  const context = new OffscreenCanvas(1, 1).getContext("2d");
  context.fillStyle = color;
  context.fillRect(0, 0, 1, 1);
  const [red, green, blue, alpha] = context.getImageData(0, 0, 1, 1).data;
  return [red, green, blue, alpha / 255];
}

// Returns [the number of the map's pixels that have this colour, x, y of their middle].
function pixelsOnMap(map, color) {
  const [red, green, blue] = channels(color);
  const { data } = map.getContext("2d").getImageData(0, 0, map.width, map.height);
  let [number, x, y] = [0, 0, 0];
  for (let index = 0; index < data.length; index += 4) {
    if (data[index] !== red || data[index + 1] !== green || data[index + 2] !== blue) continue;
    number += 1;
    x += index / 4 % map.width;
    y += Math.floor(index / 4 / map.width);
  }
  return [number, x / number, y / number];
}

// Returns whether a pixel of the map has this colour.
function showsOnMap(color) {
  return pixelsOnMap(document.getElementById("map"), color)[0] > 0;
}

// Returns [how large the chosen robot is, how far its middle is from the map's], in pixels, or null.
function robotOnMap() {
  const map = document.getElementById("map");
  const color = getComputedStyle(document.documentElement).getPropertyValue("--robot");
  const [number, x, y] = pixelsOnMap(map, color);
  return number ? [Math.sqrt(number), Math.hypot(x - map.width / 2, y - map.height / 2)] : null;
}

function cut(selector) {
  const isCut = (element) => !visible(element) || element.scrollWidth > element.clientWidth + 1;
  return [...document.querySelectorAll(selector)].filter(isCut).map((element) => element.textContent);
}

function outside(selector, container) {
  const around = document.querySelector(container).getBoundingClientRect();
  return [...document.querySelectorAll(selector)].filter((element) => {
    const box = element.getBoundingClientRect();
    return box.top < around.top || box.bottom > around.bottom + 0.5 || box.right > around.right + 0.5;
  }).map((element) => element.textContent);
}

function underTools() {
  const map = document.getElementById("map");
  const { offsetTop: top, offsetHeight: height } = document.getElementById("tools");
  const bottom = document.getElementById("legend").offsetTop - 26; // the scale
  return [...document.querySelectorAll("#fleet li")].filter((row) => {
    const [number, , y] = pixelsOnMap(map, row.style.getPropertyValue("--robot"));
    return !(number && y > top + height && y < bottom);
  }).map((row) => row.textContent);
}

// Returns the relative luminance of a computed colour, as WCAG defines it.
function luminance(color) {
  const linear = channels(color).slice(0, 3).map((part) => part / 255).map((part) =>
    part <= 0.03928 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

function contrastOfRobot() {
  const bar = getComputedStyle(document.querySelector(".fill")).backgroundColor;
  const grounds = [".track", "body"].map((selector) => getComputedStyle(document.querySelector(selector)));
  return grounds.map(({ backgroundColor }) => contrast(bar, backgroundColor));
}

function contrast(one, other) {
  const [dark, light] = [luminance(one), luminance(other)].sort((low, high) => low - high);
  return (light + 0.05) / (dark + 0.05);
}

// Returns what of Blockly's blocks is hard to see: texts, and the frame of the one with the focus.
function faintBlocks() {
  const faint = [];
  for (const block of Blockly.getMainWorkspace().getAllBlocks().filter((each) => each.isEnabled())) {
    const path = block.pathObject.svgPath, fill = getComputedStyle(path).fill;
    Blockly.getFocusManager().focusNode(block);
    const around = block.getParent() ?? block;
    const frame = Math.max(...[block, around].map(({ pathObject: { svgPath } }) =>
      contrast(getComputedStyle(path).stroke, getComputedStyle(svgPath).fill)));
    if (frame < 3) faint.push(`${block.type}: frame ${frame}`);
    for (const field of block.getFields()) {
      const [text, box] = ["text", ".blocklyFieldRect"].map((part) => field.getSvgRoot()?.querySelector(part));
      if (!text?.textContent.trim()) continue;
      const ground = box ? blend(getComputedStyle(box), fill) : fill;
      const ratio = contrast(getComputedStyle(text).fill, ground);
      if (ratio < 4.5) faint.push(`${block.type}: ${text.textContent} ${ratio}`);
    }
  }
  return faint;
}

// Returns the colour of a box over another colour.
function blend({ fill, fillOpacity }, below) {
  const [top, bottom] = [fill, below].map((color) => color.match(/[\d.]+/g).map(Number));
  return `rgb(${top.slice(0, 3).map((part, index) => Math.round(part * fillOpacity + bottom[index] * (1 - fillOpacity)))})`;
}

const NO_LANGUAGE = "[translate=no], .language, #python, #prints, #variables, #work-list .name, #all-programs,"
  + " .cm-tooltip-autocomplete, script";
const WORDS_IN = ["title", "aria-label", "aria-roledescription", "aria-valuetext", "placeholder"];

// Returns what a person sees or hears of the page that is not in brackets, nor one of these words.
function untranslated(known) {
  const shown = [...document.querySelectorAll("body *")].filter((element) => !element.closest(NO_LANGUAGE)
    && (visible(element) || element.tagName === "OPTION" && visible(element.closest("select"))));
  const words = ({ childNodes }) => [...childNodes].filter((child) => child instanceof Text).map(({ data }) => data);
  const texts = shown.flatMap((element) => [ // a block's sentence is in several elements
    ...(element.matches(".blocklyBlockCanvas") ? [element.textContent] : element.closest("svg") ? [] : words(element)),
    ...WORDS_IN.map((name) => element.getAttribute(name) ?? "")]);
  return [...new Set(texts.filter((text) => (unbracketed(text).match(/\p{L}{2,}/gu) ?? [])
    .some((word) => !known.includes(word))))];
}

// Returns the text without what is in brackets, also in brackets of brackets.
function unbracketed(text) {
  const inner = text.replace(/\[[^[\]]*\]/g, "");
  // Blockly shows what begins or ends all choices of a list once, beside them
  return inner === text ? text.replace(/(^|: )[^[\]]*\]|\[[^[\]]*$/g, "") : unbracketed(inner);
}

// Returns the buttons, headings and labels whose text is not shown to its end.
function cutWords() {
  const isCut = (element) => element.scrollWidth > element.clientWidth + 1 || element.scrollHeight > element.clientHeight + 2;
  return [...document.querySelectorAll("button, h1, h2, h3, label, legend, summary, th")]
    .filter((element) => visible(element) && !element.closest(".unseen") && element.clientWidth && isCut(element))
    .map((element) => `${nameOf(element)}: ${element.textContent.trim()}`);
}
