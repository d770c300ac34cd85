"""What the judge says, a row for each sentence: its code, and its template in English.

Losses are phrases without a full stop. Where words depend on data, each combination has a row: other languages order
words in another way.
"""

from typing import Dict, Iterator, Mapping, Tuple

from jetbot.sentence import Sentence, read_row, row
from jetbot_ros.contract import INTERRUPTIONS
from jetbot_ros.state import CAUSES, ENDED, HOLDS

DIRECTIONS = "left", "right"
OPPOSITE = dict(zip(DIRECTIONS, reversed(DIRECTIONS)))
EXTENTS = {"too_far": "too far", "too_little": "too little"}
ENDS = {"stopped": "stopped", "still_driving": "was still driving"}
WAYS = {"past": "past", "short": "short of"}

Rows = Iterator[Tuple[str, str]]


def _stops() -> Rows:
    """How a drive ended, as seen from the goal."""
    for code, end in ENDS.items():
        for side in DIRECTIONS:
            yield f"{code}_{side}", f"{end} {{across}} cm {side} of the goal"
        for way, where in WAYS.items():
            yield f"{code}_{way}", f"{end} {{ahead}} cm {where} the goal"
            for side in DIRECTIONS:
                yield f"{code}_{way}_{side}", f"{end} {{ahead}} cm {where} the goal and {{across}} cm {side} of it"


def _turns() -> Rows:
    for side, other in OPPOSITE.items():
        yield f"turned_{side}", f"turned to the {side}, and not to the {other}"
        yield f"turned_{side}_corner", f"turned to the {side} at corner {{corner}}, and not to the {other}"
        yield f"pointed_{side}", _of_degrees(f"pointed {{count}} degrees too far to the {side} at the end")
    for code, extent in EXTENTS.items():
        at_corner = f"turned {{count}} degrees {extent} at corner {{corner}}"
        yield f"turned_{code}", _of_degrees(f"turned {{count}} degrees {extent} at the end")
        yield f"turned_{code}_corner", _of_degrees(at_corner)
        yield f"turned_{code}_corner_average", _of_degrees(f"{at_corner}, and {{mean}} degrees on average")
        yield f"turned_{code}_corner_average_1", _of_degrees(f"{at_corner}, and 1 degree on average")


def _lines() -> Rows:
    for side in DIRECTIONS:
        yield f"off_line_{side}", f"was {{mean}} cm off the line on average, {{worst}} cm to the {side} at worst"
    for code, extent in EXTENTS.items():
        on_side = f"drove {{distance}} cm {extent} on side {{side}}"
        yield f"drove_{code}", on_side
        yield f"drove_{code}_average", f"{on_side}, and {{mean}} cm on average"


def _of_degrees(plural: str) -> str:
    singular = plural.replace("{count} degrees", "{count} degree")
    return f"{singular}|{plural}"


SENTENCES: Dict[str, str] = {
    # Losses
    **dict([*_stops(), *_turns(), *_lines()]),
    "off_line": "was {mean} cm off the line on average, {worst} cm at worst",
    "part_missed": "stayed {distance} cm away from a part of the line",
    "stopped_before_corner": "stopped before corner {corner}",
    "drove_on": "drove on for {distance} cm after corner {corner}",
    "squares": "was in {count} square of the floor, and {wanted} are wanted|"
               "was in {count} squares of the floor, and {wanted} are wanted",
    "touched_wall": "touched a wall",
    "touched_wall_twice": "touched a wall twice",
    "touched_wall_often": "touched a wall {times} times",
    "sped_up": "sped up at {acceleration} m/s^2, and {limit} are allowed",
    "braked": "braked at {acceleration} m/s^2, and {limit} are allowed",
    "slow": "took {seconds} s; {ideal} s are enough",
    # A result
    "largest_loss": "Largest loss: {loss} ({count} points).",
    "no_loss": "No loss of more than half a point.",
    # A drive
    "driving": "{seconds} s",
    "not_driven": "The robot did not drive.",
    "not_counted": "The drive does not count.",
    "not_counted_because": "The drive does not count: {reason}.",
    **{f"not_counted_{code}": f"The drive does not count: {phrase}." for code, phrase in INTERRUPTIONS.items()},
    "not_counted_cockpit_ended": "The drive does not count: the cockpit has ended.",
    "not_counted_program_stopped": "The drive does not count: its program was stopped.",
    "moved": "The robot was moved, and not by its wheels, so the drive does not count.",
    "hardly_moved": "The robot hardly moved, so the drive does not count.",
    "put_elsewhere": "The robot was put elsewhere, so the drive does not count.",
    "put_back": "The robot was put back to its start, so the drive does not count.",
    "not_measured": "{seconds} s of the drive were not measured, because the simulator or the judge paused.",
    # What is in its way
    **{f"robot_{cause}": f"The robot is stopped: {CAUSES[cause]}." for cause in (*HOLDS, ENDED)},
    "simulator_silent": "The simulator does not answer.",
    "controller_ended": "The controller has ended.",
    "never_stops": "The robot does not stop. End the program that drives it.",
    "nobody_looks": "No program looks at the camera, with which this task is driven.",
    "reads_closed": "{program} reads {topic}. End it: in this task, programs see with the camera alone.",
    "other_judge": "{judge} judges {robot} already.",
    "no_master": "The ROS master does not answer.",
}


def say(code: str, **arguments: object) -> Sentence:
    """Return the sentence with this code."""
    return row(SENTENCES, code, **arguments)


def not_counted(values: Mapping[str, str], reason: str) -> Sentence:
    """Return that a drive does not count, by what a cockpit reports. values: the code of ``interruption``, and what its
    phrase names; reason: the phrase, which counts where the code is not known.
    """
    known = read_row(SENTENCES, f"not_counted_{values.get('interruption')}", values)
    return known or say("not_counted_because", reason=reason)


def with_average(sentence: Sentence, mean: str) -> Sentence:
    """Return what is said of the worst of several errors, and of their mean."""
    code = f"{sentence.code}_average"
    return say(f"{code}_1" if mean == "1" and f"{code}_1" in SENTENCES else code, mean=mean, **sentence.arguments)
