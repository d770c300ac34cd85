"""A pupil who does what the lessons say: in a fresh copy of the project, at terminals, with keys."""

import contextlib
import os
import re
import shutil
import signal
import time
from pathlib import Path

import pexpect
import pytest
from lesson_pages import FAILS, FILE, INTERNET, LEAVE, PRESS, RUN, SEE, boxes, pattern
from ports import free_port

ROOT = Path(__file__).parents[2]
LESSONS = sorted((ROOT / "docs/lessons").glob("[0-9]*.md"))
LEFT_OUT = ("build", "devel", "install", ".git", "__pycache__", "teleop_twist_keyboard", "my_scenario")
WORKSPACE = ("ROS", "CMAKE", "PYTHON", "PKG_CONFIG", "LD_LIBRARY", "JETBOT")  # variables that a sourced one sets
PROMPT = re.compile(r"\[(\d+)\] pupil\$ $")
TYPED = re.compile(r"^[^\n]*pupil\$ [^\n]*\n", re.MULTILINE)
CONTROLS = re.compile(r"\x1b\][^\x07]*\x07|\x1b\[[\d;?]*[a-zA-Z]|\r")
OFFLINE = re.compile(r"Could not resolve|unable to access|unable to look up|timed out")
CONTROL_KEYS = {"Ctrl-C": "\x03", "Ctrl-Z": "\x1a"}
LIMIT = 120.0  # seconds for anything to happen; generous, for slow machines
PAUSE = 0.1   # seconds between two keys


class Offline(Exception):
    """There is no internet, and the page needs it."""


class Terminal:
    """A shell as a pupil opens it."""

    def __init__(self, folder, environment):
        self._shell = pexpect.spawn("bash", cwd=str(folder), env=environment, dimensions=(50, 300))
        self._raw = b""
        self._box = self._typed = self._seen = 0
        self.wait_for(lambda: self.result is not None, "a prompt")

    def new_box(self):
        """Forget what was shown so far."""
        self._box, self._seen = len(self._raw), 0

    def look_away(self):
        """From now on, see only what is new."""
        self._seen = len(self.output)

    def type(self, line):
        """Type a command; AssertionError where one still runs."""
        if self.result is None:
            raise AssertionError(f"something still runs in this terminal\n{self.output}")
        self._typed = len(self._raw)
        self._shell.sendline(line)

    def press(self, key):
        """Press a key, or one of CONTROL_KEYS."""
        self._shell.send(CONTROL_KEYS.get(key, key))
        time.sleep(PAUSE)

    def see(self, text):
        """Wait until this is shown, behind what was seen before."""
        wanted = pattern(text)
        self.wait_for(lambda: wanted.search(self.output, self._seen) or self.result is not None, text)
        found = wanted.search(self.output, self._seen)
        assert found, f"showed something else:\n{self.output}"
        self._seen = found.end()

    def wait_for(self, condition, what):
        deadline = time.monotonic() + LIMIT
        while not condition():
            if time.monotonic() > deadline:
                raise AssertionError(f"waited {LIMIT:.0f} s for:\n{what}\n--- and there was:\n{self.output}")
            time.sleep(0.05)

    def wait_for_end(self):
        """Wait until what was typed last has ended; its exit code."""
        self.wait_for(lambda: self.result is not None, "the command to end")
        return self.result

    @property
    def output(self):
        """What was shown since the box began, without what was typed."""
        return TYPED.sub("", self._shown(self._box))

    @property
    def result(self):
        """The exit code of what was typed last; None while it runs."""
        prompt = PROMPT.search(self._shown(self._typed))
        return int(prompt[1]) if prompt else None

    def _shown(self, since):
        with contextlib.suppress(pexpect.TIMEOUT, pexpect.EOF):
            while True:
                self._raw += self._shell.read_nonblocking(65536, timeout=0)
        return CONTROLS.sub("", self._raw[since:].decode(errors="replace"))

    def close(self):
        self._shell.close(force=True)


class Pupil:
    """Has a copy of the project, a home, and a port for the master. home: a folder, made by the caller."""

    def __init__(self, home):
        self._home = home
        self._project = home / "MorBot"
        shutil.copytree(ROOT, self._project, symlinks=True, ignore=shutil.ignore_patterns(*LEFT_OUT))
        port = free_port()
        (home / ".bashrc").write_text(
            f"PS1='[$?] pupil$ '\nbind 'set enable-bracketed-paste off'\nexport ROS_MASTER_URI=http://localhost:{port}\n"
            f"alias roscore='roscore -p {port}'  # which alone does not heed ROS_MASTER_URI\n")
        self._environment = {name: value for name, value in os.environ.items() if not name.startswith(WORKSPACE)}
        self._environment.update(HOME=str(home), TERM="dumb", GIT_TERMINAL_PROMPT="0")
        self._terminals = {}

    def follow(self, page):
        """Do what the page says; AssertionError, with the line of the page, where something else happens."""
        for box in boxes(page):
            try:
                self._do(box)
            except AssertionError as error:
                raise AssertionError(f"{box.place}: {box.text}{error}") from None
        running = [number for number, terminal in self._terminals.items() if terminal.result is None]
        assert not running, f"{page.name} leaves something running in the terminals {running}"

    def _do(self, box):
        if box.how != SEE:
            for terminal in self._terminals.values():
                terminal.look_away()
        DO[box.how](self, box)

    def _terminal(self, number):
        if number not in self._terminals:
            self._terminals[number] = Terminal(self._project, self._environment)
        return self._terminals[number]

    def _at(self, box):
        return [self._terminal(number) for number in box.terminals]

    def _results(self, box):
        """Type the lines of a box; the exit code of each."""
        for terminal in self._at(box):
            terminal.new_box()
            for line in box.text.splitlines():
                terminal.type(line)
                yield terminal.wait_for_end()

    def _run(self, box):
        for result in self._results(box):
            assert result == 0, f"ended with {result}\n{self._at(box)[0].output}"

    def _run_in_vain(self, box):
        assert all(self._results(box)), "did not fail"

    def _run_with_internet(self, box):
        if any(self._results(box)):
            output = self._at(box)[0].output
            raise Offline(output) if OFFLINE.search(output) else AssertionError(output)

    def _leave_running(self, box):
        for terminal in self._at(box):
            terminal.new_box()
            terminal.type(box.text.strip())

    def _press(self, box):
        for terminal in self._at(box):
            keys = box.text.strip()
            for key in [keys] if keys in CONTROL_KEYS else keys:
                terminal.press(key)
            if keys in CONTROL_KEYS:
                terminal.wait_for_end()

    def _see(self, box):
        for terminal in self._at(box):
            terminal.see(box.text)

    def _write(self, box):
        (self._project / box.file).write_text(box.text)

    def leave(self):
        """Close the terminals, and end what the pupil left running; the command lines of that."""
        for terminal in self._terminals.values():
            terminal.close()
        left = processes_of(self._home)
        for pid in left:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        return list(left.values())


def follow(pages, home):
    """Let a pupil follow the pages in this folder, and leave nothing running; skip where only the internet fails."""
    pupil, offline, left = Pupil(home), [], None
    try:
        for page in pages:
            try:
                pupil.follow(page)
            except Offline as error:
                offline.append(f"{page.name} needs the internet: {error}")
    finally:
        left = pupil.leave()
    assert not left
    if offline:
        pytest.skip(f"all else is well, but {offline[0]}")


DO = {RUN: Pupil._run, FAILS: Pupil._run_in_vain, INTERNET: Pupil._run_with_internet, LEAVE: Pupil._leave_running,
      PRESS: Pupil._press, SEE: Pupil._see, FILE: Pupil._write}


def processes_of(home):
    """Process id: command line of all whose HOME this is."""
    found = {}
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if f"HOME={home}\0".encode() in (process / "environ").read_bytes():
                found[int(process.name)] = (process / "cmdline").read_text().replace("\0", " ")
    return found
