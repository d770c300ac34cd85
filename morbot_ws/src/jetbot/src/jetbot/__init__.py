"""Drive a JetBot, and see what it sees: ``from jetbot import Robot, Camera``, by the names of the JetBot library.

These are imported when they are first used, so that ``import jetbot`` is light. Where traitlets is installed, a Robot's
motors have traits; a node, which needs none, takes its Robot from ``jetbot.robot``. For type checkers it is that one:
whoever observes a motor takes the Robot of ``jetbot.traits``.
"""

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any, List

from .errors import BusError, InvalidValue, JetbotError

if TYPE_CHECKING:
    from .camera.camera import Camera as Camera
    from .camera.jpeg import bgr8_to_jpeg as bgr8_to_jpeg
    from .heartbeat import Heartbeat as Heartbeat
    from .motor import Motor as Motor
    from .robot import Robot as Robot

__version__ = "1.2.0"

HOMES = {"Robot": ("traits", "robot"), "Motor": ("traits", "motor"), "Heartbeat": ("heartbeat",),
         "Camera": ("camera.camera",), "bgr8_to_jpeg": ("camera.jpeg",)}  # the modules; the first that can be imported
EXTRAS = {"Heartbeat": ("ipywidgets", "notebook"), "Camera": ("numpy", "camera")}  # what some need, and who brings it

__all__ = ["BusError", "InvalidValue", "JetbotError",
           *(name for name in HOMES if name not in EXTRAS or importlib.util.find_spec(EXTRAS[name][0]))]


def __getattr__(name: str) -> Any:
    if name not in HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    *preferred, last = HOMES[name]
    for home in preferred:
        try:
            return getattr(importlib.import_module(f".{home}", __name__), name)
        except ImportError:
            pass  # without traitlets
    try:
        return getattr(importlib.import_module(f".{last}", __name__), name)
    except ModuleNotFoundError as error:
        extra = EXTRAS.get(name, ("", "camera"))[1]
        raise ImportError(f"jetbot.{name} needs {error.name}: pip install 'jetbot[{extra}]'") from error


def __dir__() -> List[str]:
    return sorted({*globals(), *__all__})  # for Tab
