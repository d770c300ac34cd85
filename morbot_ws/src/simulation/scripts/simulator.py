#!/usr/bin/env python3
"""ROS node: simulates a JetBot, or a class of them, driven by what the controller writes to a fake bus or port."""

import jetbot_ros.boot

import signal
import sys
from typing import Dict

import rospy
from rosgraph.names import namespace

from jetbot.boards import BOARDS
from jetbot.fake.motors import Motors
from jetbot.text import printable
from jetbot_ros import contract, lifecycle, links
from jetbot_ros.launcher import Launcher
from jetbot_ros.node_parameters import private_parameters
from simulation import variation
from simulation.diff_drive import Body, DiffDriveModel, Pose
from simulation.simulated_robot import SimulatedRobot
from simulation.simulation_loop import Simulator, spin
from simulation.simulation_parameters import PARAMETERS, fake_folder, resolve
from simulation.world import EMPTY
from simulation.world_files import load


def end_with_roslaunch() -> None:
    """From now on, end this node with the roslaunch that has started it, also if that is killed."""
    launcher = Launcher()

    def check(_):
        launcher.poll()
        if launcher.ended:
            rospy.signal_shutdown("roslaunch has ended")

    rospy.Timer(rospy.Duration(1.0), check)


def make_simulator(node: str, parameters: Dict[str, object]) -> Simulator:
    """Return the simulator of a robot. node: its name, in the robot's namespace; parameters: what is given of them."""
    given = resolve(parameters)
    motors = Motors(fake_folder(given, namespace(node)), given["board"], given["i2c_address"])
    closed_loop = BOARDS[given["board"]].driver.closed_loop
    model = DiffDriveModel(Body(*(given[name] for name in Body._fields)), Pose(given["x"], given["y"], given["yaw"]),
                           load(given["world"]) if given["world"] else EMPTY, closed_loop,
                           variation.draw(namespace(node).strip("/"), given["variation"]))
    # A board with a closed loop measures its motion, but not the angles of its wheels.
    others = ["odom"] if closed_loop else ["odom", "joint_states"] if given["publish_odom"] else []
    return Simulator(node, SimulatedRobot(motors, model), others)


def main() -> int:
    lifecycle.init_node(contract.SIMULATOR)
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, lambda *_: rospy.signal_shutdown("a signal"))
    own = private_parameters(rospy.get_name(), rospy.get_param("~", {}), [*PARAMETERS, "config", "body", "robots"])
    nodes = [f"/{robot}/{contract.SIMULATOR}" for robot in own.pop("robots", "").split()]  # of a class, by their names
    parameters = {node: rospy.get_param(node, {}) for node in nodes} or {rospy.get_name(): own}
    simulators = [make_simulator(*each) for each in parameters.items()]
    end_with_roslaunch()
    links.stay_linked()
    spin(simulators)
    return 0


if __name__ == "__main__":
    try:
        lifecycle.main(main)
    except OSError as error:  # of the fake bus's folder
        rospy.logfatal(printable(error))
        sys.exit(1)
    except rospy.ROSException:
        if not rospy.is_shutdown():  # a shutdown closes the topics while the last step publishes
            raise
