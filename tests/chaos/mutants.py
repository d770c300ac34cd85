#!/usr/bin/env python3
"""Plants a bug in a rule of safety, and plays chaos until that is found. Arguments: names of MUTANTS, all without.

The file with the bug is mounted over the right one in a namespace of its own: no other program sees it, and nothing is
left. Needs root.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

CHAOS = Path(__file__).resolve().with_name("chaos.py")
PACKAGES = CHAOS.parents[2] / "morbot_ws/src"
DRIVER, NODE = "jetbot/src/jetbot", "jetbot_control_node/src/jetbot_control_node/control"
SESSION = "jetbot_cockpit/src/jetbot_cockpit/session"
MOUNT = 'mount --bind "$0" "$1" && shift && exec "$@"'


class Mutant(NamedTuple):
    """In the file of this path below morbot_ws/src, ``new`` takes the place of ``old``, which occurs there once."""

    path: str
    old: str
    new: str


MUTANTS = {
    "healer off": Mutant(
        "jetbot_ros/src/jetbot_ros/links.py", "for topic, node in self._unconnected():", "for topic, node in ():"),
    "guard deaf": Mutant(
        f"{DRIVER}/guard/process.py", "            stop(board, place)\n            return\n", "            return\n"),
    "loss of the guard unnoticed": Mutant(
        f"{DRIVER}/guard/__init__.py", "return self._up and not self._problem", "return True"),
    "lock of the board gone": Mutant(f"{DRIVER}/connection.py", "lock.bind(name)", "lock.bind(b'')"),
    "board never verified": Mutant(
        f"{DRIVER}/boards/pca9685.py", "if held == sent[block.start:block.stop]:", "if True:"),
    "hold forgotten": Mutant(
        f"{NODE}/watch.py", "SUSPENDED, self._launcher.suspended)", "SUSPENDED, False)"),
    "bound doubled": Mutant(
        f"{NODE}/watch.py", "    self._failures = 2\n        except", "    self._failures += 1\n        except"),
    "standing order never asked": Mutant(
        f"{NODE}/commanders.py", 'return bool(ask(proxy(uri, ANSWER_TIMEOUT), "getPid"))', "return True"),
    "standing order from before obeyed": Mutant(
        f"{NODE}/commanders.py", "old=latched and before and", "old=False and"),
    "stop ignored while the ramp runs": Mutant(
        f"{NODE}/supervisor.py", "self.state = self.state.hold(hold, engaged)",
        "self.state = self.state if engaged and self._ramp and self._ramp.active else self.state.hold(hold, engaged)"),
    "lease never ending": Mutant(
        f"{SESSION}/lease.py", "return now - self.commanded_at >= LEASE_TIMEOUT", "return False"),
    "dead man's switch off": Mutant(
        f"{SESSION}/lease.py", "return self.driving and now - self.commanded_at >= COMMAND_TIMEOUT", "return False"),
    "stop released by a pupil": Mutant(
        f"{SESSION}/stops.py", "if client.role != TEACHER and robot not in self._by_pupils:", "if False:"),
}


def mutate(mutant: Mutant) -> str:
    """Return the file with the bug."""
    text = (PACKAGES / mutant.path).read_text()
    assert text.count(mutant.old) == 1, f"{mutant.path} has this {text.count(mutant.old)} times: {mutant.old}"
    return text.replace(mutant.old, mutant.new)


def play(name: str, rounds: int, seed: int) -> bool:
    """Play until the mutant is found, and print how; return whether it is."""
    with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
        file.write(mutate(MUTANTS[name]))
        file.flush()
        os.chmod(file.name, 0o755)
        start = time.monotonic()
        played = subprocess.run(
            ["unshare", "--mount", "bash", "-c", MOUNT, file.name, str(PACKAGES / MUTANTS[name].path), sys.executable,
             str(CHAOS), "--rounds", str(rounds), "--seed", str(seed), "--shrink", "0", "--until-violated"],
            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}, text=True, stdout=subprocess.PIPE).stdout
    before, found, after = played.partition("\nVIOLATED by ")
    count = len(re.findall("^--seed", before, re.MULTILINE))
    by = f"by {after.splitlines()[0]}: {before.splitlines()[-1]}" if found else "NOT FOUND"
    print(f"{name}: {count} rounds, {time.monotonic() - start:.0f} s, {by}", flush=True)
    return bool(found)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(MUTANTS))
    parser.add_argument("--rounds", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    found = [play(name, options.rounds, options.seed) for name in options.names or MUTANTS]
    sys.exit(not all(found))


if __name__ == "__main__":
    main()
