"""How people get to the page: addresses with codes, as text, QR codes and cards, and the browser of this desktop."""

import os
import shutil
import subprocess
from typing import Dict, List, Mapping, NamedTuple, Sequence

from .access import Grant, authority

MARGIN = 2            # modules around a QR code; the standard asks for 4, phones do with 2
HALF_BLOCKS = {"00": "█", "01": "▀", "10": "▄", "11": " "}  # upper and lower module, 1: dark; for a dark terminal
BLACK_ON_WHITE = "\x1b[30;107m", "\x1b[0m"
INVERTED = str.maketrans("█▀▄ ", " ▄▀█")
DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
PROGRAMS = ("xdg-open", "x-www-browser")  # the second one, of Debian, where xdg-utils is not installed


class Card(NamedTuple):
    """What somebody needs to use a grant. url: the page's, with the code after its #, which a browser sends to nobody;
    rows: a QR code's modules, 1: dark; [] without segno."""

    grant: Grant
    url: str
    rows: List[str]

    def message(self) -> Dict[str, object]:
        """Return its row of the message "codes" of the socket; never the cookie."""
        grant = self.grant
        return {"label": grant.label, "role": grant.role, "robot": grant.robot, "code": grant.code, "url": self.url,
                "rows": self.rows}


def make_card(grant: Grant, host: str, port: int) -> Card:
    """Return the card of a grant, for a page that is reached as this host."""
    url = f"http://{authority(host, port)}/#{grant.code}"
    return Card(grant, url, qr_rows(url))


def qr_rows(text: str) -> List[str]:
    """Return the rows of a QR code, a character per module: 1 is dark; nothing where segno is not installed."""
    try:
        import segno  # here: not every distribution has it
    except ImportError:
        return []
    return ["".join(map(str, row)) for row in segno.make(text, error="l", micro=False).matrix_iter(border=MARGIN)]


def text(cards: Sequence[Card], colors: bool = False) -> str:
    """Return the cards, one below the other, to print. colors: print QR codes black on white, by a terminal's codes."""
    return "\n".join(f"{card.grant.label}:\n{card.url}\n{''.join(_lines(card.rows, colors))}" for card in cards)


def _lines(rows: List[str], colors: bool) -> List[str]:
    """Return the lines of a QR code, each with two of its rows."""
    lines = []
    for upper, lower in zip(rows[::2], [*rows[1::2], "0" * len(rows)]):
        blocks = "".join(HALF_BLOCKS[modules] for modules in map("".join, zip(upper, lower)))
        lines.append((blocks.translate(INVERTED).join(BLACK_ON_WHITE) if colors else blocks) + "\n")
    return lines


def open_browser(url: str, environment: Mapping[str, str] = os.environ) -> bool:
    """Open the page in the user's browser; return whether there is a desktop and a program that opens it.

    The browser is no child that Ctrl-C or a closed terminal ends, and none in a terminal: it prints and reads nothing
    here. A desktop that ssh forwards is that of another computer, which reaches this page by a tunnel only.
    """
    if "SSH_CONNECTION" in environment or not any(environment.get(name) for name in DISPLAYS):
        return False
    program = next(filter(None, (shutil.which(name, path=environment.get("PATH")) for name in PROGRAMS)), None)
    if program:
        # The shell ends at once, so that the browser is no child of this process
        subprocess.run(["sh", "-c", '"$0" "$1" &', program, url], env=dict(environment), start_new_session=True,
                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return bool(program)
