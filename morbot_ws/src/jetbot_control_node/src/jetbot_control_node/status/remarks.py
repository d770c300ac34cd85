"""What a status says of a robot besides why it is stopped: a row for each remark, its code and its template."""

from typing import Sequence

from jetbot.sentence import Sentence, names_in, row

MAX_NAMES = 3  # names of programs that a remark lists
NAMED = "first", "second", "third"

REMARKS = {
    # Who commands it
    "rivals_2": "{count} programs command it: {first} and {second}",
    "rivals_3": "{count} programs command it: {first}, {second} and {third}",
    "rivals_more": "{count} programs command it: {first}, {second} and {more} more",
    "waiting_1": "{first} waits for the cockpit",
    "waiting_2": "{first} and {second} wait for the cockpit",
    "waiting_3": "{first}, {second} and {third} wait for the cockpit",
    "waiting_more": "{first}, {second} and {more} more wait for the cockpit",
    # What it cannot do
    "full_power": "both wheels at full power",
    "max_duty": "both wheels at max_duty",
    "too_slow": "the wheels get less than one step of the board, so they do not turn: raise min_duty",
    "too_slow_closed_loop": "the wheels get less than one step of the board, so they do not turn: command more",
    # What disturbs its board
    "resets": "its board has lost its settings ({count} so far): check the battery and the plugs",
    "overwritten": "another program writes to its board ({count} so far)",
    "faults": "its board keeps failing to answer ({count} so far): check the wires",
    # Its supply
    "dip": "its supply dips from {before} to {after} V as the motors start: set acceleration_limit:=1",
    "dip_limited": "its supply dips from {before} to {after} V as the motors start: "
                   "lower acceleration_limit (now {limit})",
    "undervoltage": "its supply dips as the motors start: set acceleration_limit:=1",
    "undervoltage_limited": "its supply dips as the motors start: lower acceleration_limit (now {limit})",
}


def remark(code: str, **values: object) -> Sentence:
    """Return the remark with this code, and with its arguments among some values."""
    return row(REMARKS, code, **{name: values[name] for name in names_in(REMARKS[code])})


def of_programs(code: str, names: Sequence[str]) -> Sentence:
    """Return a remark of some programs, which lists the first few of many. code: without their number."""
    count = len(names)
    return remark(f"{code}_{count if count <= MAX_NAMES else 'more'}", count=count, more=count - MAX_NAMES + 1,
                  **dict(zip(NAMED, names)))
