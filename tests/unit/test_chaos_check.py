"""What the chaos test reads from a history, without a process: each invariant sees what violates it.

That it sees nothing where nothing is violated, is shown by each round of chaos in CI.
"""

import sys
from pathlib import Path

import pytest

CHAOS = Path(__file__).parents[1] / "chaos"
sys.path.append(str(CHAOS))
import check  # noqa: E402

RUNNING = {"controller": 1, "guard": 2, "launch": 3, "master": 4}


class Story:
    """A history of one robot, red, by what happens after how many seconds."""

    def __init__(self):
        self.events, self._last = [], {"wheels": [0.0, 0.0], "running": RUNNING, "controller": 1, "commanders": {},
                                       "status": ""}
        self.add(0, "scene", robots=["red"], gentle=[], speeds={"order": 0.2, "page": 0.5})

    def add(self, at, event, **details):
        self.events.append({"at": float(at), "event": event, **details})
        return self

    def see(self, at, speed, **changes):
        """red was seen to turn its wheels at this speed; what does not change stays as it was."""
        self._last = {**self._last, "wheels": [speed, speed], **changes}
        return self.add(at, "seen", robot="red", **self._last)

    def violations(self):
        return [text for _, text in check.violations(self.events)]


def story():
    return Story().see(0.1, 0.0)


def stopped(at, confirmed=("red",)):
    return (story().see(1, 0.2, commanders={"order": 9}).add(at - 1, "press", way="page").see(at, 0.0)
            .add(at + 0.1, "pressed", way="page", confirmed=list(confirmed), serving=["red"]))


VIOLATED = {
    "drives without a program": (
        story().see(1, 0.5, commanders={"page": 7}).see(2, 0.5, commanders={}).see(5, 0.0),
        "red drives at [0.5, 0.5] for more than 2.2 s without a program that runs and commands this"),
    "drives at another speed than commanded": (
        story().see(1, 0.4, commanders={"page": 7}).see(5, 0.0),
        "red drives at [0.4, 0.4] for more than 2.2 s without a program that runs and commands this"),
    "drives longer than this computer was busy": (
        story().see(1, 0.5, commanders={"page": 7}).see(2, 0.5, commanders={}).add(3, "late", by=0.5).see(5, 0.0),
        "red drives at [0.5, 0.5] for more than 2.2 s without a program that runs and commands this"),
    "drives long after its bus can be trusted again": (
        story().add(1, "fault", number=1, target="controller", robot="red", harms=True).see(1.1, 0.9)
        .add(2, "over", number=1).see(2.1, 0.9).see(9, 0.0).see(20, 0.0),
        "red drives at [0.9, 0.9] for more than 2.2 s without a program that runs and commands this"),
    "drives without a guard that nothing has hit": (
        story().see(1, 0.2, commanders={"order": 9})
        .add(2, "fault", number=1, target="launch", robot="red", harms=False)
        .see(2.5, 0.2, running={"launch": 3, "master": 4}).see(8, 0.0, running=RUNNING).see(9, 0.0),
        "red drives at [0.2, 0.2] for more than 1.9 s without a guard that runs"),
    "drives without a master": (
        story().see(1, 0.5, commanders={"page": 7}, running={**RUNNING, "master": 0}).see(
            2, 0.5, running={"controller": 1, "guard": 2, "launch": 3}).see(6, 0.0),
        "red drives at [0.5, 0.5] for more than 3.7 s without a master that runs"),
    "does not stop": (
        story().see(1, 0.2, commanders={"order": 9}).add(2, "press", way="page").add(
            3, "pressed", way="page", confirmed=[], serving=[]).see(7, 0.0),
        "red does not stop by page; confirmed: []"),
    "drives again under a stop": (
        stopped(3).see(4, 0.2).see(4.5, 0.0),
        "red drives at [0.2, 0.2] under an emergency stop that it has confirmed"),
    "is deaf": (stopped(3, confirmed=()).see(13, 0.0), "red does not hear a stop by page"),
    "does not confirm the release": (
        stopped(3).add(4, "release", way="page").add(5, "released", way="page", confirmed=[]),
        "only [] confirm the release by page"),
    "does not obey": (
        story().add(1, "must obey", kind="page", robot="red").see(2, 0.0, commanders={"page": 7}).see(17, 0.0),
        "page red: not obeyed for 6.0 s after its start"),
    "does not hear of a new program": (
        story().see(0.5, 0.0, commanders={"order": 7}).add(1, "published", kind="order", robot="red").see(4, 0.2),
        "order red: not obeyed for 2.2 s after the master knows it"),
    "obeys an old order": (
        story().see(1, 0.2, commanders={"order": 9}).see(2, 0.0, controller=0).see(3, 0.2, controller=11),
        "red, restarted, obeys an order from before"),
    "forgets a program": (story().add(1, "saved", version=3).add(2, "kept", version=2),
                          "version 3 of a program was saved, and 2 is kept"),
    "leaves something": (story().add(1, "problem", text="left: a file"), "left: a file"),
}


@pytest.mark.parametrize("name", VIOLATED)
def test_each_invariant_sees_what_violates_it(name):
    history, sentence = VIOLATED[name]
    assert sentence in history.violations()
