"""How a robot is, from what its battery and its computer measure: a sentence for each fact, and what to do about it."""

from typing import Dict, List, Mapping, NamedTuple, Tuple

OK, WARNING, BAD = LEVELS = "ok", "warning", "bad"


class Health(NamedTuple):
    """A fact as data. code: which one, of FACTS; template, arguments: as a Sentence's; level: of LEVELS."""

    code: str
    template: str
    arguments: Mapping[str, str]
    level: str

    def __str__(self) -> str:
        return self.template.format(**self.arguments)


class Limit(NamedTuple):
    """A level that begins at a value, this one included, and what to say from there on."""

    level: str
    value: float
    template: str


class Fact(NamedTuple):
    """value: which reading decides; low: whether low values are the bad ones; limits: the worst one first.

    template: what to say of a value beyond no limit, "" for nothing.
    """

    value: str
    low: bool
    template: str
    limits: Tuple[Limit, ...]


class Range(NamedTuple):
    """What a number may be: its range, and its decimals in a sentence. One outside is not believed."""

    minimum: float
    maximum: float
    decimals: int = 0


READINGS = {
    "volts": Range(0, 26, 1),        # of the battery
    "percent": Range(0, 100),        # its charge, by a straight line between empty and full
    "input_volts": Range(0, 26, 2),  # of a computer that is made for 5 V
    "undervoltage": Range(0, 1),     # 1: the computer reports it
    "celsius": Range(1, 150),        # the hottest processor; Jetson Linux gives -256 for one that is off
    "throttled": Range(0, 1),        # 1: the computer runs slower than it could
    "megabytes": Range(0, 1e9),      # that this user may still write to the disk of his home
    "dbm": Range(-120, -1),          # the signal of the Wi-Fi; a driver that reports a percentage has it above 0
    "power_save": Range(0, 1),       # 1: the Wi-Fi sleeps between packets
}

# Battery: lithium-ion cells hold 3.5 V until a sixth of their charge is left, and then fall fast.
# Input: a Jetson Nano needs 4.75 V (NVIDIA, Jetson Nano Developer Kit User Guide).
# Temperature: a Raspberry Pi slows down from 80 °C on (raspberrypi.com, "Frequency management and thermal control"),
# a Jetson Nano at 97 °C, an Orin at 99 °C (NVIDIA, "Thermal Management" in the Jetson Linux Developer Guide).
# Wi-Fi: below -70 dBm the rate falls, below -80 dBm packets are lost.
FACTS = {
    "battery": Fact("percent", True, "Battery: {volts} V, about {percent} %.", (
        Limit(BAD, 10, "Battery: {volts} V, about {percent} %. It is empty: charge it now."),
        Limit(WARNING, 40, "Battery: {volts} V, about {percent} %. Charge it before the lesson."))),
    "input": Fact("input_volts", True, "Supply of the computer: {input_volts} V.", (
        Limit(WARNING, 4.75, "Supply of the computer: {input_volts} V, which is too low. "
                            "Charge the battery, or use a supply of 5 V and 4 A with a short cable."),)),
    "undervoltage": Fact("undervoltage", False, "", (
        Limit(WARNING, 1, "The supply of the computer is too weak. "
                         "Charge the battery, or use a stronger supply with a short cable."),)),
    "temperature": Fact("celsius", False, "Temperature: {celsius} °C.", (
        Limit(BAD, 95, "Temperature: {celsius} °C. Switch the robot off, and let it cool down."),
        Limit(WARNING, 80, "Temperature: {celsius} °C. Let air reach the computer, and check its fan."))),
    "throttled": Fact("throttled", False, "", (
        Limit(WARNING, 1, "The computer slows itself down, because it is hot or its supply is weak. "
                         "Let it cool down, and charge the battery."),)),
    "disk": Fact("megabytes", True, "Free disk space: {megabytes} MB.", (
        Limit(BAD, 100, "Free disk space: {megabytes} MB. Delete files now: soon nothing can be saved."),
        Limit(WARNING, 500, "Free disk space: {megabytes} MB. Delete files that nobody needs."))),
    "wifi": Fact("dbm", True, "Wi-Fi signal: {dbm} dBm.", (
        Limit(BAD, -80, "Wi-Fi signal: {dbm} dBm, which is too weak to drive. Move the access point closer."),
        Limit(WARNING, -70, "Wi-Fi signal: {dbm} dBm, which is weak. Move the access point closer."))),
    "power_save": Fact("power_save", False, "", (
        Limit(WARNING, 1, "The Wi-Fi saves power, so commands arrive late. "
                         "Switch that off on the robot: sudo iw dev wlan0 set power_save off"),)),
}
TEMPLATES = [template for fact in FACTS.values()
             for template in (fact.template, *(limit.template for limit in fact.limits)) if template]


def judge(readings: Mapping[str, float]) -> List[Health]:
    """Return what there is to say of these readings, which have names of READINGS. One that cannot be is left out."""
    known = {name: value for name, value in readings.items() if believable(name, value)}
    rows = [_judge(code, fact, known) for code, fact in FACTS.items() if fact.value in known]
    return [row for row in rows if row.template]


def believable(name: str, value: float) -> bool:
    """Return whether there is such a reading, and it may have this value."""
    return name in READINGS and READINGS[name].minimum <= value <= READINGS[name].maximum


def _judge(code: str, fact: Fact, readings: Mapping[str, float]) -> Health:
    value = readings[fact.value]
    level, _, template = next(
        (limit for limit in fact.limits if (value <= limit.value if fact.low else value >= limit.value)),
        Limit(OK, value, fact.template))
    return Health(code, template, _texts(readings, template), level)


def _texts(readings: Mapping[str, float], template: str) -> Dict[str, str]:
    """Return the readings that a template names, as it shows them."""
    return {name: f"{value:.{READINGS[name].decimals}f}" for name, value in readings.items()
            if f"{{{name}}}" in template}


def worst(rows: List[Health]) -> str:
    """Return the worst level of these, OK for none."""
    return max((row.level for row in rows), key=LEVELS.index, default=OK)
