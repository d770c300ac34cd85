"""A robot of a class, as its service starts it: the network reaches its page, and nothing else of it."""

import os
import re
import subprocess
import time
from pathlib import Path

import pytest

from jetbot_cockpit.remote import identity
from jetbot_cockpit.remote.identity import Identity
from jetbot_cockpit.remote.key import robot_key
from processes import end, free_port, start

KEY = robot_key("A" * 26, "jetbot_07")
START_TIMEOUT = 60.0  # s


@pytest.fixture
def robot(tmp_path):
    """robot.launch with a home, a master and a page of its own: (id of its master, port of its page)."""
    identity.write(Identity("jetbot_07", "7b", KEY), str(tmp_path / ".ros/morbot_robot.json"))
    master, page = f"http://localhost:{free_port()}", free_port()
    environment = {**os.environ, "HOME": str(tmp_path), "ROS_HOME": str(tmp_path / ".ros"), "ROS_MASTER_URI": master}
    log = tmp_path / "log"
    process = start(["roslaunch", "-p", master.rpartition(":")[2], "jetbot_class", "robot.launch", "robot:=jetbot_07",
                     "camera:=false", f"i2c_bus:=fake:{tmp_path / 'bus'}", f"cockpit_port:={page}"], log,
                    env=environment)
    deadline = time.monotonic() + START_TIMEOUT
    while "on the page: jetbot_07" not in log.read_text():
        assert process.poll() is None and time.monotonic() < deadline, log.read_text()
        time.sleep(0.1)
    yield master, page
    end([process])


def listening(master):
    """Return (address, port) of all sockets on which the processes with this master listen."""
    printed = subprocess.run(["ss", "-Hltnp"], stdout=subprocess.PIPE, text=True, check=True).stdout
    rows = [(line.split()[3].rpartition(":"), re.search(r"pid=(\d+)", line)) for line in printed.splitlines()]
    return {(address.strip("[]"), int(port)) for (address, _, port), pid in rows if pid and has_master(pid[1], master)}


def has_master(pid, master):
    """Return whether a process has this master in its environment."""
    try:
        environment = Path(f"/proc/{pid}/environ").read_text(errors="replace")
    except OSError:
        return False  # it is about to end
    return bool(re.search(rf"ROS_MASTER_URI={master}/?\0", environment))


def test_other_computers_reach_the_page_and_nothing_else(robot):
    master, page = robot
    found = listening(master)
    outside = {(address, port) for address, port in found if not address.startswith("127.") and address != "::1"}
    assert {port for _, port in outside} == {page}
    assert int(master.rpartition(":")[2]) in {port for _, port in found}, "its master is here, too"
