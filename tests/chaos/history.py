"""What happens in a scene, as JSON lines: each has its monotonic time ``at`` in s, the name of the ``event``, details.

scene: robots, and the speeds by which the wheels tell who commands; round: a new one begins; command: a program starts
to command a robot; published: the master lists it; fault, over: a fault begins, ends; press, release: of the emergency
stop, at what is pressed; pressed, released: who has confirmed; terminal: what it has answered; pupil: tried to release
it; judge: was asked for; saved, kept: the version of a program; late: for how many s this computer was busy; problem:
what else must not be; seen: a robot, whenever something has changed.
"""

import json
import threading
import time
from pathlib import Path
from typing import Dict, List

from world import COMMANDERS, Scene

INTERVAL = 0.03  # s
LATE = 0.15      # s between two looks, from which on this computer counts as busy


class History:
    """The events of a scene, which are also written into this file."""

    def __init__(self, file: Path):
        self.events: List[dict] = []
        self._file, self._lock = file.open("w", buffering=1), threading.Lock()

    def add(self, event: str, **details: object) -> None:
        with self._lock:
            self.events.append({"at": round(time.monotonic(), 3), "event": event, **details})
            print(json.dumps(self.events[-1]), file=self._file)


class Observer(threading.Thread):
    """Sees the robots of a scene until it is ended. ``seen``: what it saw last, by robot."""

    def __init__(self, scene: Scene, history: History):
        super().__init__(daemon=True)
        self._scene, self._history, self._ended = scene, history, threading.Event()
        self.seen: Dict[str, dict] = {}

    def run(self) -> None:
        looked_at = time.monotonic()
        while not self._ended.wait(INTERVAL):
            before, looked_at = looked_at, time.monotonic()
            if looked_at - before > LATE:
                self._history.add("late", by=round(looked_at - before - LATE, 3))
            for robot in self._scene.names:
                seen = look(self._scene, robot)
                if seen != self.seen.get(robot):
                    self.seen[robot] = seen
                    self._history.add("seen", **seen)

    def end(self) -> None:
        self._ended.set()
        self.join()


def look(scene: Scene, robot: str) -> dict:
    """Return how a robot's wheels turn, its status, and the ids of the processes that run; frozen ones do not."""
    found = {kind: scene.find(kind, robot) for kind in ("controller", "guard", "launch", "master", "cockpit")}
    running = {kind: process.pid for kind, process in found.items() if process and process.runs()}
    if not found["master"] and scene.substitute_master():
        running["master"] = 0
    commanders = {each.kind: each.pid for each in scene.living(*COMMANDERS) if each.robot == robot and each.runs() and (
        each.kind != "page" or "cockpit" in running and scene.link.passes)}
    return {"robot": robot, "wheels": [round(speed, 3) for speed in scene.wheels(robot)], "running": running,
            "controller": found["controller"].pid if found["controller"] else 0, "commanders": commanders,
            "status": scene.status(robot)}
