"""Headless Firefox, by WebDriver BiDi over its own WebSocket: geckodriver is in no package of Debian."""

import json
import os
import re
from contextlib import suppress
from itertools import count
from pathlib import Path

from harness import START_TIMEOUT
from jetbot.wait import wait_until
from processes import start
from web_client import Closed, WebSocket

from .browser_processes import BrowserProcesses, descendants
from .engine import SCREEN, WATCH, Engine

PREFERENCES = {"remote.active-protocols": 1, "datareporting.policy.dataSubmissionEnabled": False,
               "app.normandy.enabled": False, "services.settings.server": "data:,"}
CALL = """async (given) => {{ const result = await (function () {{ {script} }})(...JSON.parse(given));
    return JSON.stringify(result ?? null); }}"""


class Browser(BrowserProcesses, Engine):
    """folder: of its profile. language: the person's."""

    def __init__(self, folder: Path, language: str):
        preferences = {**PREFERENCES, "intl.accept_languages": language}
        (folder / "user.js").write_text("".join(
            f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in preferences.items()))
        self._process = start(["firefox-esr", "--headless", "--no-remote", "--profile", str(folder),
                               "--remote-debugging-port", "0"], folder / "log",
                              env={**os.environ, "HOME": str(folder), "MOZ_CRASHREPORTER_DISABLE": "1"})
        self._numbers = count()
        assert wait_until(self._port, START_TIMEOUT), self._process.log.read_text()
        port = int(self._port()[1])
        self._socket = WebSocket(port, {"Host": f"127.0.0.1:{port}"}, path="/session")
        self._call("session.new", capabilities={})
        self._tab = self._call("browsingContext.getTree")["contexts"][0]["context"]
        self._call("browsingContext.setViewport", context=self._tab, viewport=dict(zip(("width", "height"), SCREEN)))
        self._call("script.addPreloadScript", functionDeclaration=f"() => {{ {WATCH} }}")

    @property
    def processes(self):
        return [self._process.pid, *descendants(self._process.pid)]

    def load(self, url):
        self._call("browsingContext.navigate", context=self._tab, url=url, wait="complete")

    def reload(self):
        self._call("browsingContext.reload", context=self._tab, wait="complete")

    def run(self, script, *arguments):
        answer = self._call("script.callFunction", functionDeclaration=CALL.format(script=script), awaitPromise=True,
                            arguments=[{"type": "string", "value": json.dumps(arguments)}],
                            target={"context": self._tab})
        assert answer["type"] == "success", answer
        return json.loads(answer["result"]["value"])

    def perform(self, source):
        self._call("input.performActions", context=self._tab, actions=[source])

    def hide(self):
        self.run("dispatchEvent(new Event('blur'))")  # a window without a screen has no focus that it could lose
        self._front = self._call("browsingContext.create", type="tab")["context"]

    def show(self):
        self._call("browsingContext.close", context=self._front)

    def close(self):
        with self.all_killed():
            with suppress(OSError, Closed):  # it was killed
                self._call("browser.close")
        self._process.wait()

    def _port(self):
        return re.search(r"listening on ws://127.0.0.1:(\d+)", self._process.log.read_text())

    def _call(self, method, **parameters):
        number = next(self._numbers)
        self._socket.send({"id": number, "method": method, "params": parameters})
        answer = self._socket.receive_until(lambda message: message.get("id") == number)
        assert answer["type"] == "success", answer
        return answer["result"]
