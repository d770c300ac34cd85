"""check_lesson.py 10 compares what a pupil's node publishes with the picture."""

import pytest
import rospy
from sensor_msgs.msg import CompressedImage
from std_msgs.msg import Float32

from jetbot.camera.jpeg import bgr8_to_jpeg
from jetbot.kinematics import Pose
from jetbot_lessons import sight
from simulation.picture import render
from simulation.world_files import load


@pytest.fixture
def check(monkeypatch):
    """Returns the problem of a node that publishes these answers, beside a robot at a place to the left of a line."""
    def run(y, *answers, world="line.yaml", kind="std_msgs/Float32"):
        picture = CompressedImage(data=bgr8_to_jpeg(render(load(world), Pose(0.0, y))))
        monkeypatch.setattr(rospy, "wait_for_message", lambda *_: picture)
        monkeypatch.setattr(rospy, "Subscriber", lambda _, __, act: [act(Float32(answer)) for answer in answers])
        monkeypatch.setattr(rospy, "get_published_topics", lambda: [["/dark_x", kind]])
        return sight.check_answer()
    monkeypatch.setattr(sight.graph, "publishers_of", lambda _: ["/look"])
    monkeypatch.setattr(sight.graph, "subscriptions_of", lambda _: {sight.PICTURES: "sensor_msgs/CompressedImage"})
    monkeypatch.setattr(sight, "init_node", lambda: None)
    monkeypatch.setattr(sight, "TIMEOUT", 0.1)
    return run


@pytest.mark.parametrize("y, answer, problem", [
    (0.04, 0.37, None), (-0.04, -0.40, None),
    (0.04, -0.37, "Your node publishes -0.37, and the dark pixels are at 0.37: to the right is positive"),
    (0.04, 152.2, "Your node publishes 152.20, and the dark pixels are at 0.37: "
                  "divide by half the width, and subtract 1"),
    (0.04, 0.0, "Your node publishes 0.00, and the dark pixels are at 0.37: rows come before columns"),
    (0.0, 0.0, f"The line is in the middle of the picture: {sight.PUT}")])
def test_where_the_line_is(check, y, answer, problem):
    assert check(y, answer) == problem


def test_no_line_and_no_answer(check):
    assert check(0.0, 0.0, world="parking.yaml") == f"Nothing in the lower half of the picture is dark: {sight.PUT}"
    assert check(0.04) == sight.SILENT


@pytest.mark.parametrize("subscriptions, kind, problem", [
    ({"/camera/image_raw": "sensor_msgs/Image"}, "std_msgs/Float32",
     "/look does not subscribe to /camera/image_raw/compressed: use that in rospy.Subscriber"),
    ({sight.PICTURES: "sensor_msgs/Image"}, "std_msgs/Float32",
     "/look expects sensor_msgs/Image: use CompressedImage in rospy.Subscriber"),
    ({sight.PICTURES: "sensor_msgs/CompressedImage"}, "std_msgs/Float64",
     "/dark_x is std_msgs/Float64, not std_msgs/Float32: use Float32 in rospy.Publisher")])
def test_pictures_or_answers_of_another_kind(check, monkeypatch, subscriptions, kind, problem):
    monkeypatch.setattr(sight.graph, "subscriptions_of", lambda _: subscriptions)
    assert check(0.04, kind=kind) == problem


def test_no_picture(check, monkeypatch):
    def give_up(*_):
        raise rospy.ROSException
    monkeypatch.setattr(rospy, "get_published_topics", list)
    monkeypatch.setattr(rospy, "Subscriber", lambda *_: None)
    monkeypatch.setattr(rospy, "wait_for_message", give_up)
    assert sight.check_answer() == ("No picture arrives on /camera/image_raw/compressed: "
                                    "start a simulated robot, or a real one with camera:=true")
