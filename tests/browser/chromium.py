"""Headless Chromium as a phone: its screen, fingers, keys and tabs, and the signals that its processes get."""

import json
import os
import shutil
import signal
from contextlib import suppress
from pathlib import Path
from typing import List, NamedTuple, Tuple

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver import ActionChains
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.keys import Keys

from jetbot.wait import wait_until
from processes import end_with_parent

from .world import LONGEST_GAP, NAME

# chromedriver's own switches, without which a hidden tab is slowed down as it is for everybody
EXCLUDED = ["disable-background-timer-throttling", "disable-renderer-backgrounding",
            "disable-backgrounding-occluded-windows"]
KEYS = {"ArrowUp": Keys.ARROW_UP, "ArrowDown": Keys.ARROW_DOWN, "ArrowLeft": Keys.ARROW_LEFT,
        "ArrowRight": Keys.ARROW_RIGHT, "Space": Keys.SPACE, "Escape": Keys.ESCAPE, "Tab": Keys.TAB,
        "Enter": Keys.ENTER, "Home": Keys.HOME}
CAUSED_BY_TESTS = ("/favicon.ico", "willReadFrequently",  # a picture in a tab of its own; the map's pixels
                   "insecure connection")                 # a file that is saved from a page without https
END_TIMEOUT = 20.0  # s
# Keeps the socket, and for other pages of this origin the newest commands that the page sends, and when it paused.
KEEP_SENT = f"""if (location.protocol === "http:") {{ let turn = performance.now();
    setInterval(() => {{
        const now = performance.now();
        if (now - turn > {1000 * LONGEST_GAP}) localStorage.setItem("paused", (performance.timeOrigin + now) / 1000);
        turn = now;
    }}, 20); }}""" + """
if (location.protocol === "http:") { const send = WebSocket.prototype.send, sent = [];
    WebSocket.prototype.send = function (text) {
        window.socket = this;
        const {type, forward, left} = JSON.parse(text);
        if (type === "drive") {
            sent.push([(performance.timeOrigin + performance.now()) / 1000, forward, left]);
            localStorage.setItem("sent", JSON.stringify(sent.slice(-100)));
        }
        send.call(this, text);
    }; }"""


class Command(NamedTuple):
    """What a page sent. time: in s since the epoch; forward, left: deflections."""

    time: float
    forward: float
    left: float

    @property
    def is_zero(self) -> bool:
        return self.forward == self.left == 0


class Chromium:
    """profile: a folder of its own. downloads: the folder with what the page's person saves."""

    def __init__(self, profile: Path):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for argument in ("headless=new", f"user-data-dir={profile}", f"host-resolver-rules=MAP {NAME} 127.0.0.1",
                         "remote-debugging-pipe",  # the browser ends with chromedriver
                         *["no-sandbox"] * (os.geteuid() == 0)):
            options.add_argument(f"--{argument}")
        options.add_experimental_option("excludeSwitches", EXCLUDED)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = Service(shutil.which("chromedriver"), popen_kw={"preexec_fn": end_with_parent})
        self.downloads = profile / "downloads"
        options.add_experimental_option("prefs", {"download.default_directory": str(self.downloads)})
        self.driver = webdriver.Chrome(service=service, options=options)
        self._watch_tab()
        self._driver_process, self._service = service.process.pid, service

    def screen(self, width: int, height: int, touch: bool = True, scale: float = 1.0) -> None:
        """Make the tab in front a phone's touch screen of this size in px, or a desktop's; scale: pixels per px."""
        self._devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale,
                       mobile=touch)
        self._devtools("Emulation.setTouchEmulationEnabled", enabled=touch, maxTouchPoints=5)

    def run(self, script: str, *arguments):
        """Run JavaScript in the page with these arguments, and return what it returns."""
        return self.driver.execute_script(script, *arguments)

    def touch_event(self, kind: str, *points: Tuple[float, float]) -> None:
        """Send touchStart, touchMove, touchEnd or touchCancel, with the fingers that touch at these (x, y) in px."""
        self._devtools("Input.dispatchTouchEvent", type=kind,
                       touchPoints=[{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)])

    def media(self, **features: str) -> None:
        """Let the page believe that a person prefers this: prefers_color_scheme="dark"."""
        self._devtools("Emulation.setEmulatedMedia", features=[
            {"name": name.replace("_", "-"), "value": value} for name, value in features.items()])

    def press(self, key: str) -> None:
        """Press a key, and hold it."""
        ActionChains(self.driver, duration=0).key_down(KEYS.get(key, key)).perform()

    def let_go(self, key: str) -> None:
        """Let a key go."""
        ActionChains(self.driver, duration=0).key_up(KEYS.get(key, key)).perform()

    def tap(self, key: str) -> None:
        """Press a key, and let it go."""
        self.press(key)
        self.let_go(key)

    def sent(self) -> List[Command]:
        """Return the newest commands that the page in the first tab sent; the tab in front may show another page."""
        return [Command(*each) for each in json.loads(self.run("return localStorage.getItem('sent')") or "[]")]

    def paused_at(self) -> float:
        """Return when a page of this origin last had no turn for LONGEST_GAP, in s since the epoch."""
        return float(self.run("return localStorage.getItem('paused')") or 0)

    def new_tab(self, url: str = "about:blank") -> None:
        """Open a tab in front of the page."""
        self.driver.switch_to.new_window("tab")
        self._watch_tab()
        self.driver.get(url)

    def show_tab(self, number: int) -> None:
        """Show the tab with this number, from 0 on, in front of the others."""
        self.driver.switch_to.window(self.driver.window_handles[number])
        self._devtools("Page.bringToFront")

    def old_tab(self) -> None:
        """Close the tab in front; the page is visible again."""
        self.driver.close()
        self.show_tab(0)

    def close_other_tabs(self) -> None:
        """Close all tabs but the first one."""
        first, *others = self.driver.window_handles
        for other in others:
            self.driver.switch_to.window(other)
            self.driver.close()
        self.driver.switch_to.window(first)

    def errors(self) -> List[str]:
        """Return what the console has logged since the last call: errors and warnings, violations of the CSP too."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] != "INFO" and not any(each in entry["message"] for each in CAUSED_BY_TESTS)]

    @property
    def runs(self) -> bool:
        """Return whether the browser was not killed."""
        return any(map(is_running, descendants(self._driver_process)))

    def signal(self, signum: int) -> None:
        """Send a signal to all processes of the browser, not to chromedriver."""
        for pid in descendants(self._driver_process):
            with suppress(ProcessLookupError):
                os.kill(pid, signum)

    def close(self) -> None:
        """End the browser and all its processes."""
        processes = descendants(self._driver_process)
        with suppress(WebDriverException, OSError):  # it was killed
            self.driver.quit()
        self._service.stop()
        for pid in processes:
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        assert wait_until(lambda: not any(map(is_running, processes)), END_TIMEOUT), "Chromium does not end"

    def _watch_tab(self):
        self._devtools("Page.addScriptToEvaluateOnNewDocument", source=KEEP_SENT)

    def _devtools(self, command, **parameters):
        return self.driver.execute_cdp_cmd(command, parameters)


def descendants(pid: int) -> List[int]:
    """Return the ids of the processes that a process has started, and of those that these have."""
    children = []
    for file in Path(f"/proc/{pid}/task").glob("*/children"):
        with suppress(OSError):  # it has just ended
            children += map(int, file.read_text().split())
    return [each for child in children for each in [child, *descendants(child)]]


def is_running(pid: int) -> bool:
    """Return whether a process runs; a zombie does not."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False
