"""What is handed out to a class: addresses with their codes, and QR codes of them, printed and for the page."""

from itertools import zip_longest
from typing import Dict, List, NamedTuple, Sequence

from .access import TEACHER, Grant, authority

WIDTH = 80            # columns of a terminal
MARGIN = 2            # modules around a QR code; the standard asks for 4, phones do with 2
HALF_BLOCKS = {"00": "█", "01": "▀", "10": "▄", "11": " "}  # upper and lower module, 1: dark; for a dark terminal
BLACK_ON_WHITE = "\x1b[30;107m", "\x1b[0m"
BLOCKS_ON_WHITE = str.maketrans("█▀▄ ", " ▄▀█")


class Card(NamedTuple):
    """What somebody needs to use a grant. page: the address; rows: a QR code's modules, 1: dark; [] without segno."""

    grant: Grant
    page: str
    rows: List[str]

    @property
    def url(self) -> str:
        """The address with the code after its #, which a browser sends to nobody."""
        return f"{self.page}#{self.grant.code}"


def make_card(grant: Grant, host: str, port: int) -> Card:
    """Return the card of a grant, for a page that is reached as this host."""
    page = f"http://{authority(host, port)}/"
    card = Card(grant, page, [])
    return card._replace(rows=qr_rows(card.url))


def qr_rows(text: str) -> List[str]:
    """Return the rows of a QR code, a character per module: 1 is dark; nothing where segno is not installed."""
    try:
        import segno  # here: not every distribution has it
    except ImportError:
        return []
    return ["".join(map(str, row)) for row in segno.make(text, error="l", micro=False).matrix_iter(border=MARGIN)]


def message(cards: Sequence[Card]) -> Dict[str, object]:
    """Return the message "codes" of the socket."""
    shown = "label", "role", "robot", "code"  # never the cookie
    return {"type": "codes", "codes": [{**{name: getattr(card.grant, name) for name in shown},
                                        "url": card.url, "rows": card.rows} for card in cards]}


def text(cards: Sequence[Card], colors: bool = False) -> str:
    """Return the teacher's card, and below it all others side by side, to print.

    colors: print QR codes black on white, by a terminal's sequences.
    """
    width = max(len(line) for card in cards for line in [*card.rows, *_words(card)])
    across = max(1, (WIDTH + 2) // (width + 2))
    parts = [[card for card in cards if (card.grant.role == TEACHER) == teachers] for teachers in (True, False)]
    groups = [[_lines(card, width, colors) for card in part[start:start + across]]
              for part in parts for start in range(0, len(part), across)]
    return "\n".join("  ".join(line).rstrip() for group in groups
                     for line in zip_longest(*group, fillvalue=" " * width))


def _words(card: Card) -> List[str]:
    return [f"{card.grant.label}:", card.url]


def _lines(card: Card, width: int, colors: bool) -> List[str]:
    """Return the lines of a card, each of this width on the screen."""
    lines = [line.ljust(width) for line in _words(card)]
    for upper, lower in zip(card.rows[::2], [*card.rows[1::2], "0" * len(card.rows)]):
        blocks = "".join(HALF_BLOCKS[modules] for modules in map("".join, zip(upper, lower)))
        padding = " " * (width - len(blocks))
        if colors:
            blocks = blocks.translate(BLOCKS_ON_WHITE).join(BLACK_ON_WHITE)
        lines.append(blocks + padding)
    return [*lines, " " * width]
