"""Drive a JetBot: ``from jetbot import Robot``."""

from .errors import BusError, InvalidValue, JetbotError
from .robot import Motor, Robot

__all__ = ["BusError", "InvalidValue", "JetbotError", "Motor", "Robot"]
