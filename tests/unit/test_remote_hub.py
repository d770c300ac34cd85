"""The hub runs on any computer, and keeps what it needs for its user alone."""

import json
import subprocess
import sys
import threading
from types import SimpleNamespace

import pytest
from remote_links import make_fleet

from conftest import PACKAGES
from jetbot.wait import wait_until
from jetbot_cockpit.remote.finding import Finder, address_of
from jetbot_cockpit.remote.fleet import Fleet
from jetbot_cockpit.remote.tables import Tables
from jetbot_cockpit.web.codes import Codes

HUB = PACKAGES / "jetbot_cockpit/scripts/hub.py"
WITHIN = 20.0  # s
MISSING = "fcntl", "pwd", "grp", "termios", "resource", "rospy", "rosgraph"  # on a laptop without ROS or POSIX
RUN_WITHOUT = f"""
import runpy, sys
for name in {MISSING}:
    sys.modules[name] = None
sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name="__main__")
"""


@pytest.fixture
def start(tmp_path):
    processes = []

    def start(*arguments):
        command = [sys.executable, "-c", RUN_WITHOUT, str(HUB), "--class", "7b", "--classes", str(tmp_path),
                   "--port", "0", *arguments]
        processes.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True))
        return processes[-1]
    yield start
    for process in processes:
        process.kill()
        process.communicate()


def read_until(process, text):
    """Return what the process prints up to a line with this text."""
    lines = []
    while text not in "".join(lines[-1:]):
        lines.append(process.stdout.readline())
        assert lines[-1], "".join(lines)
    return "".join(lines)


def test_it_runs_without_ros_and_without_what_only_posix_has_and_ends_by_a_signal(start):
    process = start()
    assert "http://localhost:" in read_until(process, "http://localhost:")
    process.terminate()
    assert process.wait(WITHIN) == 0


def test_its_code_stays_so_that_a_tablet_stays_logged_in(start, tmp_path):
    cards = []
    for _ in range(2):
        process = start("--lan")
        read_until(process, "http://localhost:")
        process.kill()
        file = tmp_path / "7b/hub_codes.json"
        assert wait_until(file.exists, WITHIN)
        assert file.stat().st_mode & 0o777 == 0o600
        cards.append(json.loads(file.read_text()))
    assert cards[0] == cards[1] and list(cards[0]) == ["teacher"]


def test_a_pupil_gets_no_code_for_the_hub(tmp_path):
    codes = Codes(make_fleet(tmp_path), [], lambda: ["school.test"], 8080, for_pupils=False)
    assert [(grant.label, grant.role) for grant in codes.grants] == [("teacher", "teacher")]


def test_a_class_that_is_made_again_is_another_one(tmp_path):
    assert make_fleet(tmp_path / "a").id != make_fleet(tmp_path / "b").id


def test_where_a_robot_has_proven_its_name_is_remembered(tmp_path):
    fleet = make_fleet(tmp_path, "ada")
    fleet.remember("ada", "192.168.1.9:8080")
    fleet.remember("bob", "192.168.1.10:8080")
    again = Fleet(str(tmp_path), "7b")
    assert [entry.authorities for entry in again.robots] == [("ada.test:8080", "192.168.1.9:8080"),
                                                             ("192.168.1.10:8080",)]
    assert fleet.path.stat().st_mode & 0o777 == 0o600


class Info:
    """A zeroconf.ServiceInfo."""

    def __init__(self, addresses=("fe80::1", "192.168.1.9"), port=8080, properties=None):
        self._addresses, self.port = addresses, port
        self.properties = {b"class": b"7b"} if properties is None else properties

    def parsed_addresses(self):
        return list(self._addresses)


def test_a_robot_that_announces_itself_is_asked_if_it_says_this_class():
    assert address_of(Info(), "7b") == "192.168.1.9:8080"
    for other in Info(properties={}), Info(properties={b"class": b"8a"}), Info(addresses=()), Info(port=None):
        assert address_of(other, "7b") is None


class Network:
    """Stands for the module zeroconf. NAMES are announced; nobody has the address of one that begins with "ghost"."""

    ServiceStateChange = SimpleNamespace(Added=object(), Removed=object())
    NAMES = [*(f"ghost{number}" for number in range(60)), *map(str, range(1, 101))]

    def __init__(self):
        self.ended = threading.Event()

    def Zeroconf(self):
        return self

    def close(self):
        self.ended.set()

    def ServiceBrowser(self, browsing, kind, handlers):
        self.handler = handlers[0]
        for name in self.NAMES:
            self.handler(self, kind, name, self.ServiceStateChange.Added)

    def get_service_info(self, kind, name, timeout):
        if name.startswith("ghost"):
            self.ended.wait()
            return None
        return Info(addresses=[f"192.168.1.{name}"])


def test_robots_are_found_while_names_without_an_address_are_asked_for_and_only_so_many(monkeypatch):
    network = Network()
    monkeypatch.setitem(sys.modules, "zeroconf", network)
    finder = Finder("7b", lambda: [])
    assert wait_until(lambda: len(finder.found()) == 64, WITHIN)
    assert wait_until(lambda: "192.168.1.100:8080" in finder.found(), WITHIN)
    network.handler(network, "", "100", network.ServiceStateChange.Removed)
    assert "192.168.1.100:8080" not in finder.found()
    network.close()
    finder.close()


def score(robot, points):
    return {"task": "One metre", "robot": robot, "score": points, "seconds": 3.9, "name": ""}


def test_the_robots_scores_tasks_and_cameras_are_one_classs():
    tables = Tables()
    for robot, points, on in ("ada", 80.0, False), ("bob", 90.0, True):
        tables.update(f"/{robot}", {"type": "scores", "scores": [score(robot, points)]})
        tables.update(f"/{robot}", {"type": "tasks", "tasks": [{"name": "metre", "title": "One metre", "on": on}]})
        tables.update(f"/{robot}", {"type": "cameras", "on": on})
    tables.update("/ada", {"type": "scene", "robot": "/bob", "shapes": []})
    for points in [[0.0, 0.0]], [[0.0, 0.0], [1.0, 0.0]]:
        tables.update("/ada", {"type": "trail", "robot": "/ada", "start": None, "points": points})
    changes = tables.take_changes()
    assert sorted(said["type"] for said in changes) == ["cameras", "scores", "tasks", "trail"], "the newest of each"
    assert len(changes[-1]["points"]) == 2 and tables.take_changes() == []
    trail, tasks, scores, cameras = tables.messages()
    assert [row["robot"] for row in scores["scores"]] == ["bob", "ada"]
    assert tasks["tasks"] == [{"name": "metre", "title": "One metre", "on": True}]
    assert cameras == {"type": "cameras", "on": True}
