#!/usr/bin/env python3
"""Faults drawn by chance happen to real processes on fake buses; what happens is written down, and checked afterwards.

At every moment, the wheels of each robot stand, or the program that they obey runs, and so does all that could stop
them; check.py has the bounds. A stop that is pressed before, during or after the faults arrives and stays. Then what
is missing is restarted, the stop is released, and each robot obeys a new command. No log has a traceback; no process
and no file is left. What is violated is played again with fewer faults, and the command that does so is printed.
"""

import argparse
import itertools
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Callable, FrozenSet, List, NamedTuple, Optional

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "ros"))
from check import report, violations  # noqa: E402
from history import History, Observer  # noqa: E402
from plan import ROUNDS, draw_scene  # noqa: E402
from rounds import Round  # noqa: E402
from world import SPEEDS, Scene  # noqa: E402

SCENES_AT_ONCE = 2  # they mostly wait
_numbers = itertools.count()


class Play(NamedTuple):
    """The rounds ``first`` to ``last`` of a scene, with all faults, or with these alone."""

    seed: int
    last: int
    first: int = 1
    faults: Optional[FrozenSet[int]] = None

    def __str__(self) -> str:
        first = f" --first {self.first}" if self.first > 1 else ""
        faults = "" if self.faults is None else f" --faults {','.join(map(str, sorted(self.faults))) or 'none'}"
        return f"--seed {self.seed} --rounds {self.last}{first}{faults}"


def play(wanted: Play, keep: bool = False, enough: Callable[[], object] = lambda: False) -> Optional[Play]:
    """Play rounds of a scene with the same processes; return those up to the one that violates something, or None.

    enough: whether no other round is to begin.
    """
    folder, (cast, plans) = Path(tempfile.mkdtemp(prefix="chaos_")), draw_scene(wanted.seed, wanted.last)
    scene, history = Scene(folder, cast, next(_numbers)), History(folder / "history")
    history.add("scene", robots=cast.names, gentle=cast.gentle, speeds=SPEEDS)
    observer, played = Observer(scene, history), wanted
    observer.start()
    try:
        for number in range(wanted.first, wanted.last + 1):
            plan, played = plans[number - 1].only(wanted.faults), wanted._replace(last=number)
            print(f"{played}: {plan}", flush=True)
            history.add("round", plan=str(plan))
            Round(scene, history, observer, plan).play()
            history.add("round over")
            if violations(history.events) or enough():
                break
    except AssertionError as error:
        history.add("problem", text=str(error))
    finally:
        observer.end()
        left = scene.close()
    if left:
        history.add("problem", text=f"left: {left}")
    text = report(history.events)
    if text:
        print(f"{text}\nVIOLATED by {played}\nlogs in {folder}, history: {folder}/history", flush=True)
    elif not keep:
        shutil.rmtree(folder)
    return played if text else None


def shrink(found: Play, tries: int) -> Play:
    """Return the smallest of some plays that still violate something: of the last round, then without each fault."""
    plans = draw_scene(found.seed, found.last)[1]
    last = found._replace(first=found.last)
    if last != found and play(last):
        found = last
    kept = frozenset(each.number for plan in plans[found.first - 1:] for each in plan.events)
    kept = kept if found.faults is None else kept & found.faults
    for number in sorted(kept, reverse=True)[:tries - 1]:
        if play(found._replace(faults=kept - {number})):
            kept -= {number}
            found = found._replace(faults=kept)
    return found


def isolate() -> None:
    """Go on where small disks can be mounted and links made, in namespaces of our own; without, if that is refused."""
    command = ["unshare", "--mount", "--net", *(["--map-root-user"] if os.getuid() else []), "--"]
    if "CHAOS_ISOLATED" not in os.environ and subprocess.run([*command, "true"], stderr=-3).returncode == 0:
        os.execvpe(command[0], [*command, sys.executable, *sys.argv], {**os.environ, "CHAOS_ISOLATED": "1"})
    if "CHAOS_ISOLATED" in os.environ:
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)


def play_scenes(options: argparse.Namespace) -> List[Play]:
    """Play all scenes, some at once; return what violates something. Begin no other one after that, if so wanted."""
    scenes = [Play(options.seed + played // ROUNDS, min(ROUNDS, options.rounds - played), options.first, options.faults)
              for played in range(0, options.rounds, ROUNDS)]
    found: List[Play] = []

    def play_one(scene):
        played = None if enough() else play(scene, options.keep, enough)
        found.extend([played] if played else [])

    def enough():
        return found and options.until_violated

    with ThreadPoolExecutor(SCENES_AT_ONCE) as pool:
        playing = [pool.submit(play_one, scene) for scene in scenes]
        try:
            for scene in playing:
                scene.result()
        except KeyboardInterrupt:
            for scene in playing:
                scene.cancel()  # those that have begun are played to their end
            raise
    print(f"{options.rounds} rounds: {len(found)} of {len(scenes)} scenes failed")
    return found


def numbers(text: str) -> FrozenSet[int]:
    return frozenset() if text == "none" else frozenset(map(int, text.split(",")))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--first", type=int, default=1, help="leave the rounds before this one out")
    parser.add_argument("--faults", type=numbers, metavar="N,N,...", help="play these faults alone")
    parser.add_argument("--keep", action="store_true", help="keep logs and history")
    parser.add_argument("--shrink", type=int, default=8, metavar="TRIES", help="to leave out faults")
    parser.add_argument("--until-violated", action="store_true", help="begin no other round after that")
    options = parser.parse_args()
    isolate()
    for signum in (signal.SIGINT, signal.SIGHUP):  # else all that is started ignores them too: in the background, nohup
        signal.signal(signum, signal.default_int_handler)
    found = play_scenes(options)
    for each in found[:1] if options.shrink else ():
        print(f"made smaller: {shrink(each, options.shrink)}", flush=True)
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
