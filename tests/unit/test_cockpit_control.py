"""Who drives, stops, takes and puts back which robot, with robots and a clock that are turned by hand."""

import pytest
from cockpit_control import ADA, BOB, DRIVES, OWN, STANDS, STOPPED, TEACHER, FakeRobots

from jetbot_cockpit.notices import say
from jetbot_cockpit.session.lease import Lease
from jetbot_cockpit.session.protocol import Message
from jetbot_cockpit.session.rights import Client
from jetbot_cockpit.session.snapshot import RobotSnapshot, Snapshot, TaskSnapshot
from jetbot_ros.state import UNKNOWN

pytest_plugins = ["cockpit_control"]  # its fixtures

SECOND_TEACHER = Client(5, "teacher")
DONE = TaskSnapshot("metre", "One metre", "done", "went well", 4.0, 80.0)


def change(fake, **fields):
    fake.now = fake.now._replace(**fields)


def test_full_deflection_is_full_power_in_the_units_of_each_robot(cockpit):
    for geometry, (forward, turn) in {(2.0, 1.0): (1.0, 1.0), (0.1, 0.6): (0.6, 12.0), None: (1.0, 1.0)}.items():
        cockpit.robots.change("/red", geometry=geometry)
        cockpit.wait(0.05)
        cockpit.push(ADA, forward=1.0, left=0.0)
        assert cockpit.drives() == pytest.approx((forward, 0))
        cockpit.push(ADA, forward=0.0, left=1.0)
        assert cockpit.drives() == pytest.approx((0, turn))


PUPIL_1 = {"code": "pupil", "arguments": {"number": "1"}, "text": "pupil 1", "template": "pupil {number}"}


def test_the_driver_is_shown_with_the_name_it_gives_itself(driven):
    assert driven.driver() == {"id": 1, "name": "pupil 1", "said": PUPIL_1}
    driven.do(ADA, Message("name", name=" Ada "))
    assert driven.driver() == {"id": 1, "name": "Ada", "said": None}
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
    assert reply == {"type": "lift", "robot": "/red", "code": "driven", "text": "pupil 1 drives red.",
                     "arguments": {"driver": PUPIL_1, "robot": "red"}, "template": "{driver} drives {robot}."}
    driven.lift(BOB)
    assert driven.drives() == (0.5, 0)
    assert driven.push(ADA) is None
    driven.lift(ADA)
    assert driven.push(BOB, seconds=6)["type"] == "lift"
    driven.must_lift(BOB)


@pytest.mark.parametrize("seconds, driver", [(0.35, ADA.id), (1.0, ADA.id), (5.05, None)])
def test_a_finger_that_was_silent_for_too_long_must_lift(driven, seconds, driver):
    driven.wait(seconds)
    assert (driven.driver() or {}).get("id") == driver
    if driver:
        assert driven.push(ADA)["text"].startswith("No command for 0.3 s.")
    driven.must_lift(ADA)


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


def test_a_switch_that_fired_does_not_hinder_the_next_driver(driven):
    driven.wait(0.35)
    driven.push(ADA)
    driven.do(TEACHER, Message("take", "/red"))
    assert driven.push(TEACHER) is None
    assert driven.drives() == (0.5, 0)


def test_a_closed_socket_stops_its_robot_at_once_and_frees_it(driven):
    driven.control.leave(ADA.id)
    assert (driven.drives(), driven.driver()) == (STOPPED, None)
    assert driven.push(BOB) is None


def test_who_drives_another_robot_stops_the_first(driven):
    assert driven.push(ADA, "/blue") is None
    assert (driven.drives("/red"), driven.driver("/red")) == (STOPPED, None)
    assert driven.drives("/blue") == (0.5, 0)


def test_a_robot_that_there_never_was_is_not_driven(cockpit):
    for kind in "drive", "take", "stop":
        assert cockpit.do(TEACHER, Message(kind, "/nobody", forward=1.0))["text"] == "nobody has ended."
    assert cockpit.drivers.commands == {}


def test_a_teacher_takes_a_robot_and_the_finger_must_lift(driven):
    assert driven.do(TEACHER, Message("take", "/red")) is None
    assert (driven.drives(), driven.driver()["id"]) == (STOPPED, TEACHER.id)
    driven.do(TEACHER, Message("go_on", "/red"))
    driven.must_lift(ADA)


def leave(cockpit):
    cockpit.control.leave(ADA.id)


def take(cockpit):
    cockpit.do(TEACHER, Message("take", "/red"))


def stall(cockpit):
    cockpit.wait(0.25)
    cockpit.time += 0.06
    cockpit.push(ADA)


def freeze(cockpit):
    cockpit.time += 0.31
    cockpit.push(ADA)


@pytest.mark.parametrize("interrupt, sentence", [
    (leave, "the driver's page was closed, or lost its connection"), (take, "a teacher took the robot over"),
    (stall, "no command came from the driver's page for 0.3 s"),
    (freeze, "no command came from the driver's page for 0.3 s"),
    (lambda cockpit: cockpit.wait(0.35), "no command came from the driver's page for 0.3 s")],
    ids=["a closed page", "a teacher", "a network that stalls", "a cockpit that was frozen", "a lost page"])
def test_a_judge_learns_who_drives_and_what_interrupted_it(driven, interrupt, sentence):
    driven.do(ADA, Message("name", name=" Ada "))
    driven.push(ADA)
    assert driven.robots.reports == [("/red", "", None), ("/red", "Ada", None)]
    interrupt(driven)
    assert [str(interruption) for *of, interruption in driven.robots.reports if of == ["/red", "Ada"]][1:] == [sentence]


def test_a_finger_that_lifts_at_the_goal_is_no_interruption(driven):
    driven.lift(ADA)
    driven.wait(1)
    leave(driven)
    assert [interruption for _, _, interruption in driven.robots.reports] == [None]


def test_a_finger_that_was_up_when_the_teacher_took_drives_at_once_later(driven):
    driven.lift(ADA)
    driven.do(TEACHER, Message("take", "/red"))
    driven.do(TEACHER, Message("go_on", "/red"))
    assert driven.push(ADA) is None


def resumes(cockpit):
    """Return in how many seconds a program drives red on; what waits, if that is until a teacher says so."""
    state = cockpit.control.state()["robots"]["/red"]
    return state["held"] or state["resumes"]


@pytest.fixture
def commanded(driven):
    """Red, which Ada has left while a program commands it, with 3.2 s to go."""
    driven.lift(ADA)
    driven.drivers.resume = 3.2
    driven.robots.change("/red", state=STANDS._replace(waiting=("/circle",)))
    driven.wait(0.05)
    return driven


def test_the_seconds_until_a_program_drives_on_are_counted_where_one_waits(commanded):
    assert resumes(commanded) == 4
    for state in STANDS, DRIVES._replace(waiting=("/circle",)):
        commanded.robots.change("/red", state=state)
        commanded.wait(0.05)
        assert resumes(commanded) is None


def test_nothing_is_counted_while_a_page_repeats_zeros_for_its_program_is_paused(commanded):
    commanded.drivers.resume = 4.95
    assert resumes(commanded) is None


@pytest.mark.parametrize("state", [STANDS._replace(waiting=("/circle",)), DRIVES], ids=["waits", "drives"])
@pytest.mark.parametrize("message, held", [(Message("take", "/red"), "robot"), (Message("stop"), "programs"),
                                           (Message("stop", "/red"), "programs")])
def test_a_teachers_take_or_stop_keeps_programs_waiting_until_a_teacher_says_go_on(commanded, message, held, state):
    commanded.robots.change("/red", state=state)
    commanded.do(TEACHER, message)
    commanded.do(TEACHER, Message("release", message.robot))
    commanded.control.leave(TEACHER.id)
    known = commanded.robots.now.robots
    for robots in {}, known:  # its controller is restarted
        change(commanded.robots, robots=robots)
        commanded.wait(10)
    assert resumes(commanded) == held and "/red" in commanded.drivers.waiting
    assert commanded.do(ADA, Message("go_on", "/red"))["text"] == "Only a teacher lets robots go on."
    commanded.robots.change("/red", state=STANDS._replace(waiting=("/circle",)))
    commanded.wait(0.05)
    assert commanded.do(SECOND_TEACHER, Message("go_on", message.robot)) is None
    assert (resumes(commanded), commanded.drivers.waiting) == (4, set())


@pytest.mark.parametrize("run", [Message("drive", "/red", 0.5), Message("program", "/red")], ids=["pad", "blocks"])
def test_what_a_teacher_took_no_pupil_drives_until_it_is_given_back(driven, run):
    driven.lift(ADA)
    for message in "take", "stop", "release":
        driven.do(TEACHER, Message(message, "/red"))
    driven.wait(6)
    assert driven.do(ADA, run) == {"type": "lift", "robot": "/red", **say("taken", robot="red").fields()}
    assert driven.push(TEACHER) is None
    driven.do(TEACHER, Message("go_on", "/red"))
    driven.lift(ADA)
    assert (driven.do(ADA, run) or {}).get("type") != "lift"
    assert driven.driver()["id"] == ADA.id


def test_a_teachers_stop_of_all_holds_programs_of_robots_that_come_until_its_release_and_a_pupils_stop_none(cockpit):
    known = cockpit.robots.now.robots
    for client, waiting in (ADA, set()), (TEACHER, set(known)):
        change(cockpit.robots, robots={})
        cockpit.wait(0.05)
        cockpit.do(client, Message("stop"))
        change(cockpit.robots, robots=known)
        cockpit.wait(0.05)
        assert cockpit.drivers.waiting == waiting
        cockpit.do(TEACHER, Message("release"))
    cockpit.do(TEACHER, Message("go_on"))
    for robots in {}, known:
        change(cockpit.robots, robots=robots, emergency=True)  # as robots still say
        cockpit.wait(0.05)
    assert cockpit.drivers.waiting == set()


def test_a_pupil_drives_after_the_release_of_a_teachers_stop_though_programs_wait(driven):
    driven.do(TEACHER, Message("stop"))
    driven.wait(0.05)
    driven.do(TEACHER, Message("release"))
    driven.must_lift(ADA)
    assert driven.drivers.waiting == {"/red", "/blue"}


def test_a_pupil_takes_and_puts_back_nothing(driven):
    assert driven.do(BOB, Message("take", "/red"))["type"] == "notice"
    assert driven.do(BOB, Message("reset"))["type"] == "notice"
    assert (driven.driver()["id"], driven.robots.were_reset) == (ADA.id, [])


def test_a_pupil_with_a_robot_drives_and_stops_that_one_only(cockpit):
    assert cockpit.push(OWN, "/red") == {
        "type": "lift", "robot": "/red", **say("own_robot_only", robot="blue").fields()}
    assert cockpit.do(OWN, Message("stop", "/red"))["type"] == "notice"
    assert cockpit.do(OWN, Message("release", "/red"))["type"] == "notice"
    assert cockpit.do(OWN, Message("stop", "/blue")) is None
    assert [robot.stopped for robot in cockpit.robots.now.robots.values()] == [False, True]
    assert cockpit.do(OWN, Message("release", "/blue")) is None
    cockpit.lift(OWN, "/blue")
    assert cockpit.push(OWN, "/blue") is None


def test_each_stall_of_a_drivers_commands_counts_for_a_minute(driven):
    for _ in range(2):
        driven.wait(0.35)
        driven.push(ADA)
        driven.must_lift(ADA)
    driven.lift(ADA)

    def stalls():
        return {robot: state["stalls"] for robot, state in driven.control.state()["robots"].items()}
    assert stalls() == {"/red": 2, "/blue": 0}
    driven.wait(61)
    assert stalls() == {"/red": 0, "/blue": 0}


def test_the_switch_fires_0_3_s_after_the_last_command_and_never_while_the_robot_is_not_driven():
    lease = Lease(ADA, 10.0, driving=True)
    assert lease.remaining(10.1) == pytest.approx(0.2)
    assert (lease.is_silent(10.29), lease.is_silent(10.31), lease.remaining(10.31)) == (False, True, 0)
    assert not lease._replace(driving=False).is_silent(1e9)


@pytest.mark.parametrize("robot", [None, "/red"])
def test_a_stop_ends_the_lease_and_the_finger_must_lift_after_its_release(driven, robot):
    driven.do(TEACHER, Message("stop", robot))
    driven.wait(0.05)
    assert (driven.drives(), driven.driver()) == (STOPPED, None)
    assert "top" in driven.push(ADA, seconds=1)["text"]
    driven.do(TEACHER, Message("release", robot))
    driven.must_lift(ADA)


def pupils_may_release(cockpit):
    """Let a pupil stop and release all; return whether that ends the stop."""
    cockpit.do(BOB, Message("stop"))
    assert cockpit.control.state()["emergency"]
    cockpit.wait(0.05)
    cockpit.do(ADA, Message("release"))
    return not cockpit.control.state()["emergency"]


def test_anybody_stops_all_and_releases_that(driven):
    assert pupils_may_release(driven)


@pytest.mark.parametrize("stop", [
    lambda cockpit: cockpit.do(TEACHER, Message("stop")),
    lambda cockpit: cockpit.do(ADA, Message("stop")) or cockpit.do(TEACHER, Message("stop")),
    lambda cockpit: change(cockpit.robots, emergency=True),
    lambda cockpit: cockpit.do(ADA, Message("stop")) or change(cockpit.robots, stopped_elsewhere=frozenset([None])),
], ids=["a teacher's", "a teacher's after a pupil's", "before the cockpit", "a terminal's after a pupil's"])
def test_a_stop_that_is_not_a_pupils_alone_is_released_by_a_teacher(driven, stop):
    stop(driven)
    driven.wait(0.05)
    assert not pupils_may_release(driven)
    assert driven.do(TEACHER, Message("release")) is None
    change(driven.robots, stopped_elsewhere=frozenset())
    driven.wait(0.05)
    assert pupils_may_release(driven)


def test_a_stop_from_before_the_cockpit_stays_a_teachers_though_a_pupil_stops_before_the_robots_have_reported(driven):
    reported = driven.robots.now.robots
    for known in {}, {name: robot._replace(state=UNKNOWN) for name, robot in reported.items()}:
        driven.robots.now = driven.robots.now._replace(robots=known)
        driven.wait(0.05)
        driven.do(ADA, Message("stop"))
        driven.robots.now = driven.robots.now._replace(robots=reported)
        driven.wait(0.05)
        assert driven.do(ADA, Message("release"))["type"] == "notice"
        driven.do(TEACHER, Message("release"))


def test_a_pupils_stop_that_a_terminal_has_released_is_forgotten(driven):
    driven.do(ADA, Message("stop"))
    change(driven.robots, emergency=False)
    driven.wait(0.05)
    change(driven.robots, emergency=True)
    driven.wait(0.05)
    assert driven.do(ADA, Message("release"))["code"] == "teacher_releases"


def test_who_releases_where_nothing_is_stopped_is_told_so(driven):
    for client, robot in ((ADA, None), (OWN, None), (OWN, "/blue"), (TEACHER, None), (TEACHER, "/red")):
        assert driven.do(client, Message("release", robot))["text"] == "The emergency stop is not engaged."
    assert driven.drives() != STOPPED


def test_a_release_of_all_robots_ends_no_robots_own_stop_and_names_it(driven):
    driven.do(TEACHER, Message("stop", "/blue"))
    driven.wait(0.05)
    answer = driven.do(TEACHER, Message("release"))
    assert answer["text"] == "Release blue in the list of robots. No other robot is stopped."
    assert driven.robots.now.robots["/blue"].stopped


@pytest.mark.parametrize("break_it, repair_it", [
    (lambda robots: change(robots, emergency=True), lambda robots: change(robots, emergency=False)),
    (lambda robots: change(robots, master=False), lambda robots: change(robots, master=True)),
    (lambda robots: change(robots, robots={}), lambda robots: change(robots, robots=FakeRobots().now.robots)),
    (lambda robots: robots.change("/red", answers=False), lambda robots: robots.change("/red", answers=True)),
], ids=["emergency stop", "master", "robot gone", "robot does not answer"])
def test_what_comes_back_while_a_finger_is_down_does_not_jump_off(driven, break_it, repair_it):
    break_it(driven.robots)
    driven.wait(0.05)
    assert driven.drives() == STOPPED
    repair_it(driven.robots)
    driven.must_lift(ADA)


def test_a_teacher_puts_back_simulated_robots(cockpit):
    cockpit.robots.change("/blue", simulated=False)
    cockpit.wait(0.05)
    assert cockpit.do(TEACHER, Message("reset")) is None
    assert cockpit.robots.were_reset == ["/red"]
    assert cockpit.do(TEACHER, Message("reset", "/blue"))["type"] == "notice"
    assert cockpit.do(TEACHER, Message("reset", "/red"))["text"] == "The simulator does not answer: red."


def test_a_robot_that_is_put_back_stops_and_what_drove_it_ends_and_all_pages_are_told(driven):
    driven.do(OWN, Message("program", "/blue"))  # it waits, and drives later
    driven.do(TEACHER, Message("reset"))
    assert (driven.drives(), driven.driver("/red"), driven.driver("/blue")) == (STOPPED, None, None)
    assert [(robot, str(interruption)) for robot, _, interruption in driven.robots.reports[-2:]] == [
        (robot, "a teacher put the robot back to its start") for robot in ("/red", "/blue")]
    assert [(each["type"], each["robot"], each["text"]) for each in driven.wait(0.05)] == [
        ("lift", "/red", "red was put back to its start."), ("lift", "/blue", "blue was put back to its start.")]
    assert driven.wait(0.05) == []


def test_a_robot_is_put_back_before_anybody_drives_it_again(cockpit):
    cockpit.push(ADA)
    cockpit.lift(ADA)
    cockpit.do(TEACHER, Message("reset", "/red"))
    for message in Message("drive", "/red", 0.5, 0.0), Message("program", "/red"):
        assert cockpit.do(BOB, message)["code"] == "put_back"
    assert cockpit.do(BOB, Message("judge", "/red", task="x"))["refusal"]["code"] == "put_back"
    assert cockpit.push(OWN, "/blue") is None, "another robot"
    cockpit.wait(0.55)
    assert cockpit.push(ADA) is None, "who had let go need not do so again"


def test_a_finger_that_drove_a_robot_which_is_put_back_must_lift(driven):
    driven.do(TEACHER, Message("reset", "/red"))
    driven.must_lift(ADA)


def test_ids_of_robots_become_short_printable_labels():
    assert [RobotSnapshot(name).label for name in ("/", "/jetbot_01", "/a/b", "/\x1b[31m" + 99 * "x")] == [
        "robot", "jetbot_01", "a/b", "?[31m" + 35 * "x"]


def test_robots_that_come_go_and_hang_are_named_once_in_the_terminal():
    one, two, silent = (Snapshot({name: RobotSnapshot(name, answers=answers) for name in names}) for names, answers in (
        (["/red"], True), (["/red", "/blue"], True), (["/red", "/blue"], False)))
    assert two.changes_since(Snapshot()) == ["on the page: red and blue"]
    assert two.changes_since(two) == []
    assert silent.changes_since(two) == ["not answering: red and blue"]
    assert two.changes_since(silent) == ["answering again: red and blue"]
    assert one.changes_since(two) == ["ended: blue"]


def test_a_result_is_forgotten_when_the_robot_that_was_put_back_is_at_its_start(cockpit):
    cockpit.robots.change("/red", pose=(1.0, 0.0, 0.0), task=DONE)
    cockpit.wait(0.05)
    cockpit.do(TEACHER, Message("reset", "/red"))
    assert cockpit.control.state()["robots"]["/red"]["task"]
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0))
    cockpit.wait(0.05)
    assert cockpit.control.state()["robots"]["/red"]["task"] is None


def test_a_stop_of_all_names_the_robots_that_have_not_confirmed_it(cockpit):
    assert cockpit.control.state()["unconfirmed"] == []
    cockpit.do(TEACHER, Message("stop"))
    assert cockpit.control.state()["unconfirmed"] == ["/red", "/blue"]
    cockpit.robots.change("/red", state=STANDS._replace(holds=("emergency_stop",)))
    cockpit.wait(0.1)
    assert cockpit.control.state()["unconfirmed"] == ["/blue"]
    cockpit.do(TEACHER, Message("release"))
    assert cockpit.control.state()["unconfirmed"] == []
