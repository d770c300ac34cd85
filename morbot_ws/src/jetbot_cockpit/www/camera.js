// What the chosen robot's camera sees, while a person looks, and the pictures of it that are collected.

/** @import { Send } from "./link.js" */
/** @import { World } from "./world.js" */

import { element, onPress, onSurePress, setClass, setText } from "./dom.js";
import { said, t } from "./language.js";

const TIMEOUT = 2000; // ms without a picture
const NO_PICTURE = t("No picture. Is the robot's camera on? (camera:=true) Pictures above 1 MB are not shown.");
const OFF = t("Your teacher has switched the cameras off.");
const LABELS = {
  free: (number) => t("Free {number}", { number }), blocked: (number) => t("Blocked {number}", { number }),
};

export class Camera {
  /** @type {string | null} */
  robot = null; // whose pictures the cockpit was asked for
  parts = []; // of the picture that comes
  off = false; // for this person

  /** @param {World} world @param {Send} send */
  constructor(world, send) {
    this.world = world;
    this.send = send;
    const button = element("show-camera");
    button.addEventListener("click", () => this.open(button.getAttribute("aria-pressed") === "false"));
    document.addEventListener("visibilitychange", () => this.look());
    for (const label of /** @type {("free" | "blocked")[]} */ (Object.keys(LABELS))) {
      onPress(element(`save-${label}`), () => send({ type: "save", robot: world.chosen, label }), () => false);
    }
    const remove = () => send({ type: "delete", robot: world.chosen });
    this.askNoMore = onSurePress(element("delete"), t("Delete all?"), remove);
  }

  open(on) {
    element("show-camera").setAttribute("aria-pressed", on);
    element("sight").hidden = !on;
    setClass(document.body, "looking", on);
    this.look();
  }

  show() {
    const { pictures } = this.world.state(this.world.chosen);
    element("collect").hidden = !pictures || this.off;
    for (const [label, words] of Object.entries(LABELS)) {
      setText(element(`save-${label}`), words(pictures?.[label]));
    }
    setText(element("collect-text"), pictures?.problem ? said(pictures.problem) : "");
    this.look();
  }

  // Asks for the pictures of the robot that a person sees now, or for none.
  look() {
    const { view = "drive" } = document.body.dataset;
    const covered = ["codes", "scores"].includes(view) || !element("sight").clientWidth;
    const wanted = covered || document.hidden || this.off ? null : this.world.robot(this.world.chosen)?.id ?? null;
    if (wanted === this.robot || !this.send({ type: "look", robot: wanted })) return;
    this.robot = wanted;
    this.askNoMore();
    this.clear("");
    element("camera").setAttribute("aria-label", t("What {robot} sees", { robot: this.world.robot(wanted)?.label }));
  }

  // A teacher has switched the cameras of pupils, and sees all.
  allow(on) {
    /** @type {HTMLInputElement} */ (element("cameras-switch")).checked = on;
    this.off = !on && !this.world.teacher;
    this.clear("");
  }

  // A connection begins: the cockpit does not know what was asked for.
  forget() {
    this.robot = null;
  }

  // A picture has begun to come, in parts.
  begin(header) {
    this.header = header;
    this.parts = [];
    this.missing = header.bytes;
  }

  // The next one is sent once this one is acknowledged: a slow device gets fewer pictures, never later ones.
  async take(part) {
    const { header, parts } = this;
    parts.push(part);
    this.missing -= part.byteLength;
    if (this.missing <= 0) await this.draw(header, parts);
    this.send({ type: "seen", number: header.number });
  }

  async draw({ robot }, parts) {
    const picture = await createImageBitmap(new Blob(parts, { type: "image/jpeg" })).catch(() => null);
    if (picture && robot === this.robot && !this.off) {
      this.clear("", false);
      const { width, height } = picture;
      const canvas = element("camera");
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      canvas.getContext("2d").drawImage(picture, 0, 0);
    }
    picture?.close();
  }

  // Says what is shown instead of a picture; an old one would look as if it were now.
  clear(text, hidden = true) {
    setText(element("no-picture"), this.off ? OFF : text);
    element("camera").hidden = hidden;
    clearTimeout(this.timer);
    if (this.robot !== null && !text) this.timer = setTimeout(() => this.clear(NO_PICTURE), TIMEOUT);
  }
}
