"""Prints the URDF of a robot in a colour of its own: python3 -m simulation.description URDF [NAMESPACE]."""

import colorsys
import re
import sys
import zlib
from pathlib import Path
from typing import Tuple

Color = Tuple[float, float, float]  # red, green, blue: 0 to 1

COLORS = {"red": (0.95, 0.15, 0.12), "green": (0.15, 0.75, 0.25), "blue": (0.15, 0.40, 1.00),
          "yellow": (1.00, 0.85, 0.10), "orange": (1.00, 0.50, 0.05), "purple": (0.60, 0.25, 0.75),
          "white": (1.00, 1.00, 1.00), "black": (0.10, 0.10, 0.10)}
CASE = re.compile(r'(<material name="case"><color rgba=")[^"]*')


def color_of(name: str) -> Color:
    """Return the colour that the robot's name says; for any other name, one that is always the same."""
    return COLORS.get(name) or colorsys.hsv_to_rgb(zlib.crc32(name.encode()) / 2**32, 0.7, 0.75)


def paint(urdf: str, namespace: str) -> str:
    """Return the URDF of the robot in this namespace; one without a namespace keeps its colour."""
    name = namespace.strip("/").rpartition("/")[2]
    if not name:
        return urdf
    red, green, blue = color_of(name)
    return CASE.sub(rf"\g<1>{red:.2f} {green:.2f} {blue:.2f} 1", urdf)


if __name__ == "__main__":
    sys.stdout.write(paint(Path(sys.argv[1]).read_text(), "".join(sys.argv[2:])))
