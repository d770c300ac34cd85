"""The codes that are handed out: a class keeps them, and each pupil's can be replaced alone."""

from typing import Dict, List, Optional

from ..classroom.classroom import Classroom
from ..session.rights import PUPIL
from .access import Grant, make_grant, make_grants
from .handout import Card


class Codes:
    """robots: how many have a code each, 0: one for all pupils, None: there are no codes; host, port: of the page.

    grants: what the codes give; a new one takes the place of the old one. rows: of the message "codes".
    """

    def __init__(self, classroom: Classroom, robots: Optional[int], host: str, port: int):
        self._classroom, self._host, self._port = classroom, host, port
        self._kept: Dict[str, object] = classroom.read("codes", dict)
        self.grants: List[Grant] = [] if robots is None else make_grants(robots, self._kept)
        self.cards = [Card(grant, host, port) for grant in self.grants]
        self.rows = [card.message() for card in self.cards]
        self._keep()

    def renew(self, robot: Optional[str]) -> Optional[str]:
        """Replace the code for a robot, or for all pupils (None); return its label, or None if there is none."""
        for index, old in enumerate(self.grants):
            if (old.role, old.robot) == (PUPIL, robot):
                self.grants[index] = make_grant(*old[:3])
                self.rows[index] = Card(self.grants[index], self._host, self._port).message()
                self._keep()
                return old.label
        return None

    def _keep(self):
        codes = {**self._kept, **{each.label: [each.code, each.cookie] for each in self.grants}}
        if codes != self._kept:
            self._kept = codes
            self._classroom.keep("codes", codes)
