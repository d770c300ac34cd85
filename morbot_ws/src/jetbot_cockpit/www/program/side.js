// What is beside the blocks: the Python, or the map in its place, which is loaded when it is shown first.

/** @import { Shell } from "../shell.js" */

import { element, setText } from "../dom.js";
import { t } from "../language.js";

export class Side {
  // shell: has the map; notLoaded(): says that it is not there
  /** @param {Shell} shell @param {() => void} notLoaded */
  constructor(shell, notLoaded) {
    this.shell = shell;
    this.notLoaded = notLoaded;
    element("show-map").addEventListener("click", () => this.show(element("view").hidden));
    element("judge").addEventListener("click", () => this.show(true));
  }

  show(map) {
    element("show-map").setAttribute("aria-pressed", map);
    setText(element("python-title"), map ? t("Map") : t("Python"));
    [element("view").hidden, element("python").hidden] = [!map, map];
    if (map && !this.shell.map) this.load();
  }

  load() {
    const tap = () => {}; // it ends no program
    import("../map.js").then(({ RobotMap }) => this.shell.openMap(RobotMap, tap), this.notLoaded);
  }

  draw() {
    if (element("map").clientWidth) this.shell.map?.draw();
  }
}
