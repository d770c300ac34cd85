"""The lines that a row of PARAMETERS makes in the launch file and in docs/reference.md; whether the node reads it."""

import ast
from xml.sax.saxutils import quoteattr

from conftest import ROOT, SOURCE

LAUNCH, REFERENCE = SOURCE / "launch/jetbot_controller.launch", ROOT / "docs/reference.md"
PACKAGE = SOURCE / "src/jetbot_control_node"


def lines_of(name, row):
    """Return the two lines of the launch file, and the one of the reference."""
    default = shown(row.default)
    doc = quoteattr(f"{row.doc} ({' '.join(filter(None, (default, row.unit)))})")
    return (f'<arg name="{name}" default="" doc={doc}/>', f'<param name="{name}" value="$(arg {name})"/>',
            f"| `{name}` | `{default}` | {row.unit or ''}{' ' if row.unit else ''}| {row.doc} |")


def shown(value):
    """Return a default as YAML and roslaunch write it."""
    if value is None:
        return "the board's own"
    return str(value).lower() if isinstance(value, bool) else str(value)


def unread(names):
    """Return which of these names stand in no expression of what starts, drives and publishes."""
    files = [SOURCE / "scripts/jetbot_controller.py", PACKAGE / "node.py",
             *PACKAGE.glob("control/*.py"), *PACKAGE.glob("odometry/*.py")]
    nodes = [node for file in files for node in ast.walk(ast.parse(file.read_text()))]
    return set(names) - {node.value for node in nodes if isinstance(node, ast.Constant)}
