"""The cockpit's parameters: what is refused, in one sentence."""

import pytest

from jetbot import InvalidValue
from jetbot_cockpit.cockpit_parameters import resolve


def test_by_default_only_this_computer_gets_in():
    assert resolve({}) == {"lan": False, "port": 8080, "name": "", "robots": 0,
                           "pictures": "~/jetbot_pictures", "class": "",
                           "classes": "~/.ros/morbot_classes", "identity": "", "browser": False}


@pytest.mark.parametrize("name", ["", "class.test", "192.168.1.42", "fd00::7", "robot-7.local"])
def test_a_name_is_a_host(name):
    assert resolve({"lan": True, "name": name})["name"] == name


@pytest.mark.parametrize("typed", [
    {"port": -1}, {"port": 65536}, {"port": "8080x"}, {"port": 80.5}, {"port": True}, {"port": None},
    {"robots": -1}, {"robots": 100}, {"lan": "yes, please"}, {"lan": 1}, {"browser": True},
    *({"lan": True, "name": name} for name in ("a b", "http://a", "a/b", "robot.local:80", "a:80", 7, "ä", "a\n")),
    {"name": "class.test"}, {"prot": 8080}, {"pictures": "here"}, {"pictures": True},
    {"class": "a b"}, {"class": "../x"}, {"class": 7}, {"classes": "here"}, {"classes": False},
    {"identity": "here"}, {"identity": False}], ids=str)
def test_what_cannot_be_used_is_refused(typed):
    with pytest.raises(InvalidValue):
        resolve(typed)
