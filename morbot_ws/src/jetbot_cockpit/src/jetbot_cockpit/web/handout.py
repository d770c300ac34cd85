"""How people get to the page: addresses with codes, as text, QR codes and cards, and the browser of this desktop."""

import io
import os
import shutil
import subprocess
from typing import Dict, Mapping

from .access import Grant, authority

MARGIN = 2  # modules around a QR code; the standard asks for 4, phones do with 2
WHITE_ON_BLACK, RESET = "\x1b[97;40m", "\x1b[0m"
DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
PROGRAMS = ("xdg-open", "x-www-browser")  # the second one, of Debian, where xdg-utils is not installed


class Card:
    """What somebody needs to use a grant, for a page that is reached as this host.

    url: the page's, with the code after its #, which a browser sends to nobody; the QR code needs segno.
    """

    def __init__(self, grant: Grant, host: str, port: int):
        self.grant, self.url = grant, f"http://{authority(host, port)}/#{grant.code}"
        try:
            import segno  # here: not every distribution has it
            self._qr = segno.make(self.url, error="l", micro=False)
        except ImportError:
            self._qr = None

    def message(self) -> Dict[str, object]:
        """Return its row of the message "codes" of the socket; never the cookie. rows: a QR code's modules, 1: dark."""
        rows = ["".join(map(str, row)) for row in self._qr.matrix_iter(border=MARGIN)] if self._qr else []
        grant = self.grant
        return {"label": grant.label, "role": grant.role, "robot": grant.robot, "code": grant.code, "url": self.url,
                "rows": rows}

    def text(self, colors: bool) -> str:
        """Return it as lines to print. colors: for a terminal, which may be a light one."""
        blocks = io.StringIO()
        if self._qr:
            self._qr.terminal(blocks, border=MARGIN, compact=True)  # white blocks, for a dark terminal
        lines = [line.join((WHITE_ON_BLACK, RESET)) if colors else line for line in blocks.getvalue().splitlines()]
        return "\n".join([f"{self.grant.label}:", self.url, *lines, ""])


def open_browser(url: str, environment: Mapping[str, str] = os.environ) -> bool:
    """Open the page in the user's browser; return whether there is a desktop and a program that opens it.

    The browser is no child that Ctrl-C or a closed terminal ends, and none in a terminal: it prints and reads nothing
    here. A desktop that ssh forwards is that of another computer, which reaches this page by a tunnel only.
    """
    if "SSH_CONNECTION" in environment or not any(environment.get(name) for name in DISPLAYS):
        return False
    program = next(filter(None, (shutil.which(name, path=environment.get("PATH")) for name in PROGRAMS)), None)
    if program:
        # The shell ends at once, so that the browser is no child of this process; its "&" leaves it nothing to read
        subprocess.run(["sh", "-c", '"$0" "$1" &', program, url], env=dict(environment), start_new_session=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return bool(program)
