// The sockets that the page opens to a cockpit that a test plays.

export class FakeSocket {
  static OPEN = 1;
  static CLOSED = 3;
  static all = []; // in their order
  readyState = 0;
  bufferedAmount = 0;
  sent = []; // messages

  constructor(url) {
    this.url = url;
    FakeSocket.all.push(this);
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
    this.readyState = FakeSocket.CLOSED;
    this.onclose({ code, reason });
  }
}

globalThis.WebSocket = FakeSocket;
