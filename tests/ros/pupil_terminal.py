"""A terminal as a pupil uses it: type a command, press keys, read what is shown."""

import contextlib
import re
import time
from pathlib import Path
from typing import Callable, Dict, Optional

import pexpect
from lesson_pages import find

from jetbot.wait import wait_until

PROMPT = re.compile(r"\[(\d+)\] pupil\$ $")
PS1 = "[$?] pupil$ "
TYPED = re.compile(r"^[^\n]*pupil\$ [^\n]*\n", re.MULTILINE)
CONTROLS = re.compile(r"\x1b\][^\x07]*\x07|\x1b\[[\d;?]*[a-zA-Z]|\r")
CONTROL_KEYS = {"Ctrl-C": "\x03", "Ctrl-Z": "\x1a"}
TIMEOUT = 120.0       # s for anything to happen; generous, for slow machines
READ_INTERVAL = 0.05  # s
KEY_INTERVAL = 0.1    # s between two keys


class Terminal:
    """A shell that the pupil opens. Its methods raise AssertionError if something else happens, or too late."""

    def __init__(self, folder: Path, environment: Dict[str, str]):
        self._shell = pexpect.spawn("bash", cwd=str(folder), env=environment, dimensions=(50, 300))
        self._raw = b""
        self._box = self._typed = self._seen = 0
        self._wait_until(lambda: self.result is not None, "a prompt")

    def new_box(self) -> None:
        """Drop the output so far."""
        self._box, self._seen = len(self._raw), 0

    def skip_output(self) -> None:
        """Make ``see`` ignore the output so far."""
        self._seen = len(self.output)

    def type(self, line: str) -> None:
        """Type a command as soon as there is a prompt; AssertionError if another one goes on running."""
        if not wait_until(lambda: self.result is not None, TIMEOUT, READ_INTERVAL):
            raise AssertionError(f"something still runs in this terminal\n{self.output}")
        self._typed = len(self._raw)
        self._shell.sendline(line)

    def press(self, keys: str) -> None:
        """Press one of CONTROL_KEYS, which ends what runs, or these keys one after the other."""
        for key in [CONTROL_KEYS[keys]] if keys in CONTROL_KEYS else keys:
            self._shell.send(key)
            time.sleep(KEY_INTERVAL)
        if keys in CONTROL_KEYS:
            self.wait_for_end()

    def see(self, text: str) -> None:
        """Wait until this is shown, after what was seen before."""
        def end():
            return find(text, self.output, self._seen)

        self._wait_until(lambda: end() is not None or self.result is not None, text)
        assert end() is not None, f"showed something else:\n{self.output}"
        self._seen = end()

    def wait_for_end(self) -> int:
        """Wait until the last command has ended, and return its exit code."""
        self._wait_until(lambda: self.result is not None, "the command to end")
        return self.result

    def close(self) -> None:
        try:
            self._shell.close(force=True)
        except pexpect.ExceptionPexpect:  # it is killed, but on a busy computer not gone within 0.1 s
            self._shell.wait()

    @property
    def output(self) -> str:
        """What was shown since the box began, without what was typed."""
        return TYPED.sub("", self._shown(self._box))

    @property
    def result(self) -> Optional[int]:
        """The exit code of the last command; None while it runs."""
        prompt = PROMPT.search(self._shown(self._typed))
        return int(prompt[1]) if prompt else None

    def _wait_until(self, condition: Callable[[], object], what: str):
        assert wait_until(condition, TIMEOUT, READ_INTERVAL), (
            f"waited {TIMEOUT:.0f} s for:\n{what}\n--- and there was:\n{self.output}")

    def _shown(self, since):
        with contextlib.suppress(pexpect.TIMEOUT, pexpect.EOF):
            while True:
                self._raw += self._shell.read_nonblocking(65536, timeout=0)
        return CONTROLS.sub("", self._raw[since:].decode(errors="replace"))
