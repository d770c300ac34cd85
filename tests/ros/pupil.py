"""A pupil who does what the lessons say: in a fresh copy of the project, at terminals, with keys."""

import contextlib
import os
import re
import signal
import subprocess
from pathlib import Path
from typing import Dict, List

import collected_pictures
from lesson_pages import FAILS, FILE, INTERNET, LEAVE, ON_PAGE, PRESS, RUN, SEE, Box, boxes
from pupil_terminal import PS1, TIMEOUT, Terminal

from jetbot.wait import wait_until
from processes import SHUTDOWN_TIMEOUT, free_port
from project_copy import ROOT, clean_environment, copy_built_project

LESSONS = sorted((ROOT / "docs/lessons").glob("[0-9]*.md"), key=lambda page: int(page.name.partition("_")[0]))
ABOUT_FILES = ("cd ", "mkdir ", "chmod ", "sed ", "catkin_create_pkg ")
OPEN = "./morbot shell\n"  # opens a terminal
ROAM = {"seconds=60.0": "seconds=20.0", "SQUARES = 30 ": "SQUARES = 10 "}  # 40 s less of pictures: 11 s of CPU time
OFFLINE = re.compile(r"Could not resolve|unable to access|unable to look up|timed out")


class Offline(Exception):
    """There is no internet, and the page needs it."""


class Pupil:
    """Has a built copy of the project, a home, and a port for the master. home: a folder, made by the caller."""

    def __init__(self, home: Path):
        self._home = home
        self._project = copy_built_project(home)
        tasks = self._project / "morbot_ws/src/driving_tasks/src/driving_tasks/scoring/tasks.py"
        for text, shorter in ROAM.items():
            assert text in tasks.read_text()
            tasks.write_text(tasks.read_text().replace(text, shorter))
        port = free_port()
        (home / ".bashrc").write_text(
            f"PS1='{PS1}'\nbind 'set enable-bracketed-paste off'\nexport ROS_MASTER_URI=http://localhost:{port}\n")
        self._environment = {**clean_environment(home), "TERM": "dumb", "GIT_TERMINAL_PROMPT": "0"}
        self._terminals = {}

    def prepare(self, page: Path) -> None:
        """Have what the lessons before this page leave, unless they were followed: their files, and open terminals."""
        if self._terminals or page == LESSONS[0]:
            return
        earlier = LESSONS[:LESSONS.index(page)] if page in LESSONS else []
        for box in (box for lesson in earlier for box in boxes(lesson)):
            if box.how == FILE:
                self._do(box)
            elif box.how == RUN:
                lines = [line for line in box.text.splitlines() if line.startswith(ABOUT_FILES)]
                subprocess.run("\n".join(lines), shell=True, cwd=self._project)
        for box in boxes(LESSONS[0]):
            if box.text == OPEN:
                self._do(box)

    def follow(self, page: Path) -> None:
        """Do what the page asks for; raise AssertionError with the line of the page if something else happens."""
        for box in list(boxes(page)):
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
        self._terminals.clear()
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


def processes_of(home: Path) -> Dict[int, str]:
    """Return {process id: command line} of all processes whose HOME this is."""
    commands = {}
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if f"HOME={home}\0".encode() in (process / "environ").read_bytes():
                commands[int(process.name)] = (process / "cmdline").read_text().replace("\0", " ")
    return commands
