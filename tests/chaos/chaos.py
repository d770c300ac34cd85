#!/usr/bin/env python3
"""Faults drawn by chance happen to real processes on fake buses, and one invariant must hold.

At every moment, the wheels of each robot stand, or the program that they obey runs, and so does all that could stop
them; monitor.py has the bounds. A stop that is pressed before, during or after the faults arrives and stays. Then what
is missing is restarted, the stop is released, and each robot obeys a new command. No log has a traceback; no process
and no file is left.
"""

import argparse
import os
import random
import re
import sched
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import List, NamedTuple, Optional, Set, Tuple

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "ros"))
from faults import FAULTS  # noqa: E402
from monitor import Monitor, obeyed, runs  # noqa: E402
from world import ALL, COMMANDERS, ROBOTS, Process, Scene  # noqa: E402

STOP_BOUND = 3.7    # s after the end of what pressed a stop: README's longest, without a master, and monitor.SLACK
PAGE_TIMEOUT = 2.0  # s until a person takes the terminal instead of the page
STAYS = 1.0         # s for which a stop is watched without faults
ENDS = 8.0          # s until what is broken, or has lost its parent, has ended
DRIVES = 15.0       # s until a robot obeys a new command
PRIORITY = 5.5      # s after a command of a page, until others count
STARTS = 1.8        # s in which programs start
FAULTS_FOR = 4.5    # s in which faults begin
STOP_UNTIL = 6.0    # s until the stop is pressed
MAX_LINES = 300     # of a log
ROUNDS_PER_SCENE = 5
SCENES_AT_ONCE = 2  # they mostly wait
WAYS = ("terminal", "page")  # to press the emergency stop, and to release it


class Event(NamedTuple):
    """A fault that begins ``at`` s after the start of a round, and lasts for ``lasts`` s, unless it is over at once."""

    at: float
    lasts: float
    fault: str
    target: str
    robot: str
    seed: int


class Plan(NamedTuple):
    """A round, drawn before it begins, so that a seed repeats it. commanders: of each robot; starting: is restarted."""

    commanders: Tuple[str, ...]
    starting: Optional[str]
    events: Tuple[Event, ...]
    stop: Tuple[float, str]  # when it is pressed, and where
    release: str
    recovery: Tuple[str, ...]

    def __str__(self) -> str:
        faults = "; ".join(f"at {event.at:.1f} s for {event.lasts:.1f} s {event.fault} of {event.target} {event.robot}"
                           for event in self.events)
        return (f"{', '.join(self.commanders)}{f'; {self.starting} restarts' if self.starting else ''}; {faults}; "
                f"stop at {self.stop[0]:.1f} s by {self.stop[1]}; release by {self.release}; "
                f"then {', '.join(self.recovery)}")


def draw(names: Tuple[str, ...], chance: random.Random) -> Plan:
    """Draw a round for robots of these names."""
    commanders = {robot: chance.choice(COMMANDERS) for robot in names}
    events = []
    for robot in chance.choices(names, k=chance.randint(1, len(names) + 1)):
        target = chance.choice((*ALL, "controller", "commander", "computer"))  # what turns the wheels, twice
        rows = {name: fault.weight for name, fault in FAULTS.items() if target in fault.targets}
        fault, = chance.choices(list(rows), list(rows.values()))
        events.append(Event(chance.uniform(0, FAULTS_FOR), chance.choice((chance.uniform(0.1, 1.5), 4.0)), fault,
                            commanders[robot] if target == "commander" else target, robot, chance.randrange(1 << 30)))
    return Plan(tuple(commanders.values()), chance.choice((None, None, None, *names)), tuple(events),
                (chance.choice((chance.uniform(0, STOP_UNTIL), STOP_UNTIL)), chance.choice(WAYS)), chance.choice(WAYS),
                tuple(chance.choice(COMMANDERS) for _ in names))


def set_stop(scene: Scene, engaged: bool, way: str, patience: float = PAGE_TIMEOUT) -> Set[str]:
    """Press the emergency stop, or release it; return the robots that confirm it.

    After this many seconds in which not all robots confirm what is pressed on a page, a person takes the terminal.
    """
    if way == "page":
        result = scene.page("stop" if engaged else "release", *scene.names, timeout=patience)
        if result.returncode == 0:
            return set(scene.names)
    result = scene.run("rosrun", "jetbot_tools", "emergency_stop.py", *([] if engaged else ["--release"]))
    return {robot for robot in scene.names for line in result.stdout.splitlines()
            if line.startswith(f"/{robot}/") and "(not confirmed)" not in line}


def press(scene: Scene, monitor: Monitor, way: str) -> Set[str]:
    """Press the emergency stop: all wheels stop in time, and those of robots that confirm it stay stopped."""
    pressed = time.monotonic()
    confirmed = set_stop(scene, True, way)
    bound = time.monotonic() + STOP_BOUND
    for robot in scene.names:
        scene.wait(lambda robot=robot: monitor.stood.get(robot, 0) > pressed,
                   f"{robot} to stop after {way}; confirmed: {confirmed}", max(0.0, bound - time.monotonic()))
        controller = scene.find("controller", robot)
        if robot in confirmed and controller:
            monitor.held[robot] = controller.pid
    return confirmed


def press_and_hear(scene: Scene, monitor: Monitor, way: str) -> None:
    """Press the emergency stop when all faults have ended: no robot that serves may be deaf to it."""
    serving = {robot for robot in scene.names if scene.status(robot) and scene.master_answers()}
    for robot in serving - press(scene, monitor, way):
        scene.wait(lambda robot=robot: not all(runs(scene, kind, robot) for kind in ("launch", "controller")),
                   f"{robot}, which did not confirm a stop, to end", ENDS)


def play_events(scene: Scene, plan: Plan) -> None:
    """Start the commanders, and let the faults happen, until the last one has ended."""
    schedule = sched.scheduler()

    def begin(event):
        target = scene.find(event.target, event.robot)
        if not target and event.target != "computer":
            return
        try:
            end = FAULTS[event.fault].begin(scene, target, random.Random(event.seed))
        except PermissionError as error:
            print(f"   not possible here: {event.fault} ({error})")
        except (FileNotFoundError, ProcessLookupError):
            pass  # it has ended meanwhile
        else:
            schedule.enter(event.lasts, 0, end or (lambda: None))

    if plan.starting:
        schedule.enter(0, 0, scene.launch, [plan.starting])
    for number, robot in enumerate(scene.names):
        schedule.enter(number * STARTS / 3, 1, scene.command, [plan.commanders[number], robot])
    for event in plan.events:
        schedule.enter(event.at, 2, begin, [event])
    schedule.run()


def recover(scene: Scene, monitor: Monitor, plan: Plan) -> None:
    """Restart what is missing, release the stop: each robot obeys a new command."""
    for process in scene.living(*COMMANDERS, "second"):
        process.end()
    scene.wait(lambda: not scene.strays(), f"{scene.strays()} to end", ENDS)
    scene.ensure()
    monitor.held.clear()
    released = set_stop(scene, False, plan.release, patience=ENDS)
    assert released == set(scene.names), f"only {released} confirm the release by {plan.release}"
    assert set_stop(scene, False, "page", patience=ENDS), "no robot's programs go on"
    for robot in scene.names:  # until then, it says that commands do not count
        scene.wait(lambda robot=robot: "no ROS master" not in scene.status(robot), f"{robot} to know the master")
    check_obeyed(scene, [scene.command(kind, robot) for robot, kind in zip(scene.names, plan.recovery)])
    for process in scene.living(*COMMANDERS):
        process.end()


def check_obeyed(scene: Scene, commanders: List[Process]) -> None:
    """Raise AssertionError unless all robots soon obey these; while a person has priority, they are started again."""
    deadline = time.monotonic() + DRIVES
    while commanders and time.monotonic() < deadline:
        commanders = [each for each in commanders if obeyed(scene, each.robot) is not each]
        if any("waits for the cockpit" in scene.status(each.robot) for each in commanders):
            for each in commanders:
                each.end()
            time.sleep(PRIORITY)
            commanders = [scene.command(each.kind, each.robot) for each in commanders]
        time.sleep(0.02)
    assert not commanders, f"{', '.join(map(str, commanders))}: not obeyed for {DRIVES} s"


def check_logs(scene: Scene) -> None:
    """Raise AssertionError if a program of ours has failed without one sentence, or has flooded its log."""
    for process in scene.living("launch", "cockpit", "second"):
        text, name = process.popen.log.read_text(errors="replace"), process.popen.log.name
        for trace in re.findall(r"^Traceback .*?(?=^\[|^---|\Z)", text, re.MULTILINE | re.DOTALL):
            assert "/roslaunch/" in trace, f"{name}:\n{trace}"  # its own are ROS's business
        assert len(re.findall(r"^\[", text, re.MULTILINE)) < MAX_LINES, f"{name} is flooded"


def play(scene: Scene, monitor: Monitor, plan: Plan) -> None:
    """Play one round."""
    scene.ensure()
    with ThreadPoolExecutor() as pool:
        at, way = plan.stop
        pressed = pool.submit(lambda: (time.sleep(at), press(scene, monitor, way)))
        play_events(scene, plan)
        pressed.result()
    monitor.check()
    press_and_hear(scene, monitor, way)
    time.sleep(STAYS)
    recover(scene, monitor, plan)
    check_logs(scene)
    monitor.check()


def play_scene(seed: int, rounds: int, keep: bool) -> bool:
    """Play some rounds with the same processes; return whether all was well. The same seed plays them again."""
    chance, folder = random.Random(seed), Path(tempfile.mkdtemp(prefix="chaos_"))
    scene = Scene(folder, robots=chance.randint(1, len(ROBOTS)))
    monitor, violation = Monitor(scene), ""
    monitor.start()
    try:
        for number in range(1, rounds + 1):
            plan = draw(scene.names, chance)
            print(f"--seed {seed} --rounds {number}: {plan}", flush=True)
            play(scene, monitor, plan)
    except AssertionError as error:
        violation = monitor.violation or str(error)
    finally:
        monitor.end()
        left = scene.close()
    violation = violation or left and f"left: {left}"
    if violation:
        print(f"VIOLATED by --seed {seed} --rounds {number}: {violation}\nlogs in {folder}", flush=True)
    elif not keep:
        shutil.rmtree(folder)
    return not violation


def isolate() -> None:
    """Go on where small disks can be mounted, in namespaces of our own; without, if that is refused."""
    command = ["unshare", "--mount", *(["--map-root-user"] if os.getuid() else []), "--"]
    if "CHAOS_ISOLATED" not in os.environ and subprocess.run([*command, "true"], stderr=-3).returncode == 0:
        os.execvpe(command[0], [*command, sys.executable, *sys.argv], {**os.environ, "CHAOS_ISOLATED": "1"})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--keep", action="store_true", help="keep the logs")
    options = parser.parse_args()
    isolate()
    for signum in (signal.SIGINT, signal.SIGHUP):  # else all that is started ignores them too: in the background, nohup
        signal.signal(signum, signal.default_int_handler)
    scenes = [(options.seed + played // ROUNDS_PER_SCENE, min(ROUNDS_PER_SCENE, options.rounds - played), options.keep)
              for played in range(0, options.rounds, ROUNDS_PER_SCENE)]
    with ThreadPoolExecutor(SCENES_AT_ONCE) as pool:
        playing = [pool.submit(play_scene, *scene) for scene in scenes]
        try:
            results = [scene.result() for scene in playing]
        except KeyboardInterrupt:
            for scene in playing:
                scene.cancel()  # those that have begun are played to their end
            raise
    print(f"{options.rounds} rounds: {results.count(False)} of {len(scenes)} scenes failed")
    sys.exit(not all(results))


if __name__ == "__main__":
    main()
