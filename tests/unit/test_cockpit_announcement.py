"""What the cockpit prints of the ways to its page, and when."""

import pytest
from cockpit_control import Kept

from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.web.access import numbered
from jetbot_cockpit.web.announcement import NO_NETWORK, Announcement
from jetbot_cockpit.web.codes import Codes

HERE = "The cockpit, for a browser on this computer: http://localhost:8080/\n"
ADDRESS = "192.168.100.200"


class Ways(Announcement):
    """hosts: this computer's addresses for others, which a test may change."""

    def __init__(self, robots=0, lan=True, hosts=(ADDRESS,)):
        self.codes = Codes(Classroom(Kept()), numbered(robots) if lan else None, lambda: hosts, 8080)
        super().__init__(self.codes, 8080, robots)

    @property
    def cards(self):
        return self.codes.cards


def take(ways, robots=0, now=0.0):
    return ways.take(robots, now, colors=False)


def test_without_others_the_address_for_this_computer_is_printed_once():
    ways = Ways(lan=False)
    assert take(ways) == HERE
    assert take(ways, now=100.0) == ""


def test_the_teachers_address_comes_after_the_pupils_and_this_computers_last():
    ways = Ways()
    teacher, pupils = (text.index(card.url) for text in [take(ways)] for card in ways.cards)
    assert pupils < teacher
    assert take(Ways()).endswith(f"\n{HERE}")


def test_a_class_is_awaited_and_has_a_code_for_each_robot_in_few_lines():
    ways = Ways(robots=15)
    assert take(ways, robots=0, now=10.0) == take(ways, robots=14, now=14.9) == ""
    text = take(ways, robots=15, now=15.0)
    for card in ways.cards[1:]:
        assert f"{card.grant.label} {card.grant.code}" in text
    assert ways.cards[0].url in text and len(text.splitlines()) < 30 and max(map(len, text.splitlines())) < 120


@pytest.mark.parametrize("lan", [True, False])
def test_a_robot_that_does_not_come_delays_no_lesson(lan):
    ways = Ways(robots=2, lan=lan)
    assert take(ways, robots=0, now=10.0) == take(ways, robots=1, now=14.0) == take(ways, robots=1, now=18.9) == ""
    assert take(ways, robots=1, now=19.0).endswith(HERE)


def test_without_a_network_one_sentence_is_printed_and_the_codes_once_there_is_one():
    hosts = []
    ways = Ways(hosts=hosts)
    assert take(ways) == f"{NO_NETWORK}\n{HERE}" and not ways.cards
    ways.codes.make_cards()
    assert take(ways, now=60.0) == ""
    hosts.append(ADDRESS)
    ways.codes.make_cards()
    assert f"http://{ADDRESS}:8080/#" in take(ways, now=61.0) and take(ways, now=62.0) == ""


def test_another_address_of_this_computer_is_printed_and_without_one_the_codes_stay():
    hosts = [ADDRESS]
    ways = Ways(hosts=hosts)
    take(ways)
    for hosts[:] in [], [ADDRESS]:
        ways.codes.make_cards()
        assert take(ways, now=60.0) == "" and ways.cards
    hosts[:] = ["10.0.0.7"]
    ways.codes.make_cards()
    assert "http://10.0.0.7:8080/#" in take(ways, now=61.0)
