// The connection to the cockpit.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Link } from "#www/link.js";

import { Clock } from "./clock.js";

const CLOSED = 3;

class FakeSocket {
  static OPEN = 1;
  readyState = 0;
  bufferedAmount = 0;
  sent = [];

  constructor(url) {
    this.url = url;
  }

  open() {
    this.readyState = FakeSocket.OPEN;
    this.onopen();
  }

  send(text) {
    this.sent.push(JSON.parse(text));
  }

  receive(data) {
    this.onmessage({ data });
  }

  close(code = 1006, reason = "") {
    this.readyState = CLOSED;
    this.onclose({ code, reason });
  }
}

// Returns a link that has tried to connect, and what it has told the page.
function begin(t) {
  const told = { received: [], problems: [], refused: 0, roundTrips: [], sockets: [] };
  globalThis.location = { protocol: "http:", host: "robot:8080" };
  globalThis.WebSocket = class extends FakeSocket {
    constructor(url) {
      super(url);
      told.sockets.push(this);
    }
  };
  const listeners = [];
  globalThis.addEventListener = (type, call) => listeners.push([type, call]);
  const show = (persisted) => [...listeners].forEach(([type, call]) => type === "pageshow" && call({ persisted }));
  const clock = new Clock(t);
  const link = new Link({
    receive: (message) => told.received.push(message), changed: (sentence) => told.problems.push(sentence),
    refused: () => { told.refused += 1; }, measured: (ms) => told.roundTrips.push(ms),
  });
  link.open();
  return { ...told, clock, listeners, show, link, told, socket: told.sockets[0] };
}

function connect(t) {
  const state = begin(t);
  state.socket.open();
  return state;
}

const OFFLINE = "No connection to the cockpit: check the network, and that the cockpit runs."
  + " This page tries again by itself.";

test("the socket is the one of the page's own host, encrypted if the page is", (t) => {
  const { link, socket, sockets } = begin(t);
  globalThis.location.protocol = "https:";
  link.open();
  assert.deepEqual([socket.url, sockets[1].url], ["ws://robot:8080/socket", "wss://robot:8080/socket"]);
});

test("the page hears that it is connected, and each message, pictures as parts", (t) => {
  const { link, socket, problems, received } = connect(t);
  const bytes = new ArrayBuffer(3);
  socket.receive('{"type": "notice", "text": "Hello."}');
  socket.receive(bytes);
  assert.deepEqual([link.connected, problems], [true, [""]]);
  assert.deepEqual(received, [{ type: "notice", text: "Hello." }, { type: "part", bytes }]);
});

test("nothing is sent before there is a connection, and the sender knows", (t) => {
  const { link, socket } = begin(t);
  assert.equal(link.send({ type: "stop" }), false);
  assert.deepEqual(socket.sent, []);
});

test("a new command does not queue behind old ones, but a stop does", (t) => {
  const { link, socket } = connect(t);
  socket.sent.length = 0;
  socket.bufferedAmount = 400;
  assert.equal(link.sendFresh({ type: "drive" }), true);
  assert.equal(link.send({ type: "stop" }), true);
  assert.deepEqual(socket.sent, [{ type: "stop" }]);
});

test("the round trip is measured once per second", async (t) => {
  const { clock, socket, roundTrips } = connect(t);
  await clock.pass(1000);
  assert.equal(socket.sent.length, 2);
  await clock.pass(40);
  socket.receive(JSON.stringify({ type: "pong", sent: socket.sent[1].sent }));
  assert.deepEqual(roundTrips, [40]);
});

test("a connection that is lost is opened again", async (t) => {
  const { clock, link, socket, sockets, problems } = connect(t);
  socket.close();
  assert.deepEqual([link.connected, problems.at(-1)], [false, OFFLINE]);
  await clock.pass(2250);
  assert.equal(sockets.length, 2);
  sockets[1].open();
  assert.deepEqual([link.connected, problems.at(-1)], [true, ""]);
});

test("a page that Back brings out of the browser's cache connects at once, and one that is loaded only once", (t) => {
  const { show, socket, sockets, problems } = connect(t);
  show(false);
  assert.equal(sockets.length, 1);
  show(true);
  socket.close();
  assert.equal(sockets.length, 2);
  assert.deepEqual(problems, [""], "nothing is wrong");
});

test("however often it has connected again, Back, a second and a message count once, and nothing more is listened to",
  async (t) => {
    const { clock, listeners, show, sockets, received } = connect(t);
    for (let count = 0; count < 3; count += 1) {
      sockets.at(-1).close();
      await clock.pass(2250);
      sockets.at(-1).open();
    }
    show(true);
    assert.deepEqual([sockets.length, listeners.length], [5, 1]);
    sockets[4].open();
    sockets[4].sent.length = 0;
    await clock.pass(1000);
    sockets[4].receive('{"type": "state"}');
    assert.deepEqual([sockets[4].sent.length, received.length], [1, 1]);
  });

test("a connection that is cut off without an end is given up after three seconds", async (t) => {
  const { clock, socket, problems } = connect(t);
  for (let second = 0; second < 5; second += 1) {
    await clock.pass(1000);
    socket.receive('{"type": "state"}');
  }
  assert.equal(problems.at(-1), "");
  await clock.pass(4000);
  assert.equal(problems.at(-1), OFFLINE);
});

test("what an old connection still says is not heard", (t) => {
  const { link, socket, sockets, received, problems } = connect(t);
  link.open();
  sockets[1].open();
  socket.receive('{"type": "state"}');
  assert.equal(socket.readyState, CLOSED);
  assert.deepEqual([received, problems], [[], ["", ""]]);
});

test("without a code the page asks for one, and does not try again", async (t) => {
  const { clock, socket, sockets, told } = connect(t);
  socket.close(4001, "log in first");
  await clock.pass(10000);
  assert.deepEqual([told.refused, sockets.length], [1, 1]);
});

const ENDS = {
  1001: "The cockpit has ended: somebody must start it again.",
  4000: "The cockpit does not understand this page: reload the page.",
  4002: "The cockpit is full: close a page that nobody needs.",
  4003: "The cockpit got too many messages from here.",
  4004: "The cockpit heard nothing from this page for too long.",
};

for (const [code, sentence] of Object.entries(ENDS)) {
  test(`an end with code ${code} says: ${sentence}`, (t) => {
    const { socket, problems } = connect(t);
    socket.close(Number(code), "in English");
    assert.equal(problems.at(-1), `${sentence} This page tries again by itself.`);
  });
}
