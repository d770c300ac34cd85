"""What happens in the rounds of a scene, drawn before it begins, so that a seed repeats it."""

import random
from typing import FrozenSet, List, NamedTuple, Optional, Tuple

from faults import FAULTS
from world import ALL, COMMANDERS, ROBOTS, Cast

ROUNDS = 5         # of a scene
FAULTS_FOR = 4.5   # s in which faults begin
STOP_UNTIL = 6.0   # s until the stop is pressed
LASTS = (0.1, 1.5)  # s, of most faults
LONG = 4.0         # s, of the others
GENTLE = 0.25      # chance of a robot to start gently
JUDGED = 0.25      # chance of a scene to have a judge
PUPIL = 0.3        # chance that a pupil tries to release the stop
WAYS = ("terminal", "page")  # to press the emergency stop, and to release it
STEPS = ("stop", "cockpit", "release", "command")  # that bystanders may come before
TARGETS = (*ALL, "controller", "commander", "page", "computer", "board", "board", "link", "class", "judge")
PLACES = ("computer", "link", "class", "bystanders")  # are no process


class Event(NamedTuple):
    """A fault that begins ``at`` s after the start of a round, or before a step of it, and lasts for ``lasts`` s.

    number: within its scene. A fault that is over at once, or that stays until the end of the round, has no duration.
    """

    number: int
    at: float
    before: str
    lasts: float
    fault: str
    target: str
    robot: str
    seed: int

    def __str__(self) -> str:
        when = f"before the {self.before}" if self.before else f"at {self.at:.1f} s"
        lasts = "" if FAULTS[self.fault].stays else f" for {self.lasts:.1f} s"
        whose = "" if self.target in PLACES else f" of {self.target} {self.robot}"
        return f"[{self.number}] {when}{lasts} {self.fault}{whose}"


class Plan(NamedTuple):
    """A round. commanders: of each robot; starting: is restarted; stop: when it is pressed, and where."""

    commanders: Tuple[str, ...]
    starting: Optional[str]
    events: Tuple[Event, ...]
    stop: Tuple[float, str]
    pupil: bool
    release: str
    recovery: Tuple[str, ...]

    def only(self, faults: Optional[FrozenSet[int]]) -> "Plan":
        """Return the round with these faults alone, with all if there are none."""
        return self._replace(events=tuple(each for each in self.events if faults is None or each.number in faults))

    def __str__(self) -> str:
        return "; ".join([", ".join(self.commanders), *([f"{self.starting} restarts"] if self.starting else []),
                          *map(str, self.events), f"stop at {self.stop[0]:.1f} s by {self.stop[1]}",
                          *(["a pupil's release"] if self.pupil else []), f"release by {self.release}",
                          f"then {', '.join(self.recovery)}"])


def draw_cast(chance: random.Random) -> Cast:
    names = ROBOTS[:chance.randint(1, len(ROBOTS))]
    return Cast(names, tuple(name for name in names if chance.random() < GENTLE), chance.random() < JUDGED)


def draw_scene(seed: int, rounds: int) -> Tuple[Cast, List[Plan]]:
    """Draw a scene: the same seed draws the same rounds, however many."""
    chance = random.Random(seed)
    cast = draw_cast(chance)
    plans: List[Plan] = []
    for _ in range(rounds):
        plans.append(draw(cast.names, chance, sum(len(plan.events) for plan in plans)))
    return cast, plans


def draw(names: Tuple[str, ...], chance: random.Random, number: int) -> Plan:
    """Draw a round for robots of these names. number: of the last fault before it."""
    commanders, recovery = ({robot: chance.choice(COMMANDERS) for robot in names} for _ in range(2))
    hit = [(robot, chance.choice(TARGETS)) for robot in chance.choices(names, k=chance.randint(2, len(names) + 2))]
    hit += chance.choice(([], [], [(names[0], "bystanders")]))
    events = []
    for robot, target in hit:
        number += 1
        rows = {name: fault.weight for name, fault in FAULTS.items() if target in fault.targets}
        fault, = chance.choices(list(rows), list(rows.values()))
        if target in ("page", "link"):
            commanders[robot] = recovery[robot] = "page"
        before = chance.choice(("", "", *STEPS)) if target == "bystanders" else ""
        target = {"commander": commanders[robot], "board": "controller"}.get(target, target)
        lasts = chance.choice((chance.uniform(*LASTS), LONG))
        events.append(Event(number, chance.uniform(0, FAULTS_FOR), before, lasts, fault, target, robot,
                            chance.randrange(1 << 30)))
    return Plan(tuple(commanders.values()), chance.choice((None, None, None, *names)), tuple(events),
                (chance.choice((chance.uniform(0, STOP_UNTIL), STOP_UNTIL)), chance.choice(WAYS)),
                chance.random() < PUPIL, chance.choice(WAYS), tuple(recovery.values()))
