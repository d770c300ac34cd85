"""Headless Chromium as a phone: its screen, fingers, keys and tabs, and the signals that its processes get."""

import os
import shutil
from contextlib import suppress
from pathlib import Path
from typing import List, Tuple

from selenium import webdriver
from selenium.common.exceptions import InvalidArgumentException, WebDriverException
from selenium.webdriver import ActionChains
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.keys import Keys

from processes import end_with_parent

from .browser_processes import BrowserProcesses
from .cockpit_page import KEEP_SENT
from .webdriver import ByWebDriver
from .world import NAME

# chromedriver's own switches, without which a hidden tab is slowed down as it is for everybody
EXCLUDED = ["disable-background-timer-throttling", "disable-renderer-backgrounding",
            "disable-backgrounding-occluded-windows"]
KEYS = {"ArrowUp": Keys.ARROW_UP, "ArrowDown": Keys.ARROW_DOWN, "ArrowLeft": Keys.ARROW_LEFT,
        "ArrowRight": Keys.ARROW_RIGHT, "Space": Keys.SPACE, "Escape": Keys.ESCAPE, "Tab": Keys.TAB,
        "Enter": Keys.ENTER, "Home": Keys.HOME, "Delete": Keys.DELETE,
        "Control": Keys.CONTROL}
CAUSED_BY_TESTS = ("/favicon.ico", "willReadFrequently",  # a picture in a tab of its own; the map's pixels
                   "insecure connection")                 # a file that is saved from a page without https


class Chromium(ByWebDriver, BrowserProcesses):
    """profile: a folder of its own. language: the person's. downloads: the folder with what the page's person saves."""

    def __init__(self, profile: Path, language: str = "en-US"):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for argument in ("headless=new", f"user-data-dir={profile}", f"host-resolver-rules=MAP {NAME} 127.0.0.1",
                         f"accept-lang={language}", "remote-debugging-pipe",  # the browser ends with chromedriver
                         *["no-sandbox"] * (os.geteuid() == 0)):
            options.add_argument(f"--{argument}")
        options.add_experimental_option("excludeSwitches", EXCLUDED)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = Service(shutil.which("chromedriver"), popen_kw={"preexec_fn": end_with_parent})
        self.downloads = profile / "downloads"
        options.add_experimental_option("prefs", {"download.default_directory": str(self.downloads)})
        self.driver = webdriver.Chrome(service=service, options=options)
        self._watch_tab()
        self._parent, self._service = service.process.pid, service

    def screen(self, width: int, height: int, touch: bool = True, scale: float = 1.0) -> None:
        """Make the tab in front a phone's touch screen of this size in px, or a desktop's; scale: pixels per px."""
        self._devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale,
                       mobile=touch)
        self._devtools("Emulation.setTouchEmulationEnabled", enabled=touch, maxTouchPoints=5)

    def touch_event(self, kind: str, *points: Tuple[float, float]) -> None:
        """Send touchStart, touchMove, touchEnd or touchCancel, with the fingers that touch at these (x, y) in px."""
        self._devtools("Input.dispatchTouchEvent", type=kind,
                       touchPoints=[{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)])

    def lift(self) -> None:
        """Lift all fingers, if any touches."""
        with suppress(InvalidArgumentException):
            self.touch_event("touchEnd")

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

    def compose(self, text: str) -> None:
        """Type a text that an input method has not yet converted."""
        self._devtools("Input.imeSetComposition", text=text, selectionStart=len(text), selectionEnd=len(text))

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

    def close(self) -> None:
        """End the browser and all its processes."""
        with self.all_killed():
            with suppress(WebDriverException, OSError):  # it was killed
                self.driver.quit()
            self._service.stop()

    def _watch_tab(self):
        self._devtools("Page.addScriptToEvaluateOnNewDocument", source=KEEP_SENT)

    def _devtools(self, command, **parameters):
        return self.driver.execute_cdp_cmd(command, parameters)
