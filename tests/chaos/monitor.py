"""What must hold at every moment: who may turn the wheels, and for how long when that ends."""

import threading
import time
from typing import Callable, Dict, NamedTuple, Optional, Tuple

from world import SPEEDS, Process, Scene

SLACK = 0.7     # s of this computer's, whose processes compete
INTERVAL = 0.03  # s


def obeyed(scene: Scene, robot: str) -> Optional[Process]:
    """Return the running program whose speed the wheels have; a page runs if its cockpit does."""
    left, right = scene.wheels(robot)
    return next((each for each in scene.living(*SPEEDS) if each.robot == robot and each.runs()
                 and (each.kind != "page" or runs(scene, "cockpit", robot))
                 and abs(SPEEDS[each.kind] - left) < 0.02 and abs(left - right) < 0.02), None)


def runs(scene: Scene, kind: str, robot: str) -> bool:
    process = scene.find(kind, robot)
    return bool(process and process.runs())


class Need(NamedTuple):
    """The wheels turn at most this long, in s, while this does not hold: README's and docs/safety.md's bound."""

    seconds: float
    holds: Callable[[Scene, str], object]


NEEDS = {
    "a program that runs and commands this": Need(1.5, obeyed),  # 1.2; the guard's if the controller hangs as well
    "a controller": Need(0.3, lambda scene, robot: scene.find("controller", robot)),
    "a controller that runs": Need(1.5, lambda scene, robot: runs(scene, "controller", robot)),
    "a guard that runs": Need(1.0, lambda scene, robot: runs(scene, "guard", robot)),
    "a roslaunch that runs": Need(0.5, lambda scene, robot: runs(scene, "launch", robot)),
    "a master that runs": Need(3.0, lambda scene, robot: runs(scene, "master", robot) or (
        not scene.find("master", robot) and scene.substitute_master())),
}


class Monitor(threading.Thread):
    """Watches all wheels until it is ended. ``violation``: the first thing seen that must not be."""

    def __init__(self, scene: Scene):
        super().__init__(daemon=True)
        self._scene, self._ended = scene, threading.Event()
        self._since: Dict[Tuple[str, str], float] = {}  # when a robot's need was met last, or its wheels stood
        self.held: Dict[str, int] = {}    # the controllers that have confirmed a stop, by robot
        self.stood: Dict[str, float] = {}  # when the wheels of a robot stood last
        self.violation = ""

    def run(self) -> None:
        while not self._ended.wait(INTERVAL):
            for robot in self._scene.names:
                self.violation = self.violation or self._seen(robot, time.monotonic())

    def end(self) -> None:
        self._ended.set()
        self.join()

    def check(self) -> None:
        """Raise AssertionError for the violation that was seen."""
        assert not self.violation, self.violation

    def _seen(self, robot, now) -> str:
        """Return what is wrong with a robot now, or ""."""
        wheels = self._scene.wheels(robot)
        turning = wheels != (0.0, 0.0)
        if not turning:
            self.stood[robot] = now
        controller = self._scene.find("controller", robot)
        if turning and controller and self.held.get(robot) == controller.pid:
            return f"{robot} drives at {wheels} under an emergency stop that it has confirmed"
        for name, need in NEEDS.items():
            if not turning or need.holds(self._scene, robot):
                self._since[robot, name] = now
            since = now - self._since.setdefault((robot, name), now)
            if since > need.seconds + SLACK:
                return f"{robot} drives at {wheels} for {since:.1f} s without {name}"
        return ""
