#!/usr/bin/env python3
"""roslaunch for ./morbot run: refuses mistyped words and a silent master, and its last line is what went wrong.

It is roslaunch, in this process: signals, the terminal and the nodes find what they find with roslaunch itself.
"""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while the imports run simply ends it; roslaunch handles it later

import contextlib
import re
import socket
import sys
import threading
from typing import Callable, Iterator, List, Optional
from urllib.parse import urlsplit

from jetbot.text import printable
from jetbot_ros.addresses import is_reachable, master_uri
from jetbot_ros.launch_arguments import UNKNOWN, closest, launch_files, mistake, reachable
from jetbot_ros.roslaunch_command import parse
from jetbot_ros.xmlrpc import NO_ANSWER, proxy

MASTER_TIMEOUT = 5.0  # s for an answer
INTERRUPTED, TERMINATED, NO_READER = (128 + signum for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGPIPE))
FATAL = re.compile(r"^\[rosout\]\[(?:CRITICAL|FATAL)\] \S+ \S+: (.*)", re.M)  # in rospy's log


def misspelled(words: List[str]) -> Optional[str]:
    """Return what is wrong with words that are no name:=value, or None. words: PACKAGE FILE, then what was typed."""
    files = parse(words).files
    if len(files) == 2:
        return None
    text = " ".join(word for word in words[2:] if word in files[2:] or re.match(r"\w*:=$|:=", word))
    meant = re.match(r"(\w+)[\s:=]+(\S+)", text)
    names = {name for each in reachable(launch_files(files[:2])) for name in each.arguments}
    name = meant and closest(meant[1], names)
    advice = f"Did you mean {name}:={meant[2]}?" if name else "An argument is name:=value, such as linear:=0.2"
    return f"morbot: there is no argument {text}. {advice}"


def master_problem(port: str) -> Optional[str]:
    """Return why roslaunch would wait or fail at the ROS master, or None. port: of the option -p, "" without it."""
    uri = f"http://localhost:{port}" if port else master_uri()
    try:
        host = urlsplit(uri).hostname if urlsplit(uri).port else None
    except ValueError:
        host = None
    if not host:
        return f"morbot: ROS_MASTER_URI must look like http://localhost:11311, not {uri}"
    if not is_reachable(uri):
        import rosgraph.network
        return None if rosgraph.network.is_local_address(host) else (
            f"morbot: no ROS master at {uri}. Start roscore on that computer; or to drive on this one: "
            "unset ROS_MASTER_URI")
    try:
        proxy(uri, MASTER_TIMEOUT).getPid("/morbot")
    except socket.timeout:
        return (f"morbot: the ROS master at {uri} does not answer. Is it frozen (Ctrl-Z)? Continue it with fg, "
                "or restart it.")
    except NO_ANSWER:
        return (f"morbot: another program than a ROS master listens at {uri}. End it, or choose another port: "
                "export ROS_MASTER_URI=http://localhost:11399")
    return None


def fatal_line(process) -> Optional[str]:
    """Return what a node logged as its reason to end, or None. process: roslaunch's LocalProcess."""
    log = next((word[len("__log:="):] for word in process.args if word.startswith("__log:=")), "")
    try:
        with open(log, errors="replace") as file:
            lines = FATAL.findall(file.read().rpartition(f"pid[{process.pid}]")[2])  # an earlier start's are before
    except OSError:
        return None
    return lines[-1] if lines else None


@contextlib.contextmanager
def ctrl_c_for_this_process_only() -> Iterator[None]:
    """Ctrl-C ends this process; a command that it runs meanwhile inherits a blocked SIGINT, and prints no traceback."""
    threading.Thread(target=threading.Event().wait, daemon=True).start()  # does not block it
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextlib.contextmanager
def quiet_end(is_interrupted: Callable[[], bool]) -> Iterator[None]:
    """End the process without a traceback if nobody reads its output, or if Ctrl-C comes while the nodes start."""
    try:
        yield
    except BrokenPipeError:
        sys.exit(NO_READER)
    except Exception:
        if is_interrupted():  # then roslaunch misses what it has just ended
            sys.exit(INTERRUPTED)
        raise


def launch(words: List[str]) -> int:
    """Run roslaunch; return its exit code, 1 if a node that must run has failed."""
    import roslaunch.parent
    failures = []

    class Failures(roslaunch.pmon.ProcessListener):
        def __init__(self, monitor):
            self._monitor = monitor

        def process_died(self, name, code):
            process = self._monitor.get_process(name)
            reason = code and fatal_line(process)
            if code and (reason or process.required):
                cause = f"ended with exit code {code}" if code > 0 else f"was killed by signal {-code}"
                failures.append(f"[FATAL] [{name.rpartition('-')[0] or name}]: {reason or cause}")
                self._monitor.shutdown()

    class Parent(roslaunch.parent.ROSLaunchParent):
        def _load_config(self):
            with ctrl_c_for_this_process_only():
                super()._load_config()

        def _start_pm(self):
            super()._start_pm()
            self.pm.add_process_listener(Failures(self.pm))  # before any process starts

        def start(self, *arguments):
            with quiet_end(lambda: roslaunch.pmon._shutting_down):
                super().start(*arguments)

    roslaunch.parent.ROSLaunchParent = Parent
    sys.argv = ["roslaunch", *words]  # roslaunch reads the arguments there
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    print("morbot: the workshop's scenario with a simulated robot; Ctrl-C ends it", flush=True)
    try:
        code = roslaunch.main(sys.argv)
    except SystemExit as end:
        code = end.code
    sys.stdout.flush()
    if failures:
        print(printable(failures[0]), file=sys.stderr)
    return 1 if failures else code or 0


def main(words: List[str]) -> int:
    command = parse(words)
    try:
        problem = misspelled(words)
    except UNKNOWN:  # a broken launch file: roslaunch reports that
        problem = None
    problem = problem or mistake(command.files, command.typed) or master_problem(command.port)
    if problem:
        sys.exit(printable(problem))
    return launch(words)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
