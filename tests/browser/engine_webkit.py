"""WebKitGTK's MiniBrowser on a display without a screen. Its driver has no finger, and tells nothing of the console."""

import os
from contextlib import suppress
from glob import glob
from pathlib import Path

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.common.options import ArgOptions

from harness import START_TIMEOUT
from jetbot.wait import wait_until
from processes import end, free_port, start, start_display
from web_client import listens

from .browser_processes import BrowserProcesses
from .engine import WATCH, Engine
from .webdriver import ByWebDriver

BROWSER = "/usr/lib/*/webkit2gtk-4.1/MiniBrowser"
LOCALE = "/usr/lib/locale/C.utf8"
TOUCH = """const [kind, ...place] = arguments;
if (kind === "touchStart") window.touched = document.elementFromPoint(...place);
if (place.length) [window.touchX, window.touchY] = place;
const type = { touchStart: "pointerdown", touchMove: "pointermove", touchEnd: "pointerup" }[kind];
window.touched?.dispatchEvent(new PointerEvent(type, {
    pointerId: 1, pointerType: "touch", isPrimary: true, bubbles: true, cancelable: true, composed: true,
    clientX: window.touchX, clientY: window.touchY, buttons: kind === "touchEnd" ? 0 : 1 }));
if (kind === "touchEnd") window.touched = null;"""


class Browser(ByWebDriver, BrowserProcesses, Engine):
    """folder: for its files. language: the person's, as in BCP 47."""

    def __init__(self, folder: Path, language: str):
        locale = language.replace("-", "_") + ".UTF-8"  # a name suffices: WebKit reads nothing else of it
        (folder / locale).symlink_to(LOCALE)
        self._display, display = start_display(folder / "display")
        port = free_port()
        self._driver_process = start(["WebKitWebDriver", f"--port={port}"], folder / "log", env={
            **os.environ, "HOME": str(folder), "LOCPATH": str(folder), "LC_ALL": locale, "DISPLAY": display})
        assert wait_until(lambda: listens(port), START_TIMEOUT), self._driver_process.log.read_text()
        options = ArgOptions()
        options.set_capability("browserName", "MiniBrowser")
        options.set_capability("webkitgtk:browserOptions", {"binary": glob(BROWSER)[0], "args": ["--automation"]})
        self.driver = webdriver.Remote(f"http://127.0.0.1:{port}", options=options)
        self._parent = self._driver_process.pid

    def load(self, url):
        super().load(url)
        self.run(WATCH)

    def reload(self):
        super().reload()
        self.run(WATCH)

    def touch_event(self, kind, *points):
        self.run(TOUCH, kind, *(each for point in points for each in point))

    def hide(self):
        self.driver.minimize_window()
        self.wait_for(lambda: self._state() == "hidden", "the page to be hidden")

    def show(self):
        self.wait_for(lambda: self.driver.set_window_rect(0, 0) and self._state() == "visible", "the page to be shown")

    def _state(self):
        return self.run("return document.visibilityState")

    def close(self):
        with self.all_killed(), suppress(WebDriverException, OSError):  # it was killed
            self.driver.quit()
        end([self._driver_process, self._display])
