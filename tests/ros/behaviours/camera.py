"""The camera's node: its pictures arrive as they come; what goes wrong with it is said, and touches no wheel."""

import shlex
import sys
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader
from rospkg import RosPack
from sensor_msgs.msg import CameraInfo, CompressedImage

from harness import START_TIMEOUT, RobotTest, find_processes, program, read

CAMERA = program("jetbot_camera", "camera.py")
PICTURE = b"\xff\xd8\xff\xe0\x00\x04ab\xff\xda\x00\x02picture\xff\xd9"
CHILD = """\
import os, sys, time
while not os.path.exists({end!r}):
    os.path.exists({hang!r}) or os.write(1, {picture!r})
    time.sleep(0.05)
sys.exit("Device is busy")
"""


class Camera(RobotTest):
    def setUp(self):
        super().setUp()
        self.end, self.hang, self.child = (Path(self.folder, name) for name in ("end", "hang", "child.py"))
        self.child.write_text(CHILD.format(end=str(self.end), hang=str(self.hang), picture=PICTURE))

    def start_camera(self):
        command = f"command:exec {shlex.quote(sys.executable)} {self.child}"
        return self.start(CAMERA, f"_source:={command}", "__ns:=red")

    def test_pictures_and_troubles(self):
        self.controller(cmd_vel_timeout=0)
        self.drive_at(0.5)
        images = self.record("/red/camera/image_raw/compressed", CompressedImage)
        infos = self.record("/red/camera/camera_info", CameraInfo)
        arrays = self.record("/diagnostics", DiagnosticArray)
        camera = self.start_camera()
        self.wait_for(lambda: images and infos, START_TIMEOUT, "a picture")
        image = images[-1]
        self.assertEqual((image.data, image.format, image.header.frame_id), (PICTURE, "jpeg", "red/camera_optical"))
        self.wait_for(lambda: {image.header.stamp for image in images[:]} & {info.header.stamp for info in infos[:]},
                      5.0, "the info of a picture")
        info = infos[-1]
        self.assertEqual((info.width, info.K[2], info.header.frame_id), (224, 111.5, "red/camera_optical"))

        def said(text):
            return any(text in status.message for array in arrays for status in array.status
                       if status.name == "red/jetbot_camera: camera")

        self.wait_for(lambda: said(" pictures per second"), 10.0, "their rate")
        self.end.touch()
        self.wait_for(lambda: said("sends no pictures: Device is busy."), 10.0, "the trouble in /diagnostics")
        self.assertEqual(read(camera).count("sends no pictures: Device is busy."), 1)
        del images[:]
        self.end.unlink()
        self.wait_for(lambda: images, 10.0, "pictures of the child that was started again")
        self.hang.touch()
        camera.terminate()
        self.assertEqual(camera.wait(START_TIMEOUT), 0)
        self.wait_for(lambda: not find_processes(str(self.child)), 1.0, "the child to end with its node")
        self.assertEqual(self.wheels(), (0.5, 0.5))

    def test_it_is_started_beside_a_real_robot_and_not_beside_a_simulated_one(self):
        for package, file, nodes in (("jetbot_control_node", "jetbot_controller", ["/red/jetbot_camera"]),
                                     ("simulation", "simulation", [])):
            config = ROSLaunchConfig()
            XmlLoader().load(f"{RosPack().get_path(package)}/launch/{file}.launch", config, verbose=False,
                             argv=["camera:=true", "camera_source:=fake", "robot_name:=red"])
            cameras = [node.namespace + node.name for node in config.nodes if node.package == "jetbot_camera"]
            self.assertEqual(cameras, nodes)
