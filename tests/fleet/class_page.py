"""A page of a hub or of a robot, by docs/protocol.md."""

import time

from network import Host

import web_client
from jetbot.wait import wait_until
from jetbot_ros.contract import COCKPIT_PORT

SILENCE_TIMEOUT = 3.0          # s
RETRY_INTERVAL = (0.75, 2.25)  # s
SPEEDS = [0.30 + 0.02 * step for step in range(16)]  # one after the other, so that the wheels tell which command it is


class Page(web_client.Page):
    """A page on this host. address: where it is served; cookie: of a pupil, or "" for this computer's own browser."""

    def __init__(self, host: Host, address: str = "", cookie: str = ""):
        headers = web_client.page_headers(COCKPIT_PORT, address or "localhost", cookie)
        super().__init__(lambda: host.call(lambda: web_client.WebSocket(
            COCKPIT_PORT, headers, "", address or "127.0.0.1", timeout=SILENCE_TIMEOUT)), SPEEDS, RETRY_INTERVAL)

    def robot(self, name: str) -> dict:
        """Return the state of a robot, {} without a connection."""
        return self.state.get("robots", {}).get(f"/{name}", {})

    def wait(self, condition, within: float, what: str) -> float:
        """Wait until the condition is true; return the s that it took. Raise AssertionError."""
        start = time.monotonic()
        assert wait_until(condition, within), f"waited {within} s for {what}; {self.said[-3:]}; state {self.state}"
        return time.monotonic() - start
