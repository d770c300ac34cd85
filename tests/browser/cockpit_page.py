"""The cockpit's page in a browser of any engine: what it shows, what it sends, and its pad."""

import json
import re
import time
from abc import ABC, abstractmethod
from typing import Callable, Dict, List, NamedTuple, Tuple

from languages import read

from jetbot.wait import wait_until

from .world import LONGEST_GAP, TRIES

TRY_AGAIN = 1.0  # s, as a person needs; the cockpit's publisher has ended by then, and connects anew
STARVED = re.compile("was interrupted, so the robot stopped|did not get ready in time")  # by a busy computer
PAGE_TIMEOUT = 20.0  # s for what a page shows; other tests may run meanwhile
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


class CockpitPage(ABC):
    """A page of a cockpit. A control is named by its id, other elements by a CSS selector."""

    @abstractmethod
    def run(self, script: str, *arguments):
        """Run JavaScript in the page with these arguments, and return what it returns."""

    @abstractmethod
    def errors(self) -> List[str]:
        """Return what the console has logged since the last call: errors and warnings, violations of the CSP too."""

    @abstractmethod
    def click(self, selector: str) -> None:
        """Click on an element, as soon as it is shown."""

    @abstractmethod
    def touch_event(self, kind: str, *points: Tuple[float, float]) -> None:
        """Send touchStart, touchMove or touchEnd, with the fingers that touch at these (x, y) in px."""

    def wait_for_link(self) -> None:
        """Wait until the page knows the round trip to the cockpit, and shows a status."""
        self.wait_for(lambda: "ms" in self.text("link") and self.text("status"), "the page to connect")

    def choose(self, robot: str) -> None:
        """Choose a robot by its name."""
        self.wait_for(lambda: f"/{robot}" in self.robots(), f"{robot} in the list")
        self.set("robot", f"/{robot}")

    def robots(self) -> Dict[str, str]:
        """Return the robots that can be chosen: {id: label}."""
        return dict(self.run("return [...document.querySelectorAll('#robot option')]"
                             ".map(option => [option.value, option.textContent])"))

    def value(self, name: str) -> str:
        """Return the value of a control."""
        return self.run(f"return document.getElementById('{name}').value")

    def text(self, name: str) -> str:
        """Return the visible text of the element with this id."""
        return self.text_of(f"#{name}")

    def text_of(self, selector: str) -> str:
        """Return the visible text of an element."""
        return self.run("const found = document.querySelector(arguments[0]);"
                        "return found?.checkVisibility() ? found.innerText.trim() : ''", selector)

    def has(self, selector: str) -> bool:
        """Return whether such an element exists."""
        return self.run("return document.querySelector(arguments[0]) !== null", selector)

    def wait_for(self, condition: Callable[[], object], what: str, within: float = PAGE_TIMEOUT) -> None:
        """Fail unless the condition becomes true within this many seconds; what: its description."""
        assert wait_until(condition, within, 0.1), \
            f"waited {within} s for {what}; the page shows {self.text_of('body')!r}, its console {self.errors()}"

    def wait_for_text(self, name: str, text: str) -> None:
        """Fail unless the element with this id soon shows this text; run a program again that was starved meanwhile."""
        tries = iter(range(TRIES))

        def is_shown():
            if text.lower() in self.text(name).lower():
                return True
            if name in ("outcome", "prints") and self.is_starved() and next(tries, None) is not None:
                time.sleep(TRY_AGAIN)
                self.run("document.getElementById('run').click()")
            return False
        self.wait_for(is_shown, f"{text!r} in #{name}")

    def start_program(self, button: str = "run") -> None:
        """Press Run, or Step, and wait until the program has begun: Python may have to be loaded first."""
        self.click(f"#{button}")
        self.wait_for(lambda: self.text("outcome") != self.say("Starting"), "the program to begin")

    def is_starved(self) -> bool:
        """Return whether the page's program has ended because the computer is too busy for it."""
        return bool(STARVED.search(self.text("outcome")))

    def say(self, english: str) -> str:
        """Return a sentence of the page in the page's language."""
        language = self.run("return document.documentElement.lang")
        return english if language == "en" else read(language)[english]

    def send(self, message: dict) -> None:
        """Let the page send this message to the cockpit."""
        self.run("socket.send(JSON.stringify(arguments[0]))", message)

    def touch(self, forward: float = 1.0, left: float = 0.0) -> None:
        """Put a finger on the middle of the pad, and move it; 1 is the edge."""
        self.lift()
        self.touch_event("touchStart", self.on_pad(0, 0))
        self.move(forward, left)

    def move(self, forward: float, left: float) -> None:
        """Move the finger on the pad."""
        self.touch_event("touchMove", self.on_pad(forward, left))

    def lift(self) -> None:
        """Lift all fingers."""
        self.touch_event("touchEnd")

    def on_pad(self, forward: float, left: float) -> Tuple[float, float]:
        """Return a place on the pad as (x, y) in px."""
        (x, y), radius = self.place_of("#pad"), self.run("return document.getElementById('pad').clientWidth / 2")
        return x - left * radius, y - forward * radius

    def place_of(self, selector: str) -> Tuple[float, float]:
        """Return the middle of an element as (x, y) in px."""
        return tuple(self.run("const box = document.querySelector(arguments[0]).getBoundingClientRect();"
                              "return [box.x + box.width / 2, box.y + box.height / 2]", selector))

    def set(self, name: str, value: str) -> None:
        """Give a control this value, as a person does, but without giving it the focus."""
        self.run(f"const control = document.getElementById('{name}'); control.value = '{value}';"
                 "for (const type of ['input', 'change']) control.dispatchEvent(new Event(type, {bubbles: true}))")

    def sent(self) -> List[Command]:
        """Return the newest commands that the page in the first tab sent; the tab in front may show another page."""
        return [Command(*each) for each in json.loads(self.run("return localStorage.getItem('sent')") or "[]")]

    def paused_at(self) -> float:
        """Return when a page of this origin last had no turn for LONGEST_GAP, in s since the epoch."""
        return float(self.run("return localStorage.getItem('paused')") or 0)
