"""The cockpit's control with robots, pads and a clock that are turned by hand.

PYTEST_DONT_REWRITE: test modules import it before they name it as a plugin.
"""

import pytest

from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.classroom.folder import Nowhere
from jetbot_cockpit.session.collection import Collection
from jetbot_cockpit.session.control import Control
from jetbot_cockpit.session.messages import problem_of
from jetbot_cockpit.session.protocol import Message
from jetbot_cockpit.session.rights import Client
from jetbot_cockpit.session.snapshot import RobotSnapshot, Snapshot
from jetbot_ros.state import RobotState

ADA, BOB, TEACHER = Client(1, "pupil"), Client(2, "pupil"), Client(3, "teacher")
OWN = Client(4, "pupil", "/blue")
STOPPED = (0, 0)
WORKSHOP = (2.0, 1.0)
DRIVES = RobotState("driving", "driving")
STANDS = RobotState("stopped", "stopped: the command is zero", "zero")


class FakeRobots:
    """Robots as their snapshot says, which a test replaces."""

    def __init__(self):
        self.now = Snapshot({name: RobotSnapshot(name, geometry=WORKSHOP, simulated=True, state=DRIVES)
                             for name in ("/red", "/blue")})
        self.were_reset, self.reports, self.offered, self.judged = [], [], (), []

    def snapshot(self):
        return self.now

    def change(self, name, **fields):
        self.now = self.now._replace(robots={**self.now.robots, name: self.now.robots[name]._replace(**fields)})

    def set_emergency_stop(self, robot, engaged):
        if robot is None:
            self.now = self.now._replace(emergency=engaged)
        else:
            self.change(robot, stopped=engaged)

    def senses(self, robot):
        return {"pose": [1, 2, 3], "speed": None, "line": None, "command": None, "wheels": [0, 0]}

    def tasks(self):
        return self.offered

    def judge(self, robot, task, request=""):
        self.judged.append((robot, task))
        self.request = request

    def report_driver(self, robot, name, interruption):
        if self.reports[-1:] != [(robot, name, interruption)]:
            self.reports.append((robot, name, interruption))

    def reset(self, robot):
        self.were_reset.append(robot)
        return self.were_reset.count(robot) == 1


class FakeDrivers:
    """What each robot was commanded last, and under which lease."""

    def __init__(self):
        self.commands, self.waiting, self.held, self.resume = {}, set(), [], 0.0

    def drive(self, robot, velocity, lease):
        self.commands[robot] = velocity, lease

    def velocity(self, robot, now):
        """Return what the thread that publishes drives now."""
        velocity, lease = self.commands.get(robot, (STOPPED, None))
        return STOPPED if lease is None or lease.is_silent(now) else velocity

    def hold(self, robot):
        self.held.append(robot)
        return True

    def keep_waiting(self, robot, waiting):
        (self.waiting.add if waiting else self.waiting.discard)(robot)

    def resumes_in(self, robot, now):
        return self.resume

    def let_go(self, robot):
        self.commands[robot] = STOPPED, None


class FakeCameras:
    """One picture of each robot, by its name; and what the hub asks for."""

    def __init__(self):
        self.pictures, self.watched = {}, set()

    def newest(self, robot, now):
        return self.pictures.get(robot)

    def watch(self, robots):
        self.watched = robots


class Kept(Nowhere):
    """What a class keeps, without a disk."""

    def __init__(self):
        super().__init__()
        self.content = {}

    def read(self, name):
        return self.content.get(name)

    def write(self, name, content):
        self.content[name] = content


class Cockpit:
    """Control, and pads that are held down as the pages hold them. pictures: the folder for those that are saved."""

    def __init__(self, pictures=False, folder=None):
        self.robots, self.drivers, self.time = FakeRobots(), FakeDrivers(), 100.0
        self.cameras, self.collection = FakeCameras(), Collection(pictures)
        self.classroom = Classroom(folder)
        self.control = Control(self.robots, self.drivers, self.cameras, self.collection, self.classroom)
        self.control.check(self.time)

    def do(self, client, message):
        stops = message.type == "stop"
        reply = (self.control.stop(client, message.robot) if stops else
                 self.control.handle(client, message, self.time))
        assert reply is None or problem_of(reply) is None
        return reply

    def push(self, client, robot="/red", forward=0.5, left=0.0, seconds=0.0):
        """Hold a pad off centre for so long; return the last reply."""
        end = self.time + seconds
        reply = self.do(client, Message("drive", robot, forward, left))
        while self.time < end:
            self.wait(0.05)
            reply = self.do(client, Message("drive", robot, forward, left))
        return reply

    def settle(self):
        """Wait until everything is kept."""
        self.classroom.do(str).result()

    def lift(self, client, robot="/red"):
        return self.do(client, Message("drive", robot))

    def wait(self, seconds):
        """Let this time pass; return what the last check reports."""
        for _ in range(round(seconds / 0.05)):
            self.time += 0.05
            messages = self.control.check(self.time)
            assert list(filter(None, map(problem_of, [*messages, self.control.state()]))) == []
        return messages

    def drives(self, robot="/red"):
        return self.drivers.velocity(robot, self.time)

    def driver(self, robot="/red"):
        return self.control.state()["robots"][robot]["driver"]

    def must_lift(self, client, robot="/red"):
        """Fail if the robot moves before the finger of this client, which is down, has been lifted."""
        assert self.drives(robot) == STOPPED
        assert self.push(client, robot, seconds=1)["type"] == "lift"
        assert self.drives(robot) == STOPPED
        assert self.lift(client, robot) is None
        assert self.push(client, robot) is None
        assert self.drives(robot) != STOPPED


@pytest.fixture
def kept():
    return Kept()


@pytest.fixture
def cockpit():
    return Cockpit()


@pytest.fixture
def driven(cockpit):
    """Ada's finger is down, and drives red."""
    assert cockpit.push(ADA, seconds=1) is None
    return cockpit
