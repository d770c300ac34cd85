"""Without a ROS master that answers, no emergency stop can arrive: the robot stops, and drives again with the next."""

import os
import signal

import rosgraph

from harness import CONTROLLER, START_TIMEOUT, RobotTest, free_port, program, read

STOP_TIMEOUT = 3.0  # s
NAME = "/jetbot_controller"


class MasterLost(RobotTest):
    def setUp(self):
        super().setUp()
        self.port = str(free_port())
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{self.port}"}
        self.start_master()

    def start_master(self):
        self.master = self.start("rosmaster", "--core", "-p", self.port)
        self.wait_for(lambda: rosgraph.is_master_online(self.environment["ROS_MASTER_URI"]), START_TIMEOUT, "a master")

    def graph(self):
        """Return the master as the controller asks it."""
        return rosgraph.Master(NAME, self.environment["ROS_MASTER_URI"])

    def start_below(self, *command):
        return self.start(*command, env=self.environment)

    def controller_below(self):
        return self.start_below(CONTROLLER, f"_i2c_bus:=fake:{self.bus}")

    def driven_controller(self):
        """Return a controller that the workshop's program drives."""
        node = self.controller_below()
        self.start_below(program("workshop", "jetbot_motion_control.py"))
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        return node

    def emergency_stop_below(self):
        self.start_below("rostopic", "pub", "/emergency_stop", "std_msgs/Bool", "true")
        self.wait_for_stop(within=START_TIMEOUT)

    def have_cameras(self):
        """Return whether the master knows both cameras."""
        topics = dict(self.graph().getSystemState()[0])
        return {*topics.get("/camera/image_raw/compressed", ())} == {"/jetbot_camera", "/jetbot_simulator"}

    def test_frozen_and_killed_and_the_next_one_knows_the_robot_and_its_cameras(self):
        node = self.driven_controller()
        self.start_below(program("jetbot_camera", "camera.py"), "_source:=command:sleep 60")
        simulator = self.start_below(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}")
        self.wait_for(lambda: "at x" in read(simulator) and self.have_cameras(), START_TIMEOUT, "the cameras")
        self.master.send_signal(signal.SIGSTOP)
        self.wait_for_stop(within=STOP_TIMEOUT)
        self.master.send_signal(signal.SIGCONT)
        self.wait_for_wheels(0.4, 0.6)
        self.master.send_signal(signal.SIGKILL)
        self.wait_for_stop(within=STOP_TIMEOUT)
        self.assertIn("no ROS master, so no emergency stop could arrive", read(node))
        self.master.wait(START_TIMEOUT)
        self.start_master()
        self.wait_for_wheels(0.4, 0.6)
        self.wait_for(self.have_cameras, START_TIMEOUT, "the cameras to register again")
        self.emergency_stop_below()

    def test_a_robot_that_a_new_master_knows_by_a_parameter_alone_hears_the_emergency_stop(self):
        node = self.driven_controller()
        master = self.graph()
        address = master.lookupNode(NAME)
        publications, subscriptions, services = master.getSystemState()
        for topic in (topic for topic, nodes in publications if NAME in nodes):
            master.unregisterPublisher(topic, address)
        for topic in (topic for topic, nodes in subscriptions if NAME in nodes):
            master.unregisterSubscriber(topic, address)
        for service in (service for service, nodes in services if NAME in nodes):
            master.unregisterService(service, master.lookupService(service))
        master.subscribeParam(address, "/rosout_disable_topics_generation")  # as rospy does with each log line
        self.emergency_stop_below()
        self.wait_for(lambda: "stopped: emergency stop" in read(node), START_TIMEOUT, "its reason")

    def test_a_node_below_a_frozen_master_starts_with_an_error_and_ends_in_time(self):
        node = self.controller_below()
        self.wait_for(lambda: "no command yet" in read(node), START_TIMEOUT, "the controller")
        self.master.send_signal(signal.SIGSTOP)
        late = self.controller_below()
        node.send_signal(signal.SIGTERM)
        node.wait(5.0)
        self.assertNotEqual(late.wait(START_TIMEOUT), 0)
        self.assertIn("does not answer. Is it frozen (Ctrl-Z)?", read(late))

    def test_a_master_that_freezes_while_a_node_starts_is_named(self):
        node = self.controller_below()
        log = ["/rosout", [NAME]]
        self.wait_for(lambda: log in self.graph().getSystemState()[0], START_TIMEOUT, "the node to register")
        self.master.send_signal(signal.SIGSTOP)
        self.wait_for(lambda: "master" in read(node), 10.0, "a sentence")
        node.send_signal(signal.SIGINT)
        node.wait(5.0)
