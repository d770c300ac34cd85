// What the pad and the programs share: the connection, the login, the robots, the stops, and when all is shown.

import "./composing.js";
import { element, setText } from "./dom.js";
import { keepFocus, reachScrollers } from "./focus.js";
import { said, t } from "./language.js";
import { offerLanguages } from "./language_choice.js";
import { Link } from "./link.js";
import { LoginForm, logIn, NameField, storedName, takeCodeFromAddress } from "./login.js";
import { Notice } from "./notice.js";
import { holds } from "./refusals.js";
import { Choice } from "./robots.js";
import { showRoundTrip, showStatus } from "./status.js";
import { Stops } from "./stops.js";
import { World } from "./world.js";

export const LOST = t("The connection to the cockpit was lost.");
export const NOT_LOADED = t("This could not be loaded. Try again. If that does not help, reload the page.");
const NEW_CODES = t("Your code is not valid any more. Enter the new one.");
const NO_COOKIES = t("This browser refuses cookies, so the code does not last. Allow cookies, and reload the page.");
const STOPPED = t("All robots were stopped.");
const PAUSE = 75; // ms between two frames for which no person waits
const ASKED = t("The cockpit asked for the code.");

/** @import { Message } from "./link.js" */
/** @import { RobotMap } from "./map.js" */
/** @import { Outgoing } from "./messages.js" */
/** @typedef {{ [Type in Message["type"]]?: (message: Extract<Message, { type: Type }>) => void }} Receivers */

export class Shell {
  problem = t("Connecting"); // why there is no connection
  world = new World();
  notice = new Notice();
  /** @type {RobotMap | null} */
  map = null; // until it is shown first
  #codeError = ""; // why the cockpit may ask for the code now
  #frame = 0; // the next one, which shows what has changed; 0 for none
  #shownAt = -Infinity; // when the last one was
  #later = 0; // the timer of a frame that nobody waits for; 0 for none

  // receivers: what else the page does with a message, by its type; end(sentence): nothing drives any more, and why;
  // drives(): whether this page drives its robot; changed(): another robot was chosen; draw(): shows what has changed
  /** @param {{ receivers: Receivers, end: (sentence: string) => void, drives: () => boolean, changed: () => void,
   * draw: () => void }} page */
  constructor({ receivers, end, drives, changed, draw }) {
    this.receivers = receivers;
    this.end = end;
    this.drives = drives;
    this.changed = changed;
    this.draw = draw;
    this.link = new Link({
      receive: (message) => this.#receive(message), changed: (sentence) => this.#connectionChanged(sentence),
      refused: () => this.#askForCode(), measured: showRoundTrip,
    });
    this.name = new NameField(this.world, this.send);
    this.login = new LoginForm(() => this.#codeAccepted());
    this.choice = new Choice(this.world, () => this.#robotChanged());
    const lost = () => !this.link.connected;
    this.stops = new Stops(this.world, { send: this.send, lost, notice: this.notice, stopped: () => end(STOPPED) });
    offerLanguages();
    addEventListener("hashchange", () => { if (location.hash) void this.start(); });
  }

  // Sends a message; returns whether there is a connection. An old command must not arrive late.
  send = (/** @type {Outgoing} */ message) => (message.type === "drive" && (message.forward || message.left)
    ? this.link.sendFresh(message) : this.link.send(message));

  // Connects, with the code in the address if there is one; after a wrong one, too: an earlier one may still hold.
  async start() {
    const code = takeCodeFromAddress();
    const error = code && await logIn(code);
    this.login.close();
    if (code && !error) return this.#codeAccepted();
    this.#codeError = error;
    this.link.open();
  }

  // If the cockpit asks for it again now, its cookie was refused.
  #codeAccepted() {
    this.#codeError = NO_COOKIES;
    this.link.open();
  }

  // Shows why the cockpit refuses something, as long as it does.
  refuse(message, robot) {
    this.notice.show(said(message), () => holds(message.code, this.world, robot, this.drives()));
  }

  // Shows the robots on a map from now on. tap(id): one of them was tapped
  /** @param {typeof RobotMap} Kind @param {(id: string) => void} tap */
  openMap(Kind, tap) {
    const lost = () => !this.link.connected;
    this.map ??= new Kind(element("map"), this.world, { choose: tap, redraw: () => this.show(), lost });
    this.map.showCourse(this.world.chosen);
  }

  show() {
    if (this.#frame) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      this.#shownAt = performance.now();
      showStatus(this.world, this.problem);
      this.notice.update();
      this.stops.show();
      this.name.show();
      this.draw();
      reachScrollers();
      keepFocus();
    });
  }

  // Shows what a program has changed: it may do so again and again, and each frame takes some of a battery.
  showSoon() {
    if (this.#later) return;
    this.#later = setTimeout(() => {
      this.#later = 0;
      this.show();
    }, this.#shownAt + PAUSE - performance.now());
  }

  /** @type {Receivers} */
  #takes = {
    hello: (message) => {
      this.#codeError = "";
      this.world.hello(message);
      if (storedName()) this.send({ type: "name", name: storedName() });
    },
    robots: (message) => {
      const changes = this.world.list(message);
      if (changes) this.notice.show(changes);
      this.choice.begin();
    },
    state: (message) => {
      this.world.update(message);
      this.stops.update();
      this.map?.update();
    },
    trail: (message) => this.world.trail(message),
    scene: (message) => this.world.scene(message) && this.map?.showCourse(message.robot),
    notice: (message) => this.refuse(message, this.world.chosen),
  };

  #receive(message) {
    this.#takes[message.type]?.(message);
    this.receivers[message.type]?.(message);
    if (message.type !== "program") this.show(); // that answers a running program, ten times a second
  }

  #connectionChanged(sentence) {
    this.problem = sentence;
    if (sentence) {
      this.end(LOST);
      setText(element("link"), "–");
    } else {
      this.stops.resend();
    }
    this.show();
  }

  #askForCode() {
    this.end(ASKED);
    this.login.ask(this.#codeError || (this.world.me.id === null ? "" : NEW_CODES));
    this.#codeError = "";
  }

  #robotChanged() {
    this.changed();
    this.map?.follow(true);
    this.map?.showCourse(this.world.chosen);
    this.show();
  }
}
