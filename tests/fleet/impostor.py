"""Programs that are no robots and no hubs, by the handshake of jetbot_cockpit.remote, on a host of their own."""

import asyncio
import json
import threading
from typing import Optional

from network import Host
from school import CLASS
from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from jetbot_cockpit.remote.key import ROBOT, new_nonce, proof
from jetbot_ros.contract import COCKPIT_PORT

BURST, BURST_INTERVAL = 20, 0.01  # messages, s
FLOOD = json.dumps({"type": "notice", "code": "x", "arguments": {}, "text": "x" * 200, "template": "x"})


class Impostor:
    """Serves /hub as a robot does. name: the one it claims; key: what it proves with.

    then: what it sends for as long as it is let, once the hub has answered; recorded: a proof that it replays, or "".
    """

    def __init__(self, host: Host, name: str, key: str, then: Optional[str] = None, recorded: str = ""):
        self.name, self.key, self.then, self.recorded, self.proofs, self.visits = name, key, then, recorded, [], 0
        self._ended = threading.Event()
        self._sockets = host.call(bind_sockets, COCKPIT_PORT, host.address)
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True)
        self._thread.start()

    async def _serve(self):
        server = HTTPServer(Application([(r"/hub", Claim, {"impostor": self})]))
        server.add_sockets(self._sockets)
        while not self._ended.is_set():
            await asyncio.sleep(0.02)
        server.stop()
        await server.close_all_connections()

    def close(self) -> None:
        self._ended.set()
        self._thread.join()


class Claim(WebSocketHandler):
    def initialize(self, impostor):
        self.impostor = impostor
        self.challenge = {"type": "challenge", "robot": impostor.name, "class": CLASS, "nonce": new_nonce(),
                          "instance": "impostor"}

    def check_origin(self, origin):
        return True

    def open(self):
        self.impostor.visits += 1
        self.write_message(json.dumps(self.challenge))

    async def on_message(self, text):
        impostor, fields = self.impostor, json.loads(text)
        if fields["type"] != "answer":
            return
        own = proof(impostor.key, ROBOT, self.challenge, fields)
        impostor.proofs.append(own)
        try:
            await self.write_message(json.dumps({"type": "proof", "proof": impostor.recorded or own}))
            while impostor.then:
                for _ in range(BURST):
                    await self.write_message(impostor.then)
                await asyncio.sleep(BURST_INTERVAL)
        except WebSocketClosedError:
            pass
