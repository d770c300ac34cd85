"""The cockpit's page, as a person with a phone uses it."""

from pathlib import Path
from typing import List, Optional, Tuple

from selenium.webdriver import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from .chromium import KEYS, Chromium
from .cockpit_page import CockpitPage
from .messages import numbered, robot_named
from .programs import as_file
from .screens import PHONE

LOOKS = Path(__file__).with_name("looks.js").read_text()
# Cuts the page off from its cockpit: from then on it gets only what a test lets it receive, and pongs.
ALONE = """const receive = socket.onmessage; socket.onmessage = (event) =>
    event.isTrusted && !String(event.data).includes('pong') || receive(event);
window.WebSocket = class {
    static OPEN = 1;
    readyState = 1;
    bufferedAmount = 0;
    constructor() { window.socket = this; setTimeout(() => this.onopen()); }
    send(text) { text.includes('ping') && this.onmessage({data: text.replace('ping', 'pong')}); }
    close() {}
};"""


class Page(Chromium, CockpitPage):
    """Chromium with the page of a cockpit."""

    def open(self, url: str, robot: str = "") -> None:
        """Open the page on a phone, wait until it is connected, and choose a robot."""
        self.screen(*PHONE)
        self.driver.get(url)
        self.wait_for_link()
        if robot:
            self.choose(robot)

    def leave(self) -> None:
        """Show another page in the only tab, as most people like it, and lift all fingers."""
        self.media()
        self.close_other_tabs()
        self.driver.get("about:blank")
        self.lift()

    def element(self, name: str):
        """Return the element with this id."""
        return self.driver.find_element(By.ID, name)

    def open_file(self, content) -> None:
        """Open a program, or a text, from a file."""
        self.element("file").send_keys(as_file(self.downloads.parent, content))
        self.wait_for(lambda: not self.value("file"), "the file to be read")

    def receive(self, message: dict) -> None:
        """Let the page receive a message that the cockpit has not sent."""
        self.run("socket.onmessage({data: JSON.stringify(arguments[0])})", message)

    def receive_class(self, robots: int = 15, color: str = "", **state) -> None:
        """Let the page receive a class in rows of three, a metre apart, and only pongs of the cockpit any more.

        color: of all, else each has its own; state: of each robot, beside its place.
        """
        self.run(ALONE)
        ids = [f"/{name}" for name in numbered(robots)]
        self.receive({"type": "robots", "robots": [
            robot_named(robot[1:], color=color or f"#{96 + 8 * number:02x}4040") for number, robot in enumerate(ids)]})
        for robot in ids:
            self.receive({"type": "trail", "robot": robot, "points": []})  # of earlier drives
        known = {"status": "", "state": "driving", "cause": "", "holds": [], "waiting": [], "fake": False,
                 "warning": False, "answers": True, "stopped": False, "speed": [-0.24, -0.68],
                 "command": [-0.4, -0.06], "wheels": [-0.46, 0.34], "program": "", "driver": None, "resumes": None,
                 "held": None, "stalls": 0, "task": None, **state}
        self.receive({"type": "state", "emergency": False, "pupils_release": False, "unconfirmed": [], "robots": {
            robot: {"pose": [-number % 3, -(number // 3), 0], **known} for number, robot in enumerate(ids)}})

    def gamepad(self, x: float, y: float) -> None:
        """Plug in a gamepad whose left stick is held still here, and wait until the page has looked at it.

        -1 is left, and forward; the gamepad's timestamp goes on.
        """
        self.driver.execute_async_script(
            "const [x, y, looked] = arguments, pad = {index: 0, id: 'test', connected: true, mapping: 'standard',"
            "  buttons: [], get timestamp() { return performance.now(); }, axes: [x, y, 0, 0]};"
            "navigator.getGamepads = () => { looked(); return [pad, null, null, null]; };"
            "window.dispatchEvent(Object.assign(new Event('gamepadconnected'), {gamepad: pad}))", x, y)

    def unplug_gamepad(self) -> None:
        """Unplug the gamepad, wherever its stick is."""
        self.run("navigator.getGamepads = () => [null, null, null, null];"
                 "window.dispatchEvent(new Event('gamepaddisconnected'))")

    def type(self, name: str, text: str) -> None:
        """Replace what is in a text field, and press Enter."""
        everything = Keys.CONTROL + "a" + Keys.NULL
        self.element(name).send_keys(everything + Keys.DELETE + text + "\n")

    def click(self, selector: str) -> None:
        """Click on an element, as soon as it is shown."""
        element = self.driver.find_element(By.CSS_SELECTOR, selector)
        self.wait_for(element.is_displayed, f"{selector} to be shown")
        element.click()

    def download(self, button: str, name: str) -> Path:
        """Press a button; return the file of this name that arrives where the person's browser keeps downloads."""
        file = self.downloads / name
        file.unlink(missing_ok=True)
        self.click(f"#{button}")
        self.wait_for(file.exists, f"{name} to arrive")
        return file

    def tap(self, *keys: str) -> None:
        """Press keys, one after the other, and let each go."""
        chain = ActionChains(self.driver, duration=0)
        for key in keys:
            chain.key_down(KEYS.get(key, key)).key_up(KEYS.get(key, key))
        chain.perform()

    def tab(self) -> str:
        """Press the Tab key; return the id of what has the focus then."""
        self.tap("Tab")
        return self.run("return document.activeElement.id")

    def unreached(self, least: int = 12) -> List[str]:
        """Return the controls that the Tab key does not reach from here, however often it is pressed."""
        self._looks("noteFocus")
        for _ in range(4):
            self.tap(*["Tab"] * max(least, len(self._looks("unreached")) + 3))
            if not self._looks("unreached"):
                break
        return self._looks("unreached")

    def tab_to(self, name: str) -> None:
        """Give the focus to this element as the Tab key does; test_states.py shows that the key reaches it."""
        self.tap("Tab")
        self.wait_for(lambda: self.run("const control = document.getElementById(arguments[0]); control.focus();"
                                       "return document.activeElement === control", name), f"the focus on #{name}")

    def resize(self, width: int, height: int, touch: bool = True) -> None:
        """Show the page on a screen of this size in px; touch: whether it is a touch screen."""
        self.screen(width, height, touch)
        self.wait_for(lambda: self._looks("screenSize") == [width, height], "this screen")

    def fits(self, *names: str) -> bool:
        """Return whether nothing scrolls sideways, and the elements with these ids are on the screen."""
        return self.run("return document.documentElement.scrollWidth <= innerWidth") and not self.misplaced(*names)

    def misplaced(self, *names: str) -> List[str]:
        """Return the elements that are not wholly on the screen, or whose middle something else covers."""
        return self._looks("misplaced", list(names))

    def overlapping(self) -> List[str]:
        """Return the controls and texts that lie over each other, in pairs."""
        return self._looks("overlapping")

    def faults(self, least: int, absent: str) -> List[str]:
        """Return what is wrong with the page on this screen, a sentence each.

        least: px of a control; absent: a selector of the controls that such a screen does not show, or covers.
        """
        return self._looks("faults", least, absent)

    def small_controls(self, least: int) -> List[str]:
        """Return the visible controls that are smaller than this, in px."""
        return self._looks("smallControls", least)

    def robot_on_map(self) -> Optional[Tuple[float, float]]:
        """Return how large the chosen robot is on the map, and how far its middle is from the map's, in px."""
        return self._looks("robotOnMap")

    def shows_on_map(self, color: str) -> bool:
        """Return whether a pixel of the map has this colour: "#ff0000"."""
        return self._looks("showsOnMap", color)

    def cut(self, selector: str) -> List[str]:
        """Return the texts of these elements that are hidden or not shown to their ends."""
        return self._looks("cut", selector)

    def outside(self, selector: str, container: str) -> List[str]:
        """Return the texts of these elements that are not wholly in sight in their container."""
        return self._looks("outside", selector, container)

    def under_tools(self) -> List[str]:
        """Return the robots of the list whose middle on the map is missing, or below its buttons, scale or legend."""
        return self._looks("underTools")

    def contrast_of_robot(self) -> List[float]:
        """Return the contrasts of the chosen robot's colour to the bars' ground and to the map's (WCAG)."""
        return self._looks("contrastOfRobot")

    def faint_blocks(self) -> List[str]:
        """Return the texts and frames of Blockly's blocks that stand out too little (WCAG)."""
        return self._looks("faintBlocks")

    def untranslated(self, *known: str) -> List[str]:
        """Return the texts that are not in brackets, beside these words."""
        return self._looks("untranslated", list(known))

    def _looks(self, function, *arguments):
        return self.run(f"{LOOKS}\nreturn {function}(...arguments)", *arguments)
