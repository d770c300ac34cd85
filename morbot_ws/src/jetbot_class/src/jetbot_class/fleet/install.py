"""How a robot gets a version: built beside the one that runs, then switched to, and back if it does not run."""

from pathlib import Path
from typing import Callable, List

from jetbot_cockpit.remote.fleet import Entry, Fleet

from .asking import Answer, ask
from .ssh import Failed, Ssh

ROOT = Path(__file__).resolve().parents[6]
RUNS_WITHIN = 60.0  # s, until the new version has to answer: a Raspberry Pi 3 needs 40


def set_up(fleet: Fleet, entry: Entry, commit: str, arguments: List[str], listed: Callable[[], None]) -> None:
    """Install MorBot on a robot, and name it. arguments: of ./morbot robot there; listed: is called when it is named.

    Raise Failed.
    """
    with Ssh(entry.login, fleet.path.parent) as robot:
        robot.push(ROOT, commit)
        robot.run("build", commit)
        robot.run("save_key", stdin=fleet.key_of(entry.name).encode())
        robot.run("name", commit, entry.name, fleet.name, *arguments)
    listed()
    if not runs(fleet, entry, commit):
        raise Failed(f"{entry.name} is set up, but does not answer at {entry.authority} yet: ./morbot fleet log "
                     f"{entry.name}")


def update(fleet: Fleet, entry: Entry, commit: str, force: bool = False, within: float = RUNS_WITHIN) -> None:
    """Let a robot run a version; if that does not answer within so many s, what ran before runs again. Raise Failed."""
    if not entry.login:
        raise Failed(f"it is only listed: ./morbot fleet add HOST --name {entry.name}")
    check_free(fleet, entry, force)
    with Ssh(entry.ssh, fleet.path.parent) as robot:
        robot.push(ROOT, commit)
        robot.run("build", commit)
        robot.run("check", commit)
        before = check_free(fleet, entry, force)  # building takes minutes
        robot.run("switch", commit, before.version)
        if not runs(fleet, entry, commit, within):
            robot.run("back")
            if runs(fleet, entry, commit, within, other=True):
                raise Failed(f"it did not answer within {within:g} s with the new version, and runs the old one again")
            raise Failed(f"it did not answer within {within:g} s with the new version, nor with the old one: "
                         f"./morbot fleet log {entry.name}")
        robot.run("tidy")


def check_free(fleet: Fleet, entry: Entry, force: bool) -> Answer:
    """Return what the robot says. Raise Failed if somebody drives it."""
    answer = ask(fleet, [entry], until=Answer.is_well)[0]
    if answer.driver() and not force:
        raise Failed(f"{answer.driver()} drives it: update it later, or with --force")
    return answer


def runs(fleet: Fleet, entry: Entry, commit: str, within: float = RUNS_WITHIN, other: bool = False) -> bool:
    """Return whether the robot answers with this version, or with an ``other`` one, within so many s."""
    def until(answer: Answer) -> bool:
        return answer.is_well() and (answer.version != commit) == other
    return until(ask(fleet, [entry], within, until)[0])
