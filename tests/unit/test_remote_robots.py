"""The robots of a hub: their stop reaches those that come back, and no robot passes as another."""

import itertools

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule
from remote_links import FakeLink, FakeRobot, later, make_fleet

from jetbot_class.fleet.classes import strike
from jetbot_cockpit.remote.robots import RemoteRobots
from jetbot_cockpit.session.messages import ROBOT_ROW, ROBOT_STATE

NAMES = "ada", "bob", "cleo"


class Class:
    """Robots of a hub, by name."""

    def __init__(self, folder):
        self.fleet, self.passed, self.found = make_fleet(folder, *NAMES), [], set()
        self.hub = self.new_hub()
        self.robots = {name: FakeRobot(name) for name in NAMES}

    def new_hub(self):
        FakeLink.made = []
        hub = RemoteRobots(self.fleet, lambda robot, message: self.passed.append((robot, message)), FakeLink,
                           lambda: self.found)
        hub.update(later())
        self.links = {link.address.partition(".")[0]: link for link in FakeLink.made}
        return hub

    def connect(self, *names):
        for name in names or NAMES:
            assert self.links[name].connect(self.robots[name])
            self.links[name].report()


@pytest.fixture
def lesson(tmp_path):
    return Class(tmp_path)


def test_a_stop_reaches_all_robots_and_names_those_that_have_not_confirmed_it(lesson):
    lesson.connect()
    lesson.hub.stop_all()
    assert [robot.stopped for robot in lesson.robots.values()] == [True] * 3
    assert lesson.hub.unconfirmed() == ["/ada", "/bob", "/cleo"]
    lesson.links["bob"].report()
    assert lesson.hub.unconfirmed() == ["/ada", "/cleo"]


@pytest.mark.parametrize("state", ["backlogged", "stale", "frozen"])
def test_a_stop_that_is_stuck_in_a_dead_connection_gets_a_new_one(lesson, state):
    lesson.connect()
    setattr(lesson.links["ada"], state, True)
    lesson.hub.stop_all()
    lesson.hub.update(later())
    assert {name: link.reconnects for name, link in lesson.links.items()} == {"ada": 1, "bob": 0, "cleo": 0}
    lesson.links["ada"].connect(lesson.robots["ada"])
    assert lesson.robots["ada"].stopped


def test_a_state_from_before_a_stop_is_neither_its_confirmation_nor_its_release(lesson):
    lesson.connect()
    lesson.hub.stop_all()
    old = [(link, [link.peer.state()]) for link in lesson.links.values()]
    lesson.hub.release_all()
    for link, states in old:
        states.append(link.peer.state())
    lesson.hub.stop_all()
    for link, states in old:
        for state in states:
            link.say(state)
            assert lesson.hub.engaged and lesson.hub.unconfirmed() == ["/ada", "/bob", "/cleo"]


def test_another_hubs_release_of_all_ends_the_stop_here_and_one_at_a_robot_does_not(lesson):
    lesson.connect()
    lesson.hub.stop_all()
    for name in NAMES:
        lesson.links[name].report()
    for count, name in enumerate(NAMES, 1):
        lesson.robots[name].stopped = False
        lesson.links[name].report()
        assert lesson.hub.engaged == (count < 3)


def test_a_release_at_the_only_robot_that_is_there_leaves_the_stop_for_those_that_come_back(lesson):
    lesson.connect("ada")
    lesson.hub.stop_all()
    lesson.links["ada"].report()
    lesson.robots["ada"].stopped = False
    lesson.links["ada"].report()
    assert lesson.hub.unconfirmed() == ["/ada", "/bob", "/cleo"]
    lesson.connect("bob")
    assert lesson.hub.engaged and lesson.robots["bob"].stopped


def test_a_robot_that_comes_back_is_not_shown_as_it_was_before(lesson):
    lesson.connect()
    lesson.hub.stop_all()
    lesson.links["ada"].report()
    for ada in lesson.robots["ada"], FakeRobot("ada", instance="2"):
        lesson.links["ada"].drop()
        assert lesson.links["ada"].connect(ada)
        assert not lesson.hub.states()["/ada"]["answers"]


def test_a_pupils_stop_of_all_at_one_robot_is_that_robots_and_released_from_here(lesson):
    lesson.connect()
    lesson.robots["ada"].stopped = True
    lesson.links["ada"].report()
    assert not lesson.hub.emergency
    assert [state["stopped"] for _, state in sorted(lesson.hub.states().items())] == [True, False, False]
    lesson.hub.release("/ada")
    assert not lesson.robots["ada"].stopped


def test_of_two_robots_with_one_name_the_first_stays_and_the_second_is_named(lesson):
    lesson.connect()
    clone = FakeRobot("ada", instance="2")
    lesson.found.add("192.168.1.9:8080")
    lesson.hub.update(later())
    link = FakeLink.made[-1]
    assert link.connect(clone)
    problem = "Two robots are called ada: ada.test:8080 and 192.168.1.9:8080. Give one another name."
    assert [str(each) for each in lesson.hub.take_problems()] == [problem]
    assert lesson.hub.take_problems() == []
    lesson.hub.stop("/ada")
    assert lesson.robots["ada"].commands and not clone.commands
    assert lesson.hub.link("/ada") is lesson.links["ada"]


def test_a_second_robot_with_a_name_is_stopped_and_released_with_all_and_takes_over_when_it_is_alone(lesson):
    lesson.connect()
    lesson.found.add("192.168.1.9:8080")
    lesson.hub.update(later())
    link, clone = FakeLink.made[-1], FakeRobot("ada", instance="2")
    lesson.hub.stop_all()
    link.connect(clone)
    for name in NAMES:
        lesson.links[name].report()
    assert clone.stopped and lesson.hub.unconfirmed() == ["/ada"]
    link.report()
    assert lesson.hub.unconfirmed() == []
    lesson.hub.release_all()
    assert not clone.stopped
    lesson.hub.stop_all()
    assert clone.stopped
    lesson.links["ada"].drop()
    lesson.hub.update(later())
    link.connect(clone)
    assert lesson.hub.link("/ada") is link


def test_robots_that_were_away_hear_what_the_cameras_switch_is_also_from_the_next_hub(lesson):
    lesson.connect("ada")
    lesson.hub.switch_cameras(False)
    off = {"type": "cameras", "on": False}
    assert off in lesson.robots["ada"].commands
    lesson.connect("bob")
    lesson.hub = lesson.new_hub()
    lesson.connect("cleo")
    assert off in lesson.robots["bob"].commands and off in lesson.robots["cleo"].commands


def test_a_robot_with_a_new_address_replaces_its_dead_connection(lesson):
    lesson.connect()
    lesson.links["ada"].frozen = True
    lesson.found.add("192.168.1.9:8080")
    lesson.hub.update(later())
    assert FakeLink.made[-1].connect(lesson.robots["ada"])
    assert lesson.hub.link("/ada") is FakeLink.made[-1]
    assert not lesson.links["ada"].robot
    lesson.fleet.update()
    assert lesson.fleet.robots[0].authorities == ("ada.test:8080", "192.168.1.9:8080")


def test_robots_that_get_each_others_address_are_both_found(lesson):
    lesson.connect()
    lesson.links["ada"].drop()
    lesson.links["bob"].drop()
    assert lesson.links["bob"].connect(lesson.robots["ada"])
    lesson.hub.update(later())  # ada's old address is still asked, and bob answers there
    assert not lesson.links["ada"].closed
    assert lesson.links["ada"].connect(lesson.robots["bob"])
    assert lesson.hub.link("/bob") is lesson.links["ada"]


def test_a_robot_that_is_found_at_two_addresses_is_no_problem(lesson):
    lesson.connect()
    lesson.found.add("192.168.1.9:8080")
    lesson.hub.update(later())
    assert not FakeLink.made[-1].connect(lesson.robots["ada"])
    assert lesson.hub.take_problems() == []


def test_a_robot_that_is_removed_is_gone_from_a_hub_that_runs(lesson):
    lesson.connect()
    strike(lesson.fleet, "ada")
    lesson.hub.update(later())
    lesson.hub.stop_all()
    assert set(lesson.hub.states()) == {"/bob", "/cleo"} and lesson.hub.unconfirmed() == ["/bob", "/cleo"]
    assert not lesson.links["ada"].robot


def test_a_robot_says_nothing_of_another(lesson):
    lesson.connect()
    forged = {**lesson.robots["bob"].state(), "robots": {"/bob": {"status": "forged"}, "/ada": 7}}
    lesson.links["ada"].say(forged)
    lesson.links["ada"].say({"type": "robots", "robots": [{"id": "/bob", "label": "x"}, 7]})
    assert lesson.hub.states()["/bob"]["status"] == ""
    assert {row["label"] for row in lesson.hub.rows()} == set(NAMES)


def test_a_robot_with_an_older_version_is_shown(lesson):
    lesson.connect()
    message = lesson.robots["ada"].state()
    state = {name: value for name, value in message["robots"]["/ada"].items() if name not in ("link", "health")}
    lesson.links["ada"].say({**message, "robots": {"/ada": {**state, "status": "old"}}})
    assert lesson.hub.states()["/ada"]["status"] == "old"


def test_a_robot_out_of_reach_says_why(lesson):
    lesson.links["ada"].drop()
    state = lesson.hub.states()["/ada"]
    assert (state["answers"], state["status"]) == (False, "No connection to ada.test:8080.")
    assert ROBOT_STATE.accepts(state)
    assert all(map(ROBOT_ROW.accepts, lesson.hub.rows()))


class Stops(RuleBasedStateMachine):
    """Links come and go, robots restart, two hubs stop and release, in any order."""

    def __init__(self):
        super().__init__()
        self.lesson, self.stopped = Class(self.folder / str(next(self.numbers))), False

    @rule(name=st.sampled_from(NAMES))
    def come(self, name):
        link = self.lesson.links[name]
        if not link.robot:
            assert link.connect(self.lesson.robots[name])

    @rule(name=st.sampled_from(NAMES))
    def go(self, name):
        self.lesson.links[name].drop()

    @rule(name=st.sampled_from(NAMES))
    def freeze(self, name):
        self.lesson.links[name].frozen = True

    @rule(name=st.sampled_from(NAMES))
    def restart(self, name):
        self.lesson.links[name].drop()
        self.lesson.robots[name] = FakeRobot(name, instance="2")

    @rule(name=st.sampled_from(NAMES))
    def report(self, name):
        self.lesson.links[name].report()

    @rule()
    def kill(self):
        for link in self.lesson.links.values():
            link.close()
        self.lesson.hub = self.lesson.new_hub()

    @rule()
    def tick(self):
        self.lesson.hub.update(later())

    @rule()
    def stop(self):
        self.lesson.hub.stop_all()
        self.stopped = True

    @rule()
    def release(self):
        self.lesson.hub.release_all()
        self.stopped = False

    @rule(name=st.sampled_from(NAMES))
    def release_one(self, name):
        self.lesson.hub.release(f"/{name}")

    @invariant()
    def each_robot_that_hears_the_hub_is_stopped_with_it(self):
        assert self.lesson.hub.engaged == self.stopped
        for name, link in self.lesson.links.items():
            if self.stopped and link.robot and not link.frozen:
                assert self.lesson.robots[name].stopped, name

    @invariant()
    def no_robot_is_confirmed_that_moves(self):
        confirmed = {f"/{name}" for name in NAMES} - set(self.lesson.hub.unconfirmed())
        for name, link in self.lesson.links.items():
            if self.stopped and f"/{name}" in confirmed:
                assert self.lesson.robots[name].stopped and link.robot


def test_whatever_happens_a_stop_holds(tmp_path_factory):
    Stops.numbers, Stops.folder = itertools.count(), tmp_path_factory.mktemp("stops")
    Stops.TestCase.settings = settings(max_examples=100, stateful_step_count=30, deadline=None, database=None)
    Stops.TestCase().runTest()
