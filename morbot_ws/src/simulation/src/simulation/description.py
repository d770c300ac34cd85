"""Prints the URDF of a robot in a colour of its own: python3 -m simulation.description URDF [NAMESPACE]."""

import re
import sys
from pathlib import Path

from jetbot_ros.colors import color_of

CASE = re.compile(r'(<material name="case"><color rgba=")[^"]*')


def paint(urdf: str, namespace: str) -> str:
    """Return the URDF of the robot in this namespace; one without a namespace keeps its colour."""
    name = namespace.strip("/").rpartition("/")[2]
    if not name:
        return urdf
    red, green, blue = color_of(name)
    return CASE.sub(rf"\g<1>{red:.2f} {green:.2f} {blue:.2f} 1", urdf)


if __name__ == "__main__":
    sys.stdout.write(paint(Path(sys.argv[1]).read_text(), "".join(sys.argv[2:])))
