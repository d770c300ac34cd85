"""Who may drive which robot, with robots and a clock that are turned by hand."""

import pytest

from jetbot_cockpit.control import Client, Control
from jetbot_cockpit.dead_man import DeadMan
from jetbot_cockpit.protocol import Drive, Name, Release, Reset, Stop, Take
from jetbot_cockpit.view import Robot, Snapshot, changes, program

ADA, BOB, TEACHER = Client(1, "pupil 1", "pupil"), Client(2, "pupil 2", "pupil"), Client(3, "teacher", "teacher")
OWN = Client(4, "pupil 4", "pupil", "/blue")
STOPPED = (0, 0)
WORKSHOP = (2.0, 1.0)


class FakeRobots:
    """Robots as their snapshot says, which a test replaces."""

    def __init__(self):
        self.now = Snapshot({name: Robot(name, geometry=WORKSHOP, simulated=True) for name in ("/red", "/blue")})
        self.were_reset = []

    def snapshot(self):
        return self.now

    def change(self, name, **fields):
        self.now = self.now._replace(robots={**self.now.robots, name: self.now.robots[name]._replace(**fields)})

    def stop(self, robot, engaged):
        if robot is None:
            self.now = self.now._replace(emergency=engaged)
        else:
            self.change(robot, stopped=engaged)

    def reset(self, robot):
        self.were_reset.append(robot)
        return self.were_reset.count(robot) == 1


class FakeDrive:
    """What each robot is driven at, with the real switch."""

    def __init__(self):
        self.velocities, self._switches = {}, {}

    def command(self, robot, velocity, now):
        accepted = self._switches.setdefault(robot, DeadMan()).feed(now)
        self.velocities[robot] = velocity if accepted else STOPPED
        return accepted

    def release(self, robot):
        self._switches.setdefault(robot, DeadMan()).release()
        self.velocities[robot] = STOPPED


class Cockpit:
    """Control, and pads that are held down as the pages hold them."""

    def __init__(self):
        self.robots, self.drive, self.time = FakeRobots(), FakeDrive(), 100.0
        self.control = Control(self.robots, self.drive)
        self.control.check(self.time)

    def do(self, client, message):
        return self.control.handle(client, message, self.time)

    def push(self, client, robot="/red", forward=0.5, left=0.0, seconds=0.0):
        """Hold a pad off centre for so long; return the last reply."""
        end = self.time + seconds
        reply = self.do(client, Drive(robot, forward, left))
        while self.time < end:
            self.wait(0.05)
            reply = self.do(client, Drive(robot, forward, left))
        return reply

    def lift(self, client, robot="/red"):
        return self.do(client, Drive(robot, 0.0, 0.0))

    def wait(self, seconds):
        """Let this time pass; return what the last check reports."""
        for _ in range(round(seconds / 0.05)):
            self.time += 0.05
            messages = self.control.check(self.time)
        return messages

    def drives(self, robot="/red"):
        return self.drive.velocities.get(robot, STOPPED)

    def driver(self, robot="/red"):
        return self.control.state(self.time)["robots"][robot]["driver"]

    def must_lift(self, client, robot="/red"):
        """Fail if the robot moves before the finger of this client, which is down, has been lifted."""
        assert self.drives(robot) == STOPPED
        assert self.push(client, robot, seconds=1)["type"] == "lift"
        assert self.drives(robot) == STOPPED
        assert self.lift(client, robot) is None
        assert self.push(client, robot) is None
        assert self.drives(robot) != STOPPED


@pytest.fixture
def cockpit():
    return Cockpit()


@pytest.fixture
def driven(cockpit):
    """Ada's finger is down, and drives red."""
    assert cockpit.push(ADA, seconds=1) is None
    return cockpit


def test_full_deflection_is_full_power_in_the_units_of_each_robot(cockpit):
    for geometry, (forward, turn) in {(2.0, 1.0): (1.0, 1.0), (0.1, 0.6): (0.6, 12.0), None: (1.0, 1.0)}.items():
        cockpit.robots.change("/red", geometry=geometry)
        cockpit.wait(0.05)
        cockpit.push(ADA, forward=1.0, left=0.0)
        assert cockpit.drives() == pytest.approx((forward, 0))
        cockpit.push(ADA, forward=0.0, left=1.0)
        assert cockpit.drives() == pytest.approx((0, turn))


def test_the_driver_is_shown_with_the_name_it_gives_itself(driven):
    assert driven.driver() == {"id": 1, "name": "pupil 1"}
    driven.do(ADA, Name(" Ada "))
    assert driven.driver() == {"id": 1, "name": "Ada"}
    assert driven.driver("/blue") is None


def test_release_stops_the_robot_and_keeps_it_for_five_seconds(driven):
    driven.lift(ADA)
    assert driven.drives() == STOPPED
    driven.wait(4.9)
    assert driven.driver()["id"] == ADA.id
    driven.wait(0.15)
    assert driven.driver() is None


def test_of_two_who_want_to_drive_the_second_must_lift_and_wait(driven):
    reply = driven.push(BOB, forward=-1.0)
    assert reply == {"type": "lift", "robot": "/red", "text": "pupil 1 drives red."}
    assert driven.drives() == (0.5, 0)
    assert driven.push(ADA) is None
    driven.lift(ADA)
    for _ in range(120):
        driven.wait(0.05)
        assert driven.push(BOB)["type"] == "lift"
    driven.must_lift(BOB)


def test_a_release_of_a_robot_that_another_drives_changes_nothing(driven):
    driven.lift(BOB)
    assert (driven.drives(), driven.driver()["id"]) == ((0.5, 0), ADA.id)


def test_a_finger_that_was_silent_for_too_long_must_lift(driven):
    driven.wait(0.35)
    assert driven.push(ADA)["text"].startswith("No command for 0.3 s.")
    driven.must_lift(ADA)


def test_a_hidden_tab_that_sends_once_a_second_drives_no_more(driven):
    for _ in range(10):
        driven.wait(1.0)
        driven.push(ADA)
        assert driven.drives() == STOPPED


@pytest.mark.parametrize("first", ["a check", "a command"])
def test_what_waited_in_the_sockets_while_the_cockpit_was_frozen_is_not_driven(driven, first):
    driven.time += 2.5
    if first == "a check":
        driven.control.check(driven.time)
    driven.lift(ADA)
    for _ in range(10):
        driven.time += 0.001
        assert driven.push(ADA)["type"] == "lift"
    driven.wait(0.4)
    driven.must_lift(ADA)


def test_a_finger_that_returns_after_its_lease_has_ended_must_lift(driven):
    driven.wait(5.05)
    assert driven.driver() is None
    driven.must_lift(ADA)


def test_a_switch_that_fired_does_not_hinder_the_next_driver(driven):
    driven.wait(0.35)
    driven.push(ADA)
    driven.do(TEACHER, Take("/red"))
    assert driven.push(TEACHER) is None
    assert driven.drives() == (0.5, 0)


def test_a_closed_socket_stops_its_robot_at_once_and_frees_it(driven):
    driven.control.leave(ADA.id, driven.time)
    assert (driven.drives(), driven.driver()) == (STOPPED, None)
    assert driven.push(BOB) is None


def test_a_teacher_takes_a_robot_and_the_finger_must_lift(driven):
    assert driven.do(TEACHER, Take("/red")) is None
    assert (driven.drives(), driven.driver()["id"]) == (STOPPED, TEACHER.id)
    driven.control.leave(TEACHER.id, driven.time)
    driven.must_lift(ADA)


def test_a_finger_that_was_up_when_the_teacher_took_drives_at_once_later(driven):
    driven.lift(ADA)
    driven.do(TEACHER, Take("/red"))
    driven.control.leave(TEACHER.id, driven.time)
    assert driven.push(ADA) is None


def test_a_pupil_takes_and_puts_back_nothing(driven):
    assert driven.do(BOB, Take("/red"))["type"] == "notice"
    assert driven.do(BOB, Reset())["type"] == "notice"
    assert (driven.driver()["id"], driven.robots.were_reset) == (ADA.id, [])


def test_a_pupil_with_a_robot_drives_and_stops_that_one_only(cockpit):
    assert cockpit.push(OWN, "/red") == {"type": "lift", "robot": "/red", "text": "Your code drives blue only."}
    assert cockpit.do(OWN, Stop("/red"))["type"] == "notice"
    assert cockpit.do(OWN, Release("/red"))["type"] == "notice"
    assert cockpit.do(OWN, Stop("/blue")) is None
    assert [robot.stopped for robot in cockpit.robots.now.robots.values()] == [False, True]
    assert cockpit.do(OWN, Release("/blue")) is None
    cockpit.lift(OWN, "/blue")
    assert cockpit.push(OWN, "/blue") is None


def test_who_drives_another_robot_stops_the_first(driven):
    assert driven.push(ADA, "/blue") is None
    assert (driven.drives("/red"), driven.driver("/red")) == (STOPPED, None)
    assert driven.drives("/blue") == (0.5, 0)


@pytest.mark.parametrize("robot", [None, "/red"])
def test_a_stop_ends_the_lease_and_the_finger_must_lift_after_its_release(driven, robot):
    driven.do(TEACHER, Stop(robot))
    assert (driven.drives(), driven.driver()) == (STOPPED, None)
    assert "top" in driven.push(ADA, seconds=1)["text"]
    driven.do(TEACHER, Release(robot))
    driven.must_lift(ADA)


def test_anybody_stops_all_and_releases_that(driven):
    assert driven.do(BOB, Stop()) is None
    assert driven.control.state(driven.time)["emergency"]
    assert driven.do(ADA, Release()) is None
    assert not driven.control.state(driven.time)["emergency"]


def test_a_stop_by_a_teacher_is_released_by_a_teacher(driven):
    driven.do(TEACHER, Stop())
    driven.do(ADA, Stop())
    driven.wait(1)
    assert driven.do(ADA, Release())["type"] == "notice"
    assert driven.robots.now.emergency
    assert driven.do(TEACHER, Release()) is None
    driven.do(ADA, Stop())
    assert driven.do(ADA, Release()) is None


def test_a_stop_by_a_teacher_that_ros_has_released_is_forgotten(driven):
    driven.do(TEACHER, Stop())
    driven.robots.stop(None, False)
    driven.wait(0.05)
    driven.do(ADA, Stop())
    assert driven.do(ADA, Release()) is None


def change(fake, **fields):
    fake.now = fake.now._replace(**fields)


@pytest.mark.parametrize("break_it, mend_it", [
    (lambda robots: change(robots, emergency=True), lambda robots: change(robots, emergency=False)),
    (lambda robots: change(robots, master=False), lambda robots: change(robots, master=True)),
    (lambda robots: change(robots, robots={}), lambda robots: change(robots, robots=FakeRobots().now.robots)),
    (lambda robots: robots.change("/red", answers=False), lambda robots: robots.change("/red", answers=True)),
], ids=["emergency stop", "master", "robot gone", "robot does not answer"])
def test_what_comes_back_while_a_finger_is_down_does_not_jump_off(driven, break_it, mend_it):
    break_it(driven.robots)
    driven.wait(0.05)
    assert driven.drives() == STOPPED
    mend_it(driven.robots)
    driven.must_lift(ADA)


def test_a_robot_that_there_never_was_is_not_driven(cockpit):
    assert cockpit.push(ADA, "/nobody")["text"] == "nobody has ended."
    assert cockpit.do(TEACHER, Take("/nobody"))["text"] == "nobody has ended."
    assert cockpit.do(TEACHER, Stop("/nobody"))["text"] == "nobody has ended."
    assert cockpit.drive.velocities == {}


def test_a_teacher_puts_back_simulated_robots(cockpit):
    cockpit.robots.change("/blue", simulated=False)
    cockpit.wait(0.05)
    assert cockpit.do(TEACHER, Reset()) is None
    assert cockpit.robots.were_reset == ["/red"]
    assert cockpit.do(TEACHER, Reset("/blue"))["type"] == "notice"
    assert cockpit.do(TEACHER, Reset("/red"))["text"] == "red has not answered yet."


def test_a_robot_that_was_put_back_starts_its_trail_again(cockpit):
    cockpit.robots.change("/red", pose=(1.0, 0.0, 0.0))
    assert cockpit.wait(0.05) == []
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0))
    assert cockpit.wait(0.05) == [{"type": "trail", "robot": "/red", "points": []}]


def test_a_robot_that_was_put_back_by_a_teacher_starts_its_trail_again_however_near_its_start_is(cockpit):
    cockpit.robots.change("/red", pose=(0.1, 0.0, 0.0))
    cockpit.wait(0.05)
    cockpit.do(TEACHER, Reset("/red"))
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0))
    assert [message for _ in range(12) for message in cockpit.wait(0.05)] == [
        {"type": "trail", "robot": "/red", "points": []}]


@pytest.mark.parametrize("commanded_by, name", [
    ("/jetbot_motion_control", "jetbot_motion_control"), ("/jetbot_cockpit", ""), ("nobody yet", ""), (None, "")])
def test_the_program_that_drives_a_robot_has_its_name(commanded_by, name):
    assert program(commanded_by, "/jetbot_cockpit") == name


def test_the_terminal_has_a_sentence_for_robots_that_come_and_go():
    assert changes([], []) == []
    assert changes(["jetbot_01"], ["red", "blue"]) == ["jetbot_01 is running.", "red, blue are not running any more."]


def test_ids_of_robots_become_short_printable_labels():
    assert [Robot(name).label for name in ("/", "/jetbot_01", "/a/b", "/\x1b[31m" + 99 * "x")] == [
        "robot", "jetbot_01", "a/b", "?[31m" + 35 * "x"]
