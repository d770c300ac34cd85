#!/usr/bin/env python3
"""Reads the history of a scene (history.py), and prints what violated an invariant, and the 5 s before that.

An invariant is a row of INVARIANTS: a function of the events. A new one can be asked of old histories. Pure.
"""

import json
import math
import sys
from pathlib import Path
from typing import Callable, Dict, Iterator, List, NamedTuple, Sequence, Tuple

SLACK = 0.7         # s of this computer's, whose processes compete
STOP_BOUND = 3.0 + SLACK  # s after the end of what pressed a stop: README's longest, without a master
REPAIRS = 2.0 + SLACK     # s in which a controller finds what its board has lost while it is stopped
GUARD_IS_BACK = 10.0      # s after a guard was hit; without one for so long, the controller ends
HEALS = 1.5 + SLACK       # s in which a link that is missing is made
ENDS = 8.0          # s until what is broken has ended
DRIVES = 15.0       # s until a robot obeys a new command, its program's start and the priority of pages included
HINDERS = 15.0      # s after which a page that was seen hinders nobody any more: the ends of its lease and priority
AGAIN, MAX_AGAIN = 10.0, 2  # s more, each time that it is typed again, as a page had priority; at most so often
PAGE_DRIVES = 6.0   # s until it obeys a page: the lease of another one, which is silent, has ended
SHOWN = 5.0         # s before a violation
STANDS = [0.0, 0.0]


class Violation(NamedTuple):
    """What must not be, and when that was clear."""

    at: float
    text: str


class Stretch(NamedTuple):
    """From ``start`` to ``end``, in s, a robot was seen like this."""

    start: float
    end: float
    seen: dict

    @property
    def turning(self) -> bool:
        return self.seen["wheels"] != STANDS


def named(events: Sequence[dict], *names: str) -> List[dict]:
    return [event for event in events if event["event"] in names]


def robots(events: Sequence[dict]) -> List[str]:
    return events[0]["robots"] if events else []


def all_stretches(events: Sequence[dict], robot: str) -> List[Stretch]:
    """Return what was seen of a robot."""
    seen = [event for event in named(events, "seen") if event["robot"] == robot]
    ends = [event["at"] for event in seen[1:]] + [events[-1]["at"]]
    return [Stretch(event["at"], end, event) for event, end in zip(seen, ends)]


def stretches(events: Sequence[dict], robot: str) -> List[Stretch]:
    """Return what was seen of a robot, without the times in which its bus could not be trusted."""
    found = all_stretches(events, robot)
    for start, end in harmed(events, found, robot):
        found = [part for each in found for part in (each._replace(end=min(each.end, start)),
                                                     each._replace(start=max(each.start, end)))
                 if part.start < part.end or part == each]
    return found


def harmed(events: Sequence[dict], seen: List[Stretch], robot: str) -> Iterator[Tuple[float, float]]:
    """Yield from when to when nothing can stop a robot's wheels in time (docs/safety.md, What cannot be promised).

    Its board cannot be reached, or something else has written to it, until a controller has repaired that; or its
    guard was hit, and right after that its controller.
    """
    overs = {event["number"]: event["at"] for event in named(events, "over")}
    for fault in [event for event in named(events, "fault") if event["robot"] == robot]:
        if fault["harms"]:
            yield fault["at"], repaired(seen, overs.get(fault["number"], math.inf))
        if fault["target"] == "guard":
            yield from ((each.start, each.end) for each in seen if 0 < each.end - fault["at"] < GUARD_IS_BACK
                        and each.turning and not {"controller", "guard"}.intersection(each.seen["running"]))


def repaired(seen: List[Stretch], since: float) -> float:
    """Return when a guarded controller has run for REPAIRS s since then; infinity if never."""
    left = REPAIRS
    for each in seen:
        repairing = each.end - max(since, each.start)
        if repairing > 0 and {"controller", "guard"} <= set(each.seen["running"]):
            left -= repairing
            if left <= 0:
                return each.end + left
    return math.inf


def obeyed(scene: dict, seen: dict) -> List[str]:
    """Return the programs that run and whose speed the wheels have; on the way to it where they start gently."""
    (left, right), gentle = seen["wheels"], seen["robot"] in scene["gentle"]
    return [kind for kind in seen["commanders"] if abs(left - right) < 0.02 and (
        abs(left - scene["speeds"][kind]) < 0.02 or gentle and 0 < left < scene["speeds"][kind])]


def late(events: Sequence[dict], start: float, end: float) -> float:
    """Return for how many s this computer was busy meanwhile: each bound allows for that."""
    return sum(event["by"] for event in named(events, "late") if start <= event["at"] <= end)


class Need(NamedTuple):
    """The wheels turn at most this long, in s, while this does not hold: README's and docs/safety.md's bound."""

    seconds: float
    holds: Callable[[dict, dict], object]


def runs(kind: str) -> Callable[[dict, dict], object]:
    return lambda scene, seen: kind in seen["running"]


NEEDS = {
    "a program that runs and commands this": Need(1.5, obeyed),  # 1.2; the guard's if the controller hangs as well
    "a controller": Need(0.3, lambda scene, seen: seen["controller"]),
    "a controller that runs": Need(1.5, runs("controller")),
    "a guard that runs": Need(1.2, runs("guard")),
    "a roslaunch that runs": Need(0.5, runs("launch")),
    "a master that runs": Need(3.0, runs("master")),
}


def needs_are_met(events: Sequence[dict]) -> Iterator[Violation]:
    for robot in robots(events):
        for name, need in NEEDS.items():
            since, last = None, 0.0
            for start, end, seen in stretches(events, robot):
                lacking = seen["wheels"] != STANDS and not need.holds(events[0], seen)
                since = (start if since is None or start > last else since) if lacking else None
                last = end
                if lacking and end - since > need.seconds + SLACK + late(events, since, end):
                    yield Violation(since + need.seconds + SLACK, f"{robot} drives at {seen['wheels']} for more than "
                                    f"{need.seconds + SLACK:.1f} s without {name}")
                    break


def a_stop_arrives(events: Sequence[dict]) -> Iterator[Violation]:
    """All wheels stand at a moment between the press and its bound."""
    press = None
    for event in named(events, "press", "pressed"):
        press = event if event["event"] == "press" else press
        bound = event["at"] + STOP_BOUND + late(events, press["at"], event["at"] + STOP_BOUND)
        for robot in robots(events) if event["event"] == "pressed" and bound < events[-1]["at"] else ():
            seen, trusted = ([each for each in found(events, robot) if each.end >= press["at"] and each.start <= bound]
                             for found in (all_stretches, stretches))
            if seen == trusted and all(each.turning for each in seen):
                yield Violation(bound, f"{robot} does not stop by {event['way']}; confirmed: {event['confirmed']}")


def a_confirmed_stop_holds(events: Sequence[dict]) -> Iterator[Violation]:
    """Between its confirmation of a stop and the release, a controller turns no wheel."""
    ends = [event["at"] for event in named(events, "release")] + [events[-1]["at"]]
    for event in named(events, "pressed"):
        until = min(end for end in ends if end >= event["at"])
        for robot in event["confirmed"]:
            under = [each for each in stretches(events, robot) if each.end > event["at"] and each.start < until]
            for each in under:
                if each.turning and each.start > event["at"] and each.seen["controller"] == under[0].seen["controller"]:
                    yield Violation(each.start, f"{robot} drives at {each.seen['wheels']} under an emergency stop that "
                                    "it has confirmed")
                    break


def answered(events: Sequence[dict], name: str) -> List[dict]:
    """Return the events of this name before which this computer was not busy: else an answer may have come too late."""
    return [event for event in named(events, name) if late(events, event["at"] - SHOWN, event["at"]) < SLACK]


def a_stop_is_heard(events: Sequence[dict]) -> Iterator[Violation]:
    """When all faults are over, a robot that serves confirms a stop, or ends."""
    for event in answered(events, "pressed"):
        for robot in set(event["serving"]) - set(event["confirmed"]):
            after = [each for each in all_stretches(events, robot) if each.end > event["at"]]
            if all({"controller", "launch"} <= set(each.seen["running"]) for each in after):
                yield Violation(event["at"] + ENDS, f"{robot} does not hear a stop by {event['way']}")


def a_release_is_confirmed(events: Sequence[dict]) -> Iterator[Violation]:
    for event in answered(events, "released"):
        if set(event["confirmed"]) != set(robots(events)):
            yield Violation(event["at"], f"only {event['confirmed']} confirm the release by {event['way']}")


def nobody_else_releases(events: Sequence[dict]) -> Iterator[Violation]:
    for event in named(events, "pupil"):
        if event["released"]:
            yield Violation(event["at"], "a pupil has released a teacher's stop")


def a_judge_judges(events: Sequence[dict]) -> Iterator[Violation]:
    for event in answered(events, "judge"):
        if not event["ready"]:
            yield Violation(event["at"], f"the judge does not put a robot to the start: {event['answer']}")


def has_priority(events: Sequence[dict], event: dict) -> bool:
    """Return whether the robot of this event may still wait for a page, also for a silent one until its lease ends."""
    return any("page" in each.seen["commanders"] or "waits for" in each.seen["status"]
               for each in all_stretches(events, event["robot"])
               if each.end > event["at"] - HINDERS and each.start < event["at"] + HEALS)


def typed_again(events: Sequence[dict], event: dict) -> int:
    """Return how often this command was typed again, because a page had priority."""
    return sum(each["at"] > event["at"] and (each["kind"], each["robot"]) == (event["kind"], event["robot"])
               for each in named(events, "command"))


def commands_are_obeyed(events: Sequence[dict]) -> Iterator[Violation]:
    """A robot obeys a program that nothing hinders: soon after its start, at once after the master knows it."""
    for event in named(events, "must obey", "published"):
        within = HEALS if event["event"] == "published" else PAGE_DRIVES if event["kind"] == "page" else (
            DRIVES + AGAIN * min(MAX_AGAIN, typed_again(events, event)))
        bound = event["at"] + within + late(events, event["at"], event["at"] + within)
        seen = [each for each in stretches(events, event["robot"]) if event["at"] <= each.end and each.start <= bound]
        hindered = event["event"] == "published" and (
            any(event["kind"] not in each.seen["commanders"] for each in seen) or has_priority(events, event))
        if bound < events[-1]["at"] and not hindered and not any(
                event["kind"] in obeyed(events[0], each.seen) for each in seen):
            since = "its start" if event["event"] == "must obey" else "the master knows it"
            yield Violation(bound, f"{event['kind']} {event['robot']}: not obeyed for {within:.1f} s after {since}")


def no_old_order_counts(events: Sequence[dict]) -> Iterator[Violation]:
    """A standing order that a controller has obeyed moves no later controller."""
    for robot in robots(events):
        obeyed_by: Dict[int, int] = {}
        for start, _, seen in stretches(events, robot):
            for kind in {"order", "port"}.intersection(obeyed(events[0], seen)):
                first = obeyed_by.setdefault(seen["commanders"][kind], seen["controller"])
                if first != seen["controller"] and robot not in events[0]["gentle"] and seen["controller"]:
                    yield Violation(start, f"{robot}, restarted, obeys an {kind} from before")


def what_is_saved_is_kept(events: Sequence[dict]) -> Iterator[Violation]:
    saved = 0
    for event in named(events, "saved", "kept"):
        if event["event"] == "kept" and event["version"] < saved:
            yield Violation(event["at"], f"version {saved} of a program was saved, and {event['version']} is kept")
        saved = max(saved, event["version"])


def nothing_else_is_wrong(events: Sequence[dict]) -> Iterator[Violation]:
    for event in named(events, "problem"):
        yield Violation(event["at"], event["text"])


INVARIANTS = (needs_are_met, a_stop_arrives, a_confirmed_stop_holds, a_stop_is_heard, a_release_is_confirmed,
              nobody_else_releases, a_judge_judges, commands_are_obeyed, no_old_order_counts, what_is_saved_is_kept,
              nothing_else_is_wrong)


def violations(events: Sequence[dict]) -> List[Violation]:
    """Return all violations, the first one first."""
    return sorted(each for invariant in INVARIANTS for each in invariant(events))


def before(events: Sequence[dict], at: float) -> List[str]:
    """Return the events of the last 5 s before a violation as lines, with the seconds until it."""
    def text(event):
        details = {key: value for key, value in event.items() if key not in ("at", "event")}
        return f"{event['at'] - at:6.2f} s {event['event']}: {json.dumps(details)[1:-1]}"
    return [text(event) for event in events if 0 <= at - event["at"] <= SHOWN]


def report(events: Sequence[dict]) -> str:
    """Return the first violation and what happened before it, "" if there is none."""
    found = violations(events)[:1]
    return "\n".join([*(line for each in found for line in before(events, each.at)), *(each.text for each in found)])


def main() -> None:
    text = report([json.loads(line) for line in Path(sys.argv[1]).read_text().splitlines()])
    print(text or "no violation")
    sys.exit(bool(text))


if __name__ == "__main__":
    main()
