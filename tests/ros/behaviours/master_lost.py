"""Without a ROS master that answers, no emergency stop can arrive: the robot stops, and drives again with the next."""

import os
import signal

import rosgraph
import rospy

from harness import CONTROLLER, START_TIMEOUT, RobotTest, free_port, program, read

STOP_TIMEOUT = 3.0  # s


class MasterLost(RobotTest):
    def setUp(self):
        super().setUp()
        self.port = str(free_port())
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{self.port}"}
        self.start_master()

    def start_master(self):
        self.master = self.start("rosmaster", "--core", "-p", self.port)
        self.wait_for(lambda: rosgraph.is_master_online(self.environment["ROS_MASTER_URI"]), START_TIMEOUT, "a master")

    def controller_below(self):
        return self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}", env=self.environment)

    def test_frozen_and_killed(self):
        node = self.controller_below()
        self.start(program("workshop", "jetbot_motion_control.py"), env=self.environment)
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
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
        self.start("rostopic", "pub", "/emergency_stop", "std_msgs/Bool", "true", env=self.environment)
        self.wait_for_stop(within=START_TIMEOUT)

    def test_a_new_master_knows_the_cameras(self):
        def have_cameras():
            publishers = dict(rosgraph.Master(rospy.get_name(), self.environment["ROS_MASTER_URI"]).getSystemState()[0])
            return {*publishers.get("/camera/image_raw/compressed", ())} == {"/jetbot_camera", "/jetbot_simulator"}

        self.start(program("jetbot_camera", "camera.py"), "_source:=command:sleep 60", env=self.environment)
        simulator = self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}",
                               env=self.environment)
        self.wait_for(lambda: "at x" in read(simulator) and have_cameras(), START_TIMEOUT, "the cameras")
        self.master.kill()
        self.master.wait(START_TIMEOUT)
        self.start_master()
        self.wait_for(have_cameras, START_TIMEOUT, "the cameras to register again")

    def test_a_robot_that_a_new_master_knows_by_a_parameter_alone_hears_the_emergency_stop(self):
        node = self.controller_below()
        self.start(program("workshop", "jetbot_motion_control.py"), env=self.environment)
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        name = "/jetbot_controller"
        master = rosgraph.Master(name, self.environment["ROS_MASTER_URI"])
        address = master.lookupNode(name)
        publications, subscriptions, services = master.getSystemState()
        for topic in (topic for topic, nodes in publications if name in nodes):
            master.unregisterPublisher(topic, address)
        for topic in (topic for topic, nodes in subscriptions if name in nodes):
            master.unregisterSubscriber(topic, address)
        for service in (service for service, nodes in services if name in nodes):
            master.unregisterService(service, master.lookupService(service))
        master.subscribeParam(address, "/rosout_disable_topics_generation")  # as rospy does with each log line
        self.start("rostopic", "pub", "/emergency_stop", "std_msgs/Bool", "true", env=self.environment)
        self.wait_for(lambda: "stopped: emergency stop" in read(node), START_TIMEOUT, "the emergency stop")
        self.wait_for_stop(within=START_TIMEOUT)

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
        master = rosgraph.Master(rospy.get_name(), self.environment["ROS_MASTER_URI"])
        log = ["/rosout", ["/jetbot_controller"]]
        self.wait_for(lambda: log in master.getSystemState()[0], START_TIMEOUT, "the node to register")
        self.master.send_signal(signal.SIGSTOP)
        self.wait_for(lambda: "master" in read(node), 10.0, "a sentence")
        node.send_signal(signal.SIGINT)
        node.wait(5.0)
