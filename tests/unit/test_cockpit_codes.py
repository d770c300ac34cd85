"""The codes of a class: each pupil's can be replaced alone, and the class keeps the new one."""

import pytest
from cockpit_control import Kept

from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.web.access import Access, numbered
from jetbot_cockpit.web.codes import Codes

PHONE, NAME = "192.168.1.7", "192.168.1.42"


@pytest.fixture
def classroom():
    return Classroom(Kept())


def codes_of(classroom, robots=2):
    return Codes(classroom, None if robots is None else numbered(robots), lambda: [NAME], 8080)


def test_the_old_code_and_its_cookie_end_and_the_new_one_drives_the_same_robot(classroom):
    codes = codes_of(classroom)
    access, (_, old, _) = Access(8080, [NAME], codes.grants), list(codes.grants)
    assert codes.renew("/jetbot_01") == "jetbot_01"
    new = codes.rows[1]["code"]
    assert access.log_in(old.code, PHONE, None, 0.0) is access.grant(old.cookie, PHONE, NAME) is None
    grant = access.log_in(new, PHONE, None, 0.0)
    assert (grant.role, grant.robot) == ("pupil", "/jetbot_01") and grant == access.grant(grant.cookie, PHONE, NAME)
    assert codes.rows[1]["url"].endswith(f"#{new}")


def test_the_other_codes_are_those_of_before(classroom):
    codes = codes_of(classroom)
    (teacher, _, last), rows = codes.grants, list(codes.rows)
    codes.renew("/jetbot_01")
    assert (codes.grants[0], codes.grants[2], codes.rows[0], codes.rows[2]) == (teacher, last, rows[0], rows[2])


def test_a_class_keeps_the_new_code_and_those_of_more_robots(classroom):
    codes = codes_of(classroom, robots=3)
    codes.renew("/jetbot_01")
    classroom.do(str).result()
    assert codes_of(classroom).grants == codes.grants[:3]
    assert codes_of(classroom, robots=3).grants == codes.grants


@pytest.mark.parametrize("robots, robot, label", [
    (0, None, "pupils"), (0, "/jetbot_01", None), (2, None, None), (2, "/jetbot_09", None), (None, None, None)])
def test_only_a_pupils_code_that_there_is_can_be_replaced(classroom, robots, robot, label):
    codes = codes_of(classroom, robots)
    before = list(codes.grants)
    assert codes.renew(robot) == label and (codes.grants != before) == bool(label)
