// The socket to the cockpit. It reconnects by itself, measures the round trip, and ends a connection that is cut off.

/** @import { Incoming, Outgoing } from "./messages.js" */
/** @typedef {(message: Outgoing) => boolean} Send whether there is a connection */
/** @typedef {Incoming | { type: "part", bytes: ArrayBuffer }} Message of the cockpit; "part" is a binary one */

import { t } from "./language.js";

const RETRY_INTERVAL = 1500; // ms, on average: not all pages at once
const PING_INTERVAL = 1000; // ms
const SILENCE_TIMEOUT = 3000; // ms; the cockpit sends its state at least once per second
const BACKLOG = 300; // bytes that have not left this device: newer commands do not queue behind them

const NO_COOKIE = 4001;
const ENDS = { // codes with which the cockpit closes the socket
  1001: t("The cockpit has ended: somebody must start it again."),
  4000: t("The cockpit does not understand this page: reload the page."),
  4002: t("The cockpit is full: close a page that nobody needs."),
  4003: t("The cockpit got too many messages from here."),
  4004: t("The cockpit heard nothing from this page for too long."),
};
const CUT_OFF = t("No connection to the cockpit: check the network, and that the cockpit runs.");
const AGAIN = t("This page tries again by itself.");

export class Link {
  /** @type {WebSocket | null} */
  socket = null;
  receivedAt = 0; // as performance.now() counts
  retry = 0; // the timer of the next try

  // receive(message); changed(sentence): what is wrong, "" once connected; refused(): a code is needed; measured(ms)
  /** @param {{ receive: (message: Message) => void, changed: (sentence: string) => void, refused: () => void,
   * measured: (ms: number) => void }} page */
  constructor({ receive, changed, refused, measured }) {
    this.receive = receive;
    this.changed = changed;
    this.refused = refused;
    this.measured = measured;
    setInterval(() => this.check(), PING_INTERVAL);
    addEventListener("pageshow", ({ persisted }) => persisted && this.open()); // by Back: WebKit has closed the socket
  }

  open() {
    clearTimeout(this.retry);
    const previous = this.socket;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.opened(socket);
    socket.onmessage = (event) => this.received(socket, event.data);
    socket.onclose = (event) => this.ended(socket, event.code);
    this.socket = socket;
    this.receivedAt = performance.now();
    previous?.close();
  }

  get connected() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  // Sends the message; returns whether there is a connection.
  /** @param {Outgoing} message */
  send(message) {
    if (this.connected) this.socket?.send(JSON.stringify(message));
    return this.connected;
  }

  // Sends a command, or drops it if earlier ones are still on their way: an old command must not arrive late.
  /** @param {Outgoing} message */
  sendFresh(message) {
    return this.connected && (Number(this.socket?.bufferedAmount) > BACKLOG || this.send(message));
  }

  opened(socket) {
    if (socket !== this.socket) return socket.close();
    this.changed("");
    this.check();
  }

  received(socket, data) {
    if (socket !== this.socket) return;
    this.receivedAt = performance.now();
    const message = typeof data === "string" ? JSON.parse(data) : { type: "part", bytes: data };
    if (message.type === "pong") this.measured(performance.now() - message.sent);
    else this.receive(message);
  }

  ended(socket, code) {
    if (socket !== this.socket) return;
    this.socket = null;
    if (code === NO_COOKIE) return this.refused();
    this.retry = setTimeout(() => this.open(), RETRY_INTERVAL * (0.5 + Math.random()));
    this.changed(`${ENDS[code] ?? CUT_OFF} ${AGAIN}`);
  }

  check() {
    if (!this.socket) return;
    const silence = performance.now() - this.receivedAt;
    if (silence > SILENCE_TIMEOUT) this.abandon();
    else this.send({ type: "ping", sent: performance.now() });
  }

  // A socket whose other end is cut off closes only after a long time: do not wait for it.
  abandon() {
    const { socket } = this;
    this.ended(socket, 0);
    socket?.close();
  }
}
