// What is beside the blocks: the Python, or in its place the map or the curves, which are loaded when they are shown
// first.

/** @import { Shell } from "../shell.js" */

import { element, setText } from "../dom.js";
import { t } from "../language.js";
import { showPrint } from "./output.js";

const TITLES = { python: t("Python"), map: t("Map"), curves: t("Curves") };

export class Side {
  shown = "python";
  rest = "python"; // what is shown where a person has chosen nothing else
  /** @type {any} */
  curves = null; // until they are shown first

  // shell: has the map; run(): the program's run, or null; notLoaded(): says that something is not there
  /** @param {Shell} shell @param {() => any} run @param {() => void} notLoaded */
  constructor(shell, run, notLoaded) {
    this.shell = shell;
    this.run = run;
    this.notLoaded = notLoaded;
    for (const each of ["map", "curves"]) {
      element(`show-${each}`).addEventListener("click", () => this.show(this.shown === each ? this.rest : each));
    }
    element("judge").addEventListener("click", () => this.shown === "curves" || this.show("map"));
  }

  // Whether the program is a text: its place is that of the blocks, and the map, or the curves, are beside it.
  showText(on) {
    if (on === (this.rest === "map")) return;
    this.rest = on ? "map" : "python";
    element("show-map").hidden = on;
    this.show(this.rest);
  }

  show(what) {
    this.shown = what;
    for (const each of ["map", "curves"]) element(`show-${each}`).setAttribute("aria-pressed", what === each);
    setText(element("python-title"), TITLES[what]);
    element("view").hidden = what !== "map";
    element("python").hidden = element("edit").hidden = what !== "python";
    this.curves?.show(what === "curves");
    if (what === "map" && !this.shell.map) this.loadMap();
    if (what === "curves" && !this.curves) this.loadCurves();
  }

  loadMap() {
    const tap = () => {}; // it ends no program
    import("../map.js").then(({ RobotMap }) => this.shell.openMap(RobotMap, tap), this.notLoaded);
  }

  loadCurves() {
    const load = ({ loadCurves }) => loadCurves(this.shell, element("side"), this.run);
    import("../curves/panel.js").then(load).then((curves) => {
      this.curves = curves;
      curves.show(this.shown === "curves");
    }, this.notLoaded);
  }

  // name, value: of a curve, if the program printed these two
  print({ print, name, value }) {
    if (print !== undefined) showPrint(print);
    if (name !== undefined) this.curves?.printed(name, value);
  }

  draw() {
    if (element("map").clientWidth) this.shell.map?.draw();
    this.curves?.draw();
  }
}
