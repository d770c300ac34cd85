"""What the terminal shows of the ways to the page, and when: after what the start of the robots prints."""

from typing import List, Optional, Sequence

from .codes import Codes
from .handout import Card

LAST_ROBOT_AFTER = 5.0  # s without another robot: those that are missing do not come
COLUMNS = 4             # of codes in a terminal of 80 characters
NO_NETWORK = ("This computer has no network address: connect it to a network, and the addresses for phones and tablets "
              "appear here.\n")


class Announcement:
    """codes: what others get in by; port: the page's; robots: how many will come."""

    def __init__(self, codes: Codes, port: int, robots: int):
        self._codes, self._port, self._expected = codes, port, robots
        self._seen, self._due = 0, 0.0
        self._shown: Optional[str] = None  # the address on the cards

    def take(self, robots: int, now: float, colors: bool) -> str:
        """Return what to print now, or "". robots: how many there are; now: in s, from any start; colors: see Card."""
        if not self._due or robots > self._seen:
            self._seen, self._due = robots, now + LAST_ROBOT_AFTER
        waits = robots < self._expected and now < self._due
        address = self._codes.cards[0].url if self._codes.cards else ""
        if waits or self._shown == address:
            return ""
        self._shown = address
        here = f"The cockpit, for a browser on this computer: http://localhost:{self._port}/\n"
        return "\n".join([*self._for_others(colors), here])

    def _for_others(self, colors: bool) -> List[str]:
        if not self._codes.cards:
            return [NO_NETWORK] if self._codes.grants else []
        teacher, *pupils = self._codes.cards
        if self._expected:
            return [in_columns(pupils), teacher.text(colors)]
        return [*(card.text(colors) for card in pupils), teacher.text(colors)]


def in_columns(cards: Sequence[Card]) -> str:
    """Return the robots' codes in a few lines: QR codes of a class would fill the terminal."""
    words = [f"{card.grant.label} {card.grant.code}" for card in cards]
    rows = ["   ".join(words[start:start + COLUMNS]) for start in range(0, len(words), COLUMNS)]
    address = cards[0].url.partition("#")[0]
    return "\n".join([f"Pupils open {address} and type the code of a robot (the page shows a QR code of each):",
                      *rows, ""])
