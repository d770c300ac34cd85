"""A robot that is turned off at each command of an update. Needs no namespaces."""

import shutil
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "unit"))
from fleet_robot import check_cut, make_world  # noqa: E402

pytestmark = pytest.mark.skipif(not shutil.which("sshd", path="/usr/sbin:/usr/bin"), reason="needs openssh-server")
MOST = 60  # commands of an update


def test_a_robot_turned_off_at_any_command_starts_whole_and_the_next_update_heals(tmp_path):
    robot, laptop = make_world(tmp_path)
    try:
        code, said = laptop.fleet("--class", "7b", "add", "127.0.0.1", f"cockpit_port:={robot.port}")
        assert code == 0, said
        moments = 1
        while check_cut(robot, laptop, moments):
            moments += 1
            assert moments < MOST
        assert moments > 20
    finally:
        robot.close()
