"""What a cockpit or a hub sends to a page, for a class that only the page knows."""

from jetbot.health import judge

BEN = {"id": 99, "name": "Ben"}
LONG = "stopped: " + "a reason that nobody has ever shortened, " * 7
TASK = {"name": "metre", "title": "One metre", "state": "ready", "text": "", "seconds": 0.0, "score": None,
        "sentences": [], "lost": None}
DONE = {**TASK, "state": "done", "text": f"[{LONG}]", "seconds": 3.9, "score": 87.3}
BEST = {"type": "scores", "scores": [
    {"task": "One metre", "robot": robot, "score": 87.3, "seconds": seconds, "name": "Ada"}
    for robot, seconds in (("jetbot_01", 3.4), ("jetbot_02", None))]}
TASKS = {"type": "tasks", "tasks": [{"name": "metre", "title": "One metre", "on": True}]}

# Fifteen real robots, as a page gets them from a hub
GOOD = {"volts": 12.1, "percent": 86, "celsius": 52, "megabytes": 8120, "dbm": -55}
POOR = {**GOOD, "volts": 10.2, "percent": 33, "dbm": -74, "power_save": 1, "undervoltage": 1}
LOW, OLD, AWAY = (3, 10), 2, 8  # places in the list: what has a low battery, another version, no connection
NAMES = "Ada", "Maximilian", "Ben"
IDLE = {"status": "stopped: no command yet", "state": "stopped", "cause": "no_command_yet",
        "template": "no command yet", "arguments": {}, "remarks": [], "holds": [], "waiting": [], "fake": False,
        "warning": False, "answers": True, "stopped": False, "pose": None, "speed": None, "command": [0, 0],
        "wheels": [0, 0], "program": "", "driver": None, "resumes": None, "held": None, "stalls": 0, "task": None,
        "pictures": None, "programs": 0}
OUT_OF_REACH = {"answers": False, "state": "", "status": "", "template": "", "cause": "", "command": None,
                "wheels": None, "health": None, "link": None}


def robot_named(name: str, **facts) -> dict:
    """Return what a cockpit says of a simulated robot."""
    return {"id": f"/{name}", "label": name, "color": "#804040", "workshop": True, "wheel_separation": 2.0,
            "max_speed": 1.0, "simulated": True, **facts}


def numbered(robots: int) -> list:
    """Return the names of the robots of a class."""
    return [f"jetbot_{number:02d}" for number in range(1, robots + 1)]


def codes_of(robots: int) -> dict:
    """Return the message with the codes of a class."""
    return {"type": "codes", "codes": [
        {"label": name, "role": "pupil", "robot": f"/{name}", "code": "7KQ2MX", "rows": ["10" * 16 + "1"] * 33,
         "url": f"http://192.168.100.{200 + place}:8080/#7KQ2MX"} for place, name in enumerate(numbered(robots))]}


def receive_fleet(page, unconfirmed=(), robots: int = 15) -> None:
    """Let the page receive a class; unconfirmed: who has not confirmed the stop of all, which is engaged then."""
    page.receive_class(0)  # and nothing of the cockpit any more
    page.receive({"type": "robots", "robots": [
        robot_named(name, color=f"#{96 + 8 * place:02x}4040", simulated=False, pupil=NAMES[place % 3],
                    version="1.1.0" if place == OLD else "1.2.0", address=f"http://192.168.1.{place + 10}:8080/")
        for place, name in enumerate(numbered(robots))]})
    page.receive({"type": "state", "emergency": bool(unconfirmed), "pupils_release": False,
                  "unconfirmed": [f"/{name}" for name in unconfirmed],
                  "robots": {f"/{name}": _state(place) for place, name in enumerate(numbered(robots))}})


def _state(place):
    health = [row._asdict() for row in judge(POOR if place in LOW else GOOD)]
    return {**IDLE, "health": health, "link": 4.3 + 3 * place, **(OUT_OF_REACH if place == AWAY else {})}
