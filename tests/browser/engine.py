"""A browser of any engine, as what the engines have in common: the pointers and keys of WebDriver's actions."""

from abc import abstractmethod
from typing import List, Tuple

from .cockpit_page import KEEP_SENT, CockpitPage

KEYS = {"ArrowUp": "\ue013", "ArrowDown": "\ue015", "ArrowLeft": "\ue012", "ArrowRight": "\ue014",  # by the standard
        "Space": " ", "Escape": "\ue00c", "Enter": "\ue007", "Delete": "\ue017", "Control": "\ue009", "Tab": "\ue004",
        "Shift": "\ue008", "End": "\ue010", "Home": "\ue011"}
KEEP_ERRORS = """window.errors = [];
for (const kind of ["error", "warn"]) {
    const log = console[kind];
    console[kind] = (...texts) => { errors.push(texts.join(" ")); log(...texts); };
}
addEventListener("error", ({message, target}) => errors.push(message ?? `not loaded: ${target.outerHTML}`), true);
addEventListener("unhandledrejection", ({reason}) => errors.push(String(reason)));
addEventListener("securitypolicyviolation", ({blockedURI}) => errors.push(`refused: ${blockedURI}`));
"""
HOLD_BACK = """for (const event of ["blur", "pagehide", "pointercancel", "lostpointercapture"]) {
    addEventListener(event, (each) => window.only && event !== only && each.stopImmediatePropagation(), true);
}"""
NOTICE_ONLY = """window.only = arguments[0];
if (only !== "visibilitychange") Object.defineProperty(document, "hidden", { value: false });"""
WATCH = KEEP_SENT + KEEP_ERRORS + HOLD_BACK
SCREEN = (1024, 768)  # px


class Engine(CockpitPage):
    """A browser whose page a person uses with a mouse, a finger and a keyboard."""

    @abstractmethod
    def load(self, url: str) -> None:
        """Show this page in the only tab."""

    @abstractmethod
    def reload(self) -> None:
        """Load the page again."""

    @abstractmethod
    def perform(self, source: dict) -> None:
        """Let a source of input do its actions, in WebDriver's form."""

    @abstractmethod
    def hide(self) -> None:
        """Hide the page."""

    @abstractmethod
    def show(self) -> None:
        """Show the page again that was hidden."""

    def open(self, url: str, robot: str = "") -> None:
        """Open the page, wait until it is connected, and choose a robot."""
        self.load(url)
        self.wait_for_link()
        if not self.has("#name"):  # seen in Firefox on a busy computer: another document comes over it
            self.load(url)
            self.wait_for_link()
        self.set("name", "Somebody")  # is sent: from then on, the page's socket is known
        if robot:
            self.choose(robot)

    def leave(self) -> None:
        """Lift all that is held, and show another page."""
        self.let_go_mouse()
        self.lift()
        self.load("about:blank")

    def notice_only(self, event: str) -> None:
        """Let the page notice by this event alone that it is left: engines send several, not all the same."""
        self.run(NOTICE_ONLY, event)

    def errors(self) -> List[str]:
        """Return what the console has logged since the last call: errors and warnings, violations of the CSP too."""
        return self.run("return errors.splice(0)")

    def press(self, key: str) -> None:
        """Press a key, and hold it."""
        self._type(("keyDown", key))

    def let_go(self, key: str) -> None:
        """Let a key go."""
        self._type(("keyUp", key))

    def tap(self, key: str) -> None:
        """Press a key, and let it go."""
        self._type(*stroke(key))

    def type(self, name: str, text: str) -> None:
        """Replace what is in a text field, and press Enter."""
        self.click(f"#{name}")
        self._type(("keyDown", "Control"), *stroke("a"), ("keyUp", "Control"),
                   *(each for key in ("Delete", *text, "Enter") for each in stroke(key)))

    def click(self, selector: str) -> None:
        """Click on an element, as soon as it is shown."""
        self.wait_for(lambda: self.run("return document.querySelector(arguments[0])?.checkVisibility()", selector),
                      f"{selector} to be shown")
        self.run("document.querySelector(arguments[0]).scrollIntoView({block: 'nearest'})", selector)
        self._point("mouse", move_to(self.place_of(selector)), DOWN, UP)

    def hold_mouse(self, forward: float = 1.0, left: float = 0.0) -> None:
        """Press the mouse on the middle of the pad, and move it; 1 is the edge."""
        self.let_go_mouse()
        self._point("mouse", move_to(self.on_pad(0, 0)), DOWN, move_to(self.on_pad(forward, left)))

    def let_go_mouse(self) -> None:
        """Let the mouse's button go."""
        self._point("mouse", UP)

    def touch_event(self, kind: str, *points: Tuple[float, float]) -> None:
        """Send touchStart, touchMove or touchEnd, with the finger that touches at this (x, y) in px."""
        act = {"touchStart": [DOWN], "touchMove": [], "touchEnd": [UP]}[kind]
        self._point("touch", *map(move_to, points), *act)

    def _point(self, kind, *actions):
        self.perform({"type": "pointer", "id": kind, "parameters": {"pointerType": kind}, "actions": list(actions)})

    def _type(self, *actions):
        self.perform({"type": "key", "id": "keyboard", "actions": [
            {"type": act, "value": KEYS.get(key, key)} for act, key in actions]})


DOWN, UP = {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}


def stroke(key: str) -> Tuple[Tuple[str, str], ...]:
    """Return the actions that press a key and let it go."""
    return ("keyDown", key), ("keyUp", key)


def move_to(place: Tuple[float, float]) -> dict:
    """Return the action that moves a pointer to this (x, y) in px."""
    x, y = map(round, place)
    return {"type": "pointerMove", "x": x, "y": y, "duration": 0}
