"""The codes that are handed out: a class keeps them, and each pupil's can be replaced alone."""

from typing import Callable, Dict, List, Optional, Sequence

from ..session.rights import PUPIL
from .access import Grant, make_grant, make_grants
from .handout import Card


class Codes:
    """classroom: what keeps them (classroom.Classroom, or remote.fleet.Fleet).

    robots: the names of those that have a code each; without any, one for all pupils; None: there are no codes.
    hosts: returns by what others reach this computer now, the best first; port: the page's; for_pupils: False for a
    teacher's code alone. grants: what the codes give; a new one takes the place of the old one. cards: to hand out,
    empty as long as others have nowhere to come to.
    """

    def __init__(self, classroom, robots: Optional[Sequence[str]], hosts: Callable[[], Sequence[str]],
                 port: int, for_pupils: bool = True):
        self._classroom, self._hosts, self._port = classroom, hosts, port
        self._kept: Dict[str, object] = classroom.read("codes", dict)
        self.grants: List[Grant] = [] if robots is None else make_grants(robots, self._kept)
        if not for_pupils:
            del self.grants[1:]
        self._host = ""
        self.cards: List[Card] = []
        self._keep()
        self.make_cards()

    def make_cards(self) -> None:
        """Make the cards, as soon as others can reach this computer, and again when they reach it as another host."""
        host = next(iter(self._hosts()), "") if self.grants else ""
        if host and host != self._host:
            self._host = host
            self.cards = [self._card(grant) for grant in self.grants]

    @property
    def rows(self) -> List[Dict[str, object]]:
        """The rows of the message "codes"."""
        return [card.message() for card in self.cards]

    def renew(self, robot: Optional[str]) -> Optional[str]:
        """Replace the code for a robot, or for all pupils (None); return its label, or None if there is none."""
        for index, old in enumerate(self.grants):
            if (old.role, old.robot) == (PUPIL, robot):
                self.grants[index] = make_grant(*old[:3])
                self.cards[index:index + 1] = [self._card(self.grants[index])] if self.cards else []
                self._keep()
                return old.label
        return None

    def _card(self, grant: Grant) -> Card:
        return Card(grant, self._host, self._port)

    def _keep(self):
        codes = {**self._kept, **{each.label: [each.code, each.cookie] for each in self.grants}}
        if codes != self._kept:
            self._kept = codes
            self._classroom.keep("codes", codes)
