"""A robot that has its key and floods its hub, on a host of its own."""

import asyncio
import json
import threading

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
    """Serves /hub as the robot with this name and key, and then sends a message for as long as it is let."""

    def __init__(self, host: Host, name: str, key: str, message: str):
        self._ended = threading.Event()
        self._routes = [(r"/hub", Claim, {"name": name, "key": key, "message": message})]
        self._sockets = host.call(bind_sockets, COCKPIT_PORT, host.address)
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True)
        self._thread.start()

    async def _serve(self):
        server = HTTPServer(Application(self._routes))
        server.add_sockets(self._sockets)
        while not self._ended.is_set():
            await asyncio.sleep(0.02)
        server.stop()
        await server.close_all_connections()

    def close(self) -> None:
        self._ended.set()
        self._thread.join()


class Claim(WebSocketHandler):
    def initialize(self, name, key, message):
        self.key, self.message = key, message
        self.challenge = {"type": "challenge", "robot": name, "class": CLASS, "nonce": new_nonce(),
                          "instance": "impostor"}

    def open(self):
        self.write_message(json.dumps(self.challenge))

    async def on_message(self, text):
        fields = json.loads(text)
        if fields["type"] != "answer":
            return
        try:
            await self.write_message(json.dumps({"type": "proof", "proof": proof(
                self.key, ROBOT, self.challenge, fields)}))
            while True:
                for _ in range(BURST):
                    await self.write_message(self.message)
                await asyncio.sleep(BURST_INTERVAL)
        except WebSocketClosedError:
            pass
