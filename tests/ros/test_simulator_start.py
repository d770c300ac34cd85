"""A simulator that starts is known by its service before the judge hears its world, which it sends once."""

from unittest.mock import MagicMock

import rospy

from jetbot.fake.motors import Motors
from simulation.diff_drive import DiffDriveModel
from simulation.simulated_robot import SimulatedRobot
from simulation.simulation_loop import Simulator


def test_the_service_is_there_before_the_world_and_the_body(monkeypatch):
    names = []
    for kind in ("Publisher", "Subscriber", "Service"):
        monkeypatch.setattr(rospy, kind, lambda name, *_, **__: names.append(name) or MagicMock())
    monkeypatch.setattr(rospy.Time, "now", rospy.Time)
    Simulator("/jetbot_simulator", SimulatedRobot(MagicMock(Motors), DiffDriveModel()), ())
    assert names[0] == "/jetbot_simulator/reset" and {"/world", "/jetbot_simulator/body"} < set(names)
