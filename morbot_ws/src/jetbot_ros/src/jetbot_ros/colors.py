"""A colour for each robot, by its name: in RViz, and on the cockpit's map, which may be white or black."""

import colorsys
import re
import zlib
from typing import Tuple

Color = Tuple[float, float, float]  # red, green, blue: 0 to 1

COLORS = {"red": (0.95, 0.15, 0.12), "green": (0.15, 0.75, 0.25), "blue": (0.15, 0.40, 1.00),
          "yellow": (1.00, 0.85, 0.10), "orange": (1.00, 0.50, 0.05), "purple": (0.60, 0.25, 0.75),
          "white": (1.00, 1.00, 1.00), "black": (0.10, 0.10, 0.10)}
# Of jetbot_01, jetbot_02 and so on: each differs as much as it can from those before it (distances in OKLab), and has a
# contrast of 3 or more to white and to black (WCAG 2.1, 1.4.11).
PALETTE = ("004bff", "ff4b0f", "00a500", "ff00ff", "875a00", "b400a5", "2d96ff", "b46987",
           "5a5aa5", "8700ff", "ff1e96", "b469f0", "0fa5a5", "c30f1e", "00785a", "c38700")
NUMBERED = re.compile(r"jetbot_(\d+)")
GOLDEN_RATIO = (5 ** 0.5 - 1) / 2  # its multiples spread hues evenly, however many there are


def color_of(name: str) -> Color:
    """Return the colour that the robot's name says; for any other name, one that is always the same.

    A robot without a name is blue: red is the colour of the cockpit's stop.
    """
    if not name:
        return COLORS["blue"]
    if name in COLORS:
        return COLORS[name]
    numbered = NUMBERED.fullmatch(name)
    number = int(numbered.group(1)) if numbered else zlib.crc32(name.encode())
    if 1 <= number <= len(PALETTE):
        return tuple(part / 255 for part in bytes.fromhex(PALETTE[number - 1]))
    return colorsys.hls_to_rgb(number * GOLDEN_RATIO % 1, 0.4, 0.9)


def web_color_of(name: str) -> str:
    """Return the same as a page writes it, as "#004bff"."""
    return "#" + "".join(f"{round(255 * part):02x}" for part in color_of(name))
