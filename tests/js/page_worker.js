// Browsers' workers, played by Node's: so engine.js and worker.js run as they are.

import { readFile } from "node:fs/promises";
import { Worker as Thread } from "node:worker_threads";

const BOOT = `
import { parentPort, workerData } from "node:worker_threads";
globalThis.postMessage = (message) => parentPort.postMessage(message);
globalThis.addEventListener = (type, listener) => parentPort.once(type, (data) => listener({ data }));
await import(workerData);
`;

class Worker {
  constructor(url) {
    this.thread = new Thread(new URL(`data:text/javascript,${encodeURIComponent(BOOT)}`), { workerData: url.href });
    this.thread.on("message", (data) => this.onmessage({ data }));
    this.thread.on("error", (error) => this.onerror(error));
  }

  postMessage(message) {
    this.thread.postMessage(message);
  }

  terminate() {
    this.thread.terminate();
  }
}

async function fetch(url) {
  return new Response(await readFile(url));
}

Object.assign(globalThis, { Worker, fetch });
