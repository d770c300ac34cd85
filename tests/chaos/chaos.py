#!/usr/bin/env python3
"""Faults drawn by chance happen to real processes on fake buses, and one invariant must hold.

After every fault, within README's bound, each robot's wheels are off, or the program that it obeys is alive and runs.
A stop that is pressed then stops all, and stays; after release and restart, all drive again; no process is left.
"""

import argparse
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path
from typing import List

sys.path.append(str(Path(__file__).resolve().parents[1] / "ros"))
import faults  # noqa: E402
from world import SPEEDS, Process, Scene  # noqa: E402

BOUND = 3.5        # s: README's longest, without a master, and half a second of this computer's
STOP_BOUND = 4.0   # s for ./morbot stop, from typing to the last wheel
STAYS = 1.5        # s for which a stop is watched
DRIVES = 20.0      # s until a robot drives again
ROUNDS_PER_SCENE = 5
COMMANDERS = ("order", "repeat", "page")


class Violation(AssertionError):
    """The invariant does not hold."""


def obeyed(scene: Scene, robot: str) -> List[Process]:
    """Return the programs whose speed the wheels have, and which run."""
    left, right = scene.wheels(robot)
    return [each for each in scene.living(*COMMANDERS) if each.robot == robot and each.state() != "T"
            and abs(SPEEDS[each.kind] - left) < 0.02 and abs(left - right) < 0.02]


def check_wheels(scene: Scene) -> None:
    """Raise Violation if a robot drives without a living commander; a moment later is soon enough."""
    for robot in scene.names:
        for _ in range(20):
            if scene.wheels(robot) == (0.0, 0.0) or obeyed(scene, robot):
                break
            time.sleep(0.02)
        else:
            raise Violation(f"{robot} drives at {scene.wheels(robot)}, and nobody who runs commands that")


def check_stop(scene: Scene) -> None:
    """Press the emergency stop: all wheels stop in time, and stay."""
    pressed = time.monotonic()
    result = scene.run("rosrun", "jetbot_tools", "emergency_stop.py")
    while any(scene.wheels(robot) != (0.0, 0.0) for robot in scene.names):
        if time.monotonic() - pressed > STOP_BOUND:
            raise Violation(f"a stop did not arrive: {[scene.wheels(robot) for robot in scene.names]}\n{result.stdout}")
        time.sleep(0.02)
    if result.returncode:
        return  # it says itself that not every robot confirms
    end = time.monotonic() + STAYS
    while time.monotonic() < end:
        for robot in scene.names:
            if scene.wheels(robot) != (0.0, 0.0):
                raise Violation(f"{robot} drives again under the emergency stop")
        time.sleep(0.01)


def check_recovery(scene: Scene) -> None:
    """Release the stop, restart what is missing: each robot obeys a new commander."""
    for process in scene.living(*COMMANDERS, "second"):
        process.end()
    scene.ensure()
    released = scene.run("rosrun", "jetbot_tools", "emergency_stop.py", "--release")
    for robot in scene.names:
        commander = scene.command("repeat", robot)
        try:
            scene.wait(lambda robot=robot: obeyed(scene, robot), f"{robot} to drive again; its status is "
                       f"{scene.status(robot)!r}, the release said {released.stdout!r}", DRIVES)
        except AssertionError as error:
            raise Violation(str(error)) from None
        commander.end()


def check_words(scene: Scene) -> None:
    """Raise Violation if a program of ours ended with a traceback."""
    for log in scene.folder.glob("*.log"):
        text = log.read_text(errors="replace")
        if "Traceback" in text and "rosmaster" not in text and log.name.split("_")[1][:-4] in ("launch", "cockpit"):
            raise Violation(f"{log.name}:\n{text[-3000:]}")


def play(scene: Scene, chance: random.Random) -> None:
    """Play one round."""
    scene.ensure()
    for robot in scene.names:
        scene.command(chance.choice(COMMANDERS[:3 if scene.pages else 2]), robot)
    time.sleep(chance.uniform(0.0, 3.0))  # some faults happen while programs start
    ends = []
    for name in chance.sample(sorted(faults.FAULTS), chance.choice((1, 1, 2))):
        targets = [each for each in scene.living() if not faults.FAULTS[name].targets
                   or each.kind in faults.FAULTS[name].targets.split()]
        target = chance.choice(targets)
        print(f"   {name} of {target}", flush=True)
        ends.append(faults.begin(name, scene, target))
        time.sleep(chance.uniform(0.0, 0.5))
    time.sleep(BOUND)
    check_wheels(scene)
    if chance.random() < 0.5:
        check_stop(scene)
        check_wheels(scene)
    for end in ends:
        end()
    check_stop(scene)
    check_recovery(scene)
    check_words(scene)


def run(rounds: int, seed: int, keep: bool) -> int:
    """Play that many rounds; return the exit code."""
    played = 0
    while played < rounds:
        chance = random.Random(seed + played)
        folder = Path(tempfile.mkdtemp(prefix="chaos_"))
        scene = Scene(folder, robots=chance.randint(1, 3), pages=chance.randint(0, 2))
        try:
            for _ in range(min(ROUNDS_PER_SCENE, rounds - played)):
                chance = random.Random(seed + played)
                print(f"round {played + 1}, seed {seed + played}, {len(scene.names)} robots", flush=True)
                play(scene, chance)
                played += 1
        except AssertionError as violation:
            print(f"VIOLATED in round {played + 1} (--seed {seed + played}): {violation}\nlogs in {folder}", flush=True)
            scene.close()
            return 1
        left = scene.close()
        if left:
            print(f"VIOLATED: processes are left after round {played}: {left}")
            return 1
        if not keep:
            shutil.rmtree(folder)
    print(f"{played} passed, 0 failed")
    return 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--keep", action="store_true", help="keep the logs")
    options = parser.parse_args()
    sys.exit(run(options.rounds, options.seed, options.keep))


if __name__ == "__main__":
    main()
