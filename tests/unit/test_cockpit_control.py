"""Who drives, stops, takes and puts back which robot, with robots and a clock that are turned by hand."""

import pytest
from cockpit_control import ADA, BOB, DRIVES, OWN, STANDS, STOPPED, TEACHER, FakeRobots

from jetbot_cockpit.notices import say
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


PEOPLE = {"Ada": ADA, "Bob": BOB, "Owner": OWN, "Teacher": TEACHER}
STEPS = {  # what else than people's messages a step may be, by its verb: do it, or return whether it is so
    "s": lambda cockpit, seconds: cockpit.wait(float(seconds)) is not None,
    "frozen": lambda cockpit, seconds: setattr(cockpit, "time", cockpit.time + float(seconds)) is None,
    "stops": lambda cockpit, _: change(cockpit.robots, emergency=True) is None,
    "joins": lambda cockpit, _: change(cockpit.robots, stopped_elsewhere=frozenset([None])) is None,
    "ends": lambda cockpit, _: change(cockpit.robots, emergency=False, stopped_elsewhere=frozenset()) is None,
    "leaves": lambda cockpit, who: cockpit.control.leave(PEOPLE[who].id) is None,
    "drives": lambda cockpit, robot: cockpit.drives(f"/{robot}") == (0.5, 0),
    "stands": lambda cockpit, robot: cockpit.drives(f"/{robot}") == STOPPED,
    "free": lambda cockpit, robot: cockpit.driver(f"/{robot}") is None,
    "waits": lambda cockpit, robot: f"/{robot}" in cockpit.drivers.waiting,
    "stopped": lambda cockpit, robot: is_stopped(cockpit, robot),
    "released": lambda cockpit, robot: not is_stopped(cockpit, robot),
}


def is_stopped(cockpit, robot):
    return cockpit.control.state()["emergency"] if robot == "all" else cockpit.robots.now.robots[f"/{robot}"].stopped


def play(cockpit, steps):
    """Do these steps. Behind a colon is why the cockpit refuses one: the code and the arguments of its notice."""
    for step in steps.split("; "):
        action, _, refusal = step.partition(": ")
        who, verb, *robot = action.split()
        if verb in STEPS:
            assert STEPS[verb](cockpit, who), step
        elif verb == "has":
            assert cockpit.driver(f"/{robot[0]}")["id"] == PEOPLE[who].id, step
        elif verb == "must_lift":
            cockpit.must_lift(PEOPLE[who], f"/{robot[0]}")
        else:
            robot = None if robot == ["all"] else f"/{robot[0]}"
            reply = cockpit.do(PEOPLE[who], Message("drive", robot, 0.5 * (verb == "push")) if verb in ("push", "lift")
                               else Message(verb, robot))
            code, *arguments = refusal.split() or [None]
            of = {"type": "lift", "robot": robot} if verb in ("push", "program") else {"type": "notice"}
            reply = None if reply and reply["type"] == verb else reply  # a program that may run
            assert reply == (code and {**of, **say(code, **dict(each.split("=") for each in arguments)).fields()}), step


PUPILS_STOP = "Bob stop all; all stopped; 0.05 s; Ada release all"
NOT_A_PUPILS = "a stop that is not a pupil's alone is released by a teacher: "
SILENT = "Ada push red: no_command seconds=0.3"
STORIES = {  # while Ada drives red
    "who lets go stops the robot and keeps it for five seconds":
        "Ada lift red; red stands; 4.9 s; Ada has red; 0.15 s; red free",
    "a finger that was silent must lift": f"0.35 s; Ada has red; {SILENT}; Ada must_lift red",
    "a finger that was silent for a second must lift": f"1 s; Ada has red; {SILENT}; Ada must_lift red",
    "a finger that was silent until its robot is free must lift": "5.05 s; red free; Ada must_lift red",
    **{f"what waited in the sockets meanwhile is not driven after {frozen}":
       f"{frozen}; Ada lift red; {10 * '0.001 frozen; Ada push red: interrupted; '}0.4 s; Ada must_lift red"
       for frozen in ("2.5 frozen", "2.5 frozen; 0.05 s")},
    "a switch that fired does not hinder the next driver":
        f"0.35 s; {SILENT}; Teacher take red; Teacher push red; red drives",
    "a closed socket stops its robot at once and frees it": "Ada leaves; red stands; red free; Bob push red",
    "who drives another robot stops the first": "Ada push blue; red stands; red free; blue drives",
    "a robot that there never was is not driven":
        "; ".join(f"Teacher {verb} nobody: ended robot=nobody" for verb in ("push", "take", "stop")),
    "a teacher takes a robot and the finger must lift":
        "Teacher take red; red stands; Teacher has red; Teacher go_on red; Ada must_lift red",
    "a finger that was up when the teacher took drives at once later":
        "Ada lift red; Teacher take red; Teacher go_on red; Ada push red",
    **{f"what a teacher took no pupil's {run} drives until it is given back":
       f"Ada lift red; Teacher take red; Teacher stop red; Teacher release red; 6 s; Ada {run} red: taken robot=red; "
       f"Teacher push red; Teacher go_on red; Ada lift red; Ada {run} red; Ada has red" for run in ("push", "program")},
    "a finger that drove a robot which is put back must lift": "Teacher reset red; Ada must_lift red",
    "a pupil drives after the release of a teacher's stop though programs wait":
        "Teacher stop all; 0.05 s; Teacher release all; Ada must_lift red; red waits; blue waits",
    "a pupil with a robot drives and stops that one only":
        "Owner push red: own_robot_only robot=blue; Owner stop red: teacher_stops_one; "
        "Owner release red: teacher_releases_one; Owner stop blue; red released; blue stopped; Owner release blue; "
        "Owner lift blue; Owner push blue",
    **{f"a stop of {robot} ends the lease and the finger must lift after its release":
       f"Teacher stop {robot}; 0.05 s; red stands; red free; Ada push red: {refusal}; 1 s; Ada push red: {refusal}; "
       f"Teacher release {robot}; Ada must_lift red"
       for robot, refusal in (("all", "all_stopped"), ("red", "stopped robot=red"))},
    "anybody stops all and releases that": f"{PUPILS_STOP}; all released",
    **{NOT_A_PUPILS + stop:
       f"{stop}; 0.05 s; {PUPILS_STOP}: teacher_releases; all stopped; Teacher release all; all released; "
       f"Terminal ends; 0.05 s; {PUPILS_STOP}; all released" for stop in (
           "Teacher stop all", "Ada stop all; Teacher stop all", "Terminal stops", "Ada stop all; Terminal joins")},
    "a pupil's stop that a terminal has released is forgotten":
        "Ada stop all; Terminal ends; 0.05 s; Terminal stops; 0.05 s; Ada release all: teacher_releases",
    "who releases where nothing is stopped is told so": "; ".join(f"{each}: not_stopped" for each in (
        "Ada release all", "Owner release all", "Owner release blue", "Teacher release all", "Teacher release red"))
        + "; red drives",
    "a release of all robots ends no robot's own stop and names it":
        "Teacher stop blue; 0.05 s; Teacher release all: others_stopped robots=blue; blue stopped",
}


@pytest.mark.parametrize("steps", STORIES.values(), ids=STORIES)
def test_who_drives_and_who_stops(driven, steps):
    play(driven, steps)
    assert set(driven.drivers.commands) <= {"/red", "/blue"}


@pytest.mark.parametrize("steps, sentence", [
    ("Ada leaves", "the driver's page was closed, or lost its connection"),
    ("Teacher take red", "a teacher took the robot over"),
    *((steps, "no command came from the driver's page for 0.3 s") for steps in (
        f"0.25 s; 0.06 frozen; {SILENT}", "0.31 frozen; Ada push red: interrupted", "0.35 s"))])
def test_a_judge_learns_who_drives_and_what_interrupted_it(driven, steps, sentence):
    driven.do(ADA, Message("name", name=" Ada "))
    driven.push(ADA)
    assert driven.robots.reports == [("/red", "", None), ("/red", "Ada", None)]
    play(driven, steps)
    assert [str(interruption) for *of, interruption in driven.robots.reports if of == ["/red", "Ada"]][1:] == [sentence]


def test_a_finger_that_lifts_at_the_goal_is_no_interruption(driven):
    driven.lift(ADA)
    driven.wait(1)
    driven.control.leave(ADA.id)
    assert [interruption for _, _, interruption in driven.robots.reports] == [None]


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


def test_a_pupil_takes_and_puts_back_nothing(driven):
    assert driven.do(BOB, Message("take", "/red"))["type"] == "notice"
    assert driven.do(BOB, Message("reset"))["type"] == "notice"
    assert (driven.driver()["id"], driven.robots.were_reset) == (ADA.id, [])


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


@pytest.mark.parametrize("broken", [{"emergency": True}, {"master": False}, {"robots": {}}, {"robots": {
    **FakeRobots().now.robots, "/red": FakeRobots().now.robots["/red"]._replace(answers=False)}}],
    ids=["emergency stop", "master", "robot gone", "robot does not answer"])
def test_what_comes_back_while_a_finger_is_down_does_not_jump_off(driven, broken):
    before = driven.robots.now
    change(driven.robots, **broken)
    driven.wait(0.05)
    assert driven.drives() == STOPPED
    driven.robots.now = before
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


def test_a_stop_of_all_names_the_robots_that_have_not_confirmed_it(cockpit):
    assert cockpit.control.state()["unconfirmed"] == []
    cockpit.do(TEACHER, Message("stop"))
    assert cockpit.control.state()["unconfirmed"] == ["/red", "/blue"]
    cockpit.robots.change("/red", state=STANDS._replace(holds=("emergency_stop",)))
    cockpit.wait(0.1)
    assert cockpit.control.state()["unconfirmed"] == ["/blue"]
    cockpit.do(TEACHER, Message("release"))
    assert cockpit.control.state()["unconfirmed"] == []
