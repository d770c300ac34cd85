"""Opens a page in the browser of this computer's desktop."""

import os
import shutil
import subprocess
from typing import Mapping

DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
PROGRAMS = ("xdg-open", "x-www-browser")  # the second one, of Debian, where xdg-utils is not installed


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
