"""A pupil who does what the lessons say: in a fresh copy of the project, at terminals, with keys."""

import contextlib
import os
import re
import signal
import subprocess
from pathlib import Path
from typing import Dict, List, Sequence

import collected_pictures
import pytest
from lesson_pages import FAILS, FILE, INTERNET, LEAVE, ON_PAGE, PRESS, RUN, SEE, Box, boxes
from pupil_terminal import PS1, TIMEOUT, Terminal

from jetbot.wait import wait_until
from processes import SHUTDOWN_TIMEOUT, free_port
from project_copy import ROOT, clean_environment, copy_project

LESSONS = sorted((ROOT / "docs/lessons").glob("[0-9]*.md"), key=lambda page: int(page.name.partition("_")[0]))
OFFLINE = re.compile(r"Could not resolve|unable to access|unable to look up|timed out")


class Offline(Exception):
    """There is no internet, and the page needs it."""


class Pupil:
    """Has a copy of the project, a home, and a port for the master. home: a folder, made by the caller."""

    def __init__(self, home: Path):
        self._home = home
        self._project = copy_project(home)
        port = free_port()
        (home / ".bashrc").write_text(
            f"PS1='{PS1}'\nbind 'set enable-bracketed-paste off'\nexport ROS_MASTER_URI=http://localhost:{port}\n")
        self._environment = {**clean_environment(home), "TERM": "dumb", "GIT_TERMINAL_PROMPT": "0"}
        self._terminals = {}

    def make_package(self, name: str, *dependencies: str) -> None:
        """Have a package already, as lesson 7 makes it, with what later lessons add to its package.xml."""
        scenarios = self._project / "morbot_ws/src/scenarios"
        subprocess.run(["catkin_create_pkg", name, "rospy", "geometry_msgs"], cwd=scenarios, check=True)
        (scenarios / name / "scripts").mkdir()
        manifest = scenarios / name / "package.xml"
        added = "".join(f"<exec_depend>{each}</exec_depend>" for each in dependencies)
        manifest.write_text(manifest.read_text().replace("</package>", f"{added}</package>"))

    def follow(self, page: Path) -> None:
        """Do what the page asks for; raise AssertionError with the line of the page if something else happens."""
        for box in boxes(page):
            try:
                self._do(box)
            except AssertionError as error:
                raise AssertionError(f"{box.place}: {box.text}{error}") from None
        terminals = self._terminals.values()  # what ends with something else, does so a moment later
        assert wait_until(lambda: all(terminal.result is not None for terminal in terminals), TIMEOUT), (
            f"{page.name} leaves something running")

    def leave(self) -> List[str]:
        """Close the terminals, kill what the pupil left running, and return the command lines of that."""
        for terminal in self._terminals.values():
            terminal.close()
        wait_until(lambda: not processes_of(self._home), SHUTDOWN_TIMEOUT, interval=0.2)
        remaining = processes_of(self._home)
        for pid in remaining:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        return list(remaining.values())

    def _do(self, box):
        if box.how != SEE:
            for terminal in self._terminals.values():
                terminal.skip_output()
        if box.how == FILE:
            (self._project / box.file).write_text(box.text)
        if box.how == ON_PAGE:
            collected_pictures.press(self._home / "jetbot_pictures", box.text)
        for number in box.terminals:
            if number not in self._terminals:
                self._terminals[number] = Terminal(self._project, self._environment)
            if box.how in ACTIONS:
                ACTIONS[box.how](self._terminals[number], box)


def run(terminal: Terminal, box: Box) -> None:
    """Type each line of a box, and check that it ends as the heading announces."""
    terminal.new_box()
    for line in box.text.splitlines():
        terminal.type(line)
        code = terminal.wait_for_end()
        if code and box.how == INTERNET and OFFLINE.search(terminal.output):
            raise Offline(terminal.output)
        assert (code != 0) == (box.how == FAILS), f"ended with {code}\n{terminal.output}"


def leave_running(terminal: Terminal, box: Box) -> None:
    terminal.new_box()
    terminal.type(box.text.strip())


ACTIONS = {RUN: run, FAILS: run, INTERNET: run, LEAVE: leave_running,
           PRESS: lambda terminal, box: terminal.press(box.text.strip()),
           SEE: lambda terminal, box: terminal.see(box.text)}


def follow(pages: Sequence[Path], home: Path, package: str = "") -> None:
    """Let a pupil follow the pages in this folder, and leave nothing running; skip if only the internet fails.

    package: the name of one that the pupil has already, and what it depends on.
    """
    pupil, offline = Pupil(home), []
    if package:
        pupil.make_package(*package.split())
    try:
        for page in pages:
            try:
                pupil.follow(page)
            except Offline as error:
                offline.append(f"{page.name} needs the internet: {error}")
    finally:
        remaining = pupil.leave()
    assert not remaining
    if offline:
        pytest.skip(f"everything else works, but {offline[0]}")


def processes_of(home: Path) -> Dict[int, str]:
    """Return {process id: command line} of all processes whose HOME this is."""
    commands = {}
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if f"HOME={home}\0".encode() in (process / "environ").read_bytes():
                commands[int(process.name)] = (process / "cmdline").read_text().replace("\0", " ")
    return commands
