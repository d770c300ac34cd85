// The connection to the cockpit.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Link } from "#www/link.js";

import { Clock } from "./clock.js";
import { FakeSocket } from "./socket.js";
import { play, sight } from "./steps.js";

// Opens a link with a clock; returns what it has told the page, and what the browser and the cockpit do.
function open(t) {
  FakeSocket.all = [];
  const page = { received: [], problems: [], refused: 0, roundTrips: [], sockets: FakeSocket.all, listeners: [] };
  globalThis.location = { protocol: "http:", host: "robot:8080" };
  globalThis.addEventListener = (_, call) => page.listeners.push(call);
  page.clock = new Clock(t);
  page.link = new Link({
    receive: (message) => page.received.push(message), changed: (sentence) => page.problems.push(sentence),
    refused: () => { page.refused += 1; }, measured: (ms) => page.roundTrips.push(ms),
  });
  page.link.open();
  return page;
}

const newest = ({ sockets }) => sockets.at(-1);
const connect = (page) => newest(page).open();
const lose = (code) => (page) => newest(page).close(code, "in English");
const receive = (data) => (page) => newest(page).receive(data);
const show = (persisted) => ({ listeners }) => listeners.forEach((call) => call({ persisted }));
const reopen = ({ link }) => link.open();
const STATE = '{"type": "state"}';

const sees = sight({
  connected: ({ link }) => link.connected, problem: ({ problems }) => problems.at(-1),
  urls: ({ sockets }) => sockets.map(({ url }) => url), opened: ({ sockets }) => sockets.length,
  sent: (page) => newest(page).sent.map(({ type }) => type), listens: ({ listeners }) => listeners.length,
});

const AGAIN = "This page tries again by itself.";
const OFFLINE = `No connection to the cockpit: check the network, and that the cockpit runs. ${AGAIN}`;
const PICTURE = new ArrayBuffer(3);
const NOTICE = { type: "notice", text: "Hello." };
const ENDS = {
  1001: "The cockpit has ended: somebody must start it again.",
  4000: "The cockpit does not understand this page: reload the page.",
  4002: "The cockpit is full: close a page that nobody needs.",
  4003: "The cockpit got too many messages from here.",
  4004: "The cockpit heard nothing from this page for too long.",
};

const TESTS = {
  "the socket is the one of the page's own host, encrypted if the page is": [
    () => Object.assign(location, { protocol: "https:" }), reopen,
    sees({ urls: ["ws://robot:8080/socket", "wss://robot:8080/socket"] })],
  "the page hears that it is connected, and each message, pictures as parts": [
    connect, receive(JSON.stringify(NOTICE)), receive(PICTURE),
    sees({ connected: true, problems: [""], received: [NOTICE, { type: "part", bytes: PICTURE }] })],
  "nothing is sent before there is a connection, and the sender knows": [
    ({ link }) => assert.equal(link.send({ type: "stop" }), false), sees({ sent: [] })],
  "a new command does not queue behind old ones, but a stop does": [
    connect, (page) => Object.assign(newest(page), { bufferedAmount: 400 }),
    ({ link }) => assert.deepEqual([link.sendFresh({ type: "drive" }), link.send({ type: "stop" })], [true, true]),
    sees({ sent: ["ping", "stop"] })],
  "the round trip is measured once per second": [
    connect, 1000, sees({ sent: ["ping", "ping"] }), 40,
    (page) => newest(page).receive(JSON.stringify({ type: "pong", sent: newest(page).sent[1].sent })),
    sees({ roundTrips: [40] })],
  "a connection that is lost is opened again": [
    connect, lose(), sees({ connected: false, problem: OFFLINE }), 2250, sees({ opened: 2 }), connect,
    sees({ connected: true, problem: "" })],
  "a page that Back brings out of the browser's cache connects at once, and one that is loaded only once": [
    connect, show(false), sees({ opened: 1 }), show(true), ({ sockets }) => sockets[0].close(),
    sees({ opened: 2, problems: [""] })],
  "however often it has connected again, Back, a second and a message count once, and nothing more is listened to": [
    connect, ...Array(3).fill([lose(), 2250, connect]).flat(), show(true), sees({ opened: 5, listens: 1 }), connect,
    1000, receive(STATE), sees({ sent: ["ping", "ping"], received: [{ type: "state" }] })],
  "a connection that is cut off without an end is given up after three seconds": [
    connect, ...Array(5).fill([1000, receive(STATE)]).flat(), sees({ problem: "" }), 4000, sees({ problem: OFFLINE })],
  "what an old connection still says is not heard": [
    connect, reopen, connect, ({ sockets: [old] }) => old.receive(STATE),
    ({ sockets: [old] }) => assert.equal(old.readyState, FakeSocket.CLOSED),
    sees({ received: [], problems: ["", ""] })],
  "without a code the page asks for one, and does not try again": [
    connect, lose(4001), 10000, sees({ refused: 1, opened: 1 })],
  ...Object.fromEntries(Object.entries(ENDS).map(([code, sentence]) => [
    `an end with code ${code} says: ${sentence}`,
    [connect, lose(Number(code)), sees({ problem: `${sentence} ${AGAIN}` })],
  ])),
};
for (const [what, steps] of Object.entries(TESTS)) test(what, (t) => play(open(t), steps));
