"""The pupils' names: a teacher gives them, the class keeps them, and who drives is called by them."""

import pytest
from cockpit_control import ADA, OWN, TEACHER, Cockpit

from jetbot_cockpit.session.protocol import Message

pytest_plugins = ["cockpit_control"]  # its fixtures


def call(cockpit, name, robot="/blue", client=TEACHER):
    return cockpit.do(client, Message("pupil", robot, name=name))


def pupils(cockpit):
    return {robot["id"]: robot["pupil"] for robot in cockpit.control.robots()}


def test_a_teacher_names_the_pupil_of_a_robot_and_takes_the_name_away(cockpit):
    assert call(cockpit, " Ömer <b> 🙂 ") is None and pupils(cockpit) == {"/red": "", "/blue": "Ömer <b> 🙂"}
    call(cockpit, "")
    assert pupils(cockpit)["/blue"] == ""


def test_no_pupil_names_a_robots_pupil(cockpit):
    for client in ADA, OWN:
        assert call(cockpit, "Eve", client=client)["text"] == "Only a teacher names the pupils."
    assert pupils(cockpit)["/blue"] == ""


def test_only_a_robot_that_is_there_gets_a_name(cockpit, kept):
    cockpit = Cockpit(folder=kept)
    assert "green has ended" in call(cockpit, "Eve", "/green")["text"]
    cockpit.settle()
    assert not kept.content


def test_who_drives_with_the_code_of_a_robot_is_called_as_the_teacher_says_whatever_is_typed(cockpit):
    call(cockpit, "Ada")
    cockpit.do(OWN, Message("name", name="Batman"))
    cockpit.push(OWN, "/blue")
    assert cockpit.driver("/blue")["name"] == "Ada" and cockpit.robots.reports[-1] == ("/blue", "Ada", None)
    call(cockpit, "")
    cockpit.push(OWN, "/blue")
    assert cockpit.driver("/blue")["name"] == "Batman"


def test_a_teacher_who_drives_a_pupils_robot_is_not_called_by_the_pupils_name(cockpit):
    call(cockpit, "Ada")
    cockpit.push(TEACHER, "/blue")
    assert cockpit.driver("/blue")["name"] == "teacher 3"


def test_a_class_keeps_the_names(kept):
    cockpit = Cockpit(folder=kept)
    call(cockpit, "Ada")
    cockpit.settle()
    assert pupils(Cockpit(folder=kept)) == {"/red": "", "/blue": "Ada"}
    call(cockpit, "")
    cockpit.settle()
    assert kept.content == {"names": {}}, "a name that was taken away is not kept"


@pytest.mark.parametrize("name", [None, 7, ["Ada"], "x" * 21, "a\nb", "a\u202eb", "\ud800"])
def test_a_kept_name_that_is_none_is_left_out(kept, name):
    kept.content["names"] = {"/red": "Ada", "/blue": name}
    assert pupils(Cockpit(folder=kept)) == {"/red": "Ada", "/blue": ""}
