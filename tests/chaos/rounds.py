"""Plays a round: what is started, what happens to it, who presses what. What that leads to is in the history."""

import contextlib
import json
import random
import re
import sched
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Callable, List, Optional, Sequence, Set

from check import AGAIN, DRIVES, ENDS, HEALS, MAX_AGAIN, STOP_BOUND, obeyed
from faults import FAULTS
from history import History, Observer
from link import ISOLATED
from page import HOST
from plan import PLACES, Event, Plan
from process import Process
from world import COMMANDERS, COOKIES, Scene

from jetbot.wait import wait_until
from web_client import page_headers, request

PAGE_TIMEOUT = 2.0   # s until a person takes the terminal instead of the page
STAYS = 1.0          # s for which a stop is watched without faults
OBEYS = DRIVES + MAX_AGAIN * AGAIN + HEALS  # s until what was commanded must be obeyed
FLOODED = 2.5        # s for which pages may not connect after one that has sent too much, as a cut link does
PAGE_PRIORITY = 5.5  # s after a command of a page, until others count
STARTS = 1.8         # s in which programs start
JUDGES = 20.0        # s until a judge has put a robot to the start
BUSY = 0.3           # s for the start of Python, which takes a tenth of that; one of a ROS program, 20 times as long
SAVE_INTERVAL = 0.5  # s
LOOK = 0.02          # s between two looks at a condition
ORDERS = ("order", "port")
MAX_LINES = 300      # of a log
PROGRAM = "c4a05c4a05c4a050"  # the id of a program that is saved again and again


class Round:
    """A round of a scene."""

    def __init__(self, scene: Scene, history: History, observer: Observer, plan: Plan):
        self._scene, self._history, self._observer, self._plan = scene, history, observer, plan
        self._ends: List[Callable[[], None]] = []  # of the faults that stay

    def play(self) -> None:
        """Play it; raise AssertionError for what does not even begin."""
        self._scene.ensure()
        with contextlib.closing(self), ThreadPoolExecutor() as pool, saving(self._scene, self._history):
            at, way = self._plan.stop
            pressed = pool.submit(lambda: (time.sleep(at), self.press(way)))
            self.play_events()
            pressed.result()
            self.before("stop")
            self.press(way, quiet=True)
            if self._plan.pupil:
                self.try_to_release()
            time.sleep(STAYS)
            self.recover()
        self.check_logs()

    def close(self) -> None:
        """End the faults that stay, and those who command."""
        while self._ends:
            self._ends.pop()()
        for process in self._scene.living(*COMMANDERS):
            process.end()

    def play_events(self) -> None:
        """Start the commanders, and let the faults happen, until the last one has ended."""
        schedule, scene = sched.scheduler(), self._scene
        if self._plan.starting:
            schedule.enter(0, 0, scene.launch, [self._plan.starting])
        for number, (robot, kind) in enumerate(zip(scene.names, self._plan.commanders)):
            schedule.enter(number * STARTS / 3, 1, self.command, [kind, robot])
        for event in self._plan.events:
            if not event.before:
                schedule.enter(event.at, 2, self.begin, [event, schedule])
        schedule.run()

    def before(self, step: str) -> None:
        """Let happen what comes before this step."""
        for event in self._plan.events:
            if event.before == step:
                self.begin(event)
                if step == "cockpit":
                    for cockpit in self._scene.living("cockpit"):
                        cockpit.end()

    def begin(self, event: Event, schedule: Optional[sched.scheduler] = None) -> None:
        """Let a fault begin, if what it hits is there; the schedule ends it, unless it stays."""
        scene, fault = self._scene, FAULTS[event.fault]
        target = None if event.target in PLACES else scene.find(event.target, event.robot)
        if not target and event.target not in PLACES:
            return
        self._history.add("fault", number=event.number, fault=event.fault, target=event.target, robot=event.robot,
                          harms=fault.harms)
        end = None
        try:
            end = fault.begin(scene, target, random.Random(event.seed))
        except PermissionError as error:
            print(f"   not possible here: {event.fault} ({error})")
        except (FileNotFoundError, ProcessLookupError, BlockingIOError):
            pass  # it has ended meanwhile, or another fault has it
        if end and fault.stays:
            self._ends.append(end)
        else:
            schedule.enter(event.lasts if end else 0.0, 0, self.end, [event, end])

    def end(self, event: Event, end: Callable) -> None:
        if end:
            end()
        self._history.add("over", number=event.number)

    def command(self, kind: str, robot: str) -> Process:
        process = self._scene.command(kind, robot)
        self._history.add("command", kind=kind, robot=robot, pid=process.pid)
        return process

    def press(self, way: str, quiet: bool = False) -> None:
        """Press the emergency stop. quiet: all faults have ended, and so no robot that serves may be deaf to it."""
        serving = [robot for robot in self._scene.names if quiet and self._scene.status(robot)
                   and self._scene.master_answers()]
        self._history.add("press", way=way)
        confirmed = self.set_stop(True, way)
        self._history.add("pressed", way=way, confirmed=sorted(confirmed), serving=serving)
        wait_until(lambda: not any(any(seen["wheels"]) for seen in self._observer.seen.values()), STOP_BOUND, LOOK)
        for robot in set(serving) - confirmed:
            wait_until(lambda robot=robot: not {"controller", "launch"} <= set(self._observer.seen[robot]["running"]),
                       ENDS, LOOK)

    def set_stop(self, engaged: bool, way: str, patience: float = PAGE_TIMEOUT) -> Set[str]:
        """Press the emergency stop, or release it; return the robots that confirm it.

        After this many seconds in which not all robots confirm what is pressed on a page, a person takes the terminal.
        """
        scene = self._scene
        if way == "page":
            action = "stop" if engaged else "go_on"
            for pause in [0.0] if engaged else [0.0, FLOODED]:  # no terminal says Go on
                time.sleep(pause)
                if scene.page(action, *map("/{}".format, scene.names), timeout=patience).returncode == 0:
                    return set(scene.names)
        result = scene.run("rosrun", "jetbot_tools", "emergency_stop.py", *([] if engaged else ["--release"]))
        confirmed = {robot for robot in scene.names for line in result.stdout.splitlines()
                     if line.startswith(f"/{robot}/") and "(not confirmed)" not in line}
        self._history.add("terminal", answer=result.stdout[-500:])
        if len(confirmed) < len(scene.names):
            self.probe()
        return confirmed

    def probe(self) -> None:
        """Note how late programs are on this computer now, by one that does nothing."""
        start = time.monotonic()
        self._scene.run(sys.executable, "-IS", "-c", "pass")
        took = time.monotonic() - start
        if took > BUSY:
            self._history.add("late", by=round(took / BUSY, 3))

    def try_to_release(self) -> None:
        """Let a pupil release the stop, on a page that waits for an answer."""
        if not ISOLATED:
            print("   not possible here: a pupil (no network of our own)")
        elif self._scene.living("cockpit"):
            result = self._scene.page("release", *map("/{}".format, self._scene.names), timeout=PAGE_TIMEOUT,
                                      who="pupils")
            self._history.add("pupil", released=result.returncode == 0, answer=result.stdout[-200:])

    def recover(self) -> None:
        """Restart what is missing, release the stop: each robot obeys a new command."""
        scene = self._scene
        for process in scene.living(*COMMANDERS, "second"):
            if process.runs():  # else its lid stays closed
                process.end()
        scene.wait(lambda: not scene.strays(), f"{scene.strays()} to end", ENDS)
        self.before("cockpit")
        scene.ensure()
        self.before("release")
        self._history.add("release", way=self._plan.release)
        released = self.set_stop(False, self._plan.release, patience=ENDS)
        self._history.add("released", way=self._plan.release, confirmed=sorted(released))
        self.set_stop(False, "page", patience=ENDS)  # programs go on
        for robot in scene.names:  # until then, it says that commands do not count
            scene.wait(lambda robot=robot: "no ROS master" not in scene.status(robot), f"{robot} to know the master")
        if scene.cast.judged:
            self.judge()
        self.before("command")
        self.drive([self.command(kind, robot) for robot, kind in zip(scene.names, self._plan.recovery)])

    def judge(self) -> None:
        """Ask for the first robot to be judged, again and again until it is."""
        asked_at, ready = time.monotonic(), False
        while not ready and time.monotonic() < asked_at + JUDGES:
            time.sleep(0.5)
            result = self._scene.page("judge", f"/{self._scene.names[0]}", timeout=JUDGES / 2)
            ready = result.returncode == 0
        self._history.add("judge", ready=ready, answer=result.stdout[-200:])

    def drive(self, commanders: Sequence[Process]) -> None:
        """Wait until all robots obey these; while a person has priority, they are started again."""
        scene, deadline, known, started = self._scene, time.monotonic() + OBEYS, set(), {}
        before = {robot: scene.topic(0, f"/{robot}/cmd_vel") for robot in scene.names}
        for each in commanders:
            self._history.add("must obey", kind=each.kind, robot=each.robot)
        while commanders and time.monotonic() < deadline:
            commanders = [each for each in commanders if each.kind not in obeyed(
                self._history.events[0], self._observer.seen[each.robot])]
            for each in commanders:
                if each not in known and each.kind != "page" and (
                        scene.topic(0, f"/{each.robot}/cmd_vel") - before[each.robot]):
                    known.add(each)
                    self._history.add("published", kind=each.kind, robot=each.robot)
                started.setdefault(each, time.monotonic())
            waiting = [each for each in commanders if "waits for the cockpit" in scene.status(each.robot)
                       or each.kind in ORDERS and time.monotonic() > started[each] + PAGE_PRIORITY]  # it is sent once
            for each in waiting:
                each.end()
            if waiting:
                time.sleep(PAGE_PRIORITY)
                again = [self.command(each.kind, each.robot) for each in waiting]
                known.update(again)
                commanders = [each for each in commanders if each not in waiting] + again
            time.sleep(LOOK)

    def check_logs(self) -> None:
        """Note if a program of ours has failed without one sentence, or has flooded its log."""
        for process in self._scene.living("launch", "cockpit", "second"):
            text, name = process.popen.log.read_text(errors="replace"), process.popen.log.name
            traces = re.findall(r"^Traceback .*?(?=^\[|^---|\Z)", text, re.MULTILINE | re.DOTALL)
            for trace in traces:
                if "/roslaunch/" not in trace:  # its own are ROS's business
                    self._history.add("problem", text=f"{name}:\n{trace}")
            if len(re.findall(r"^\[", text, re.MULTILINE)) >= MAX_LINES:
                self._history.add("problem", text=f"{name} is flooded")


@contextlib.contextmanager
def saving(scene: Scene, history: History):
    """Let a pupil save a program again and again; at the end, note which version is kept."""
    def ask(do, **fields):
        body = json.dumps({"do": do, "robot": f"/{scene.names[0]}", "id": PROGRAM, **fields}).encode()
        sent = {**page_headers(scene.page_port, HOST, COOKIES["pupils"]), "Content-Type": "application/json"}
        with contextlib.suppress(OSError, ValueError, IndexError):
            answer = request(scene.page_port, "POST", "/work", sent, body)
            return json.loads(answer.body) if answer.status == 200 else {}
        return {}

    def save():
        version = ask("open").get("version", 0)
        while not ended.wait(SAVE_INTERVAL):
            answer = ask("save", version=version, name="Square", program=json.dumps({"at": time.monotonic()}))
            if answer:
                history.add("saved", version=answer["version"])
            version = (answer or ask("open")).get("version", version)

    ended = threading.Event()
    thread = threading.Thread(target=save)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
    history.add("kept", version=ask("open").get("version", -1))
