"""Which version of MorBot this process runs."""

import re
import subprocess
from pathlib import Path
from typing import Optional

COMMIT = re.compile("[0-9a-f]{40}")
ROOT = next((folder for folder in Path(__file__).resolve().parents if (folder / "morbot").is_file()), None)


def version_of(root: Optional[Path] = ROOT) -> str:
    """Return the commit of this folder, 40 hexadecimal digits, or "" if it is not known.

    ./morbot fleet installs a version into a folder that has its name.
    """
    if not root or COMMIT.fullmatch(root.name):
        return root.name if root else ""
    try:
        said = subprocess.run(["git", "-C", str(root), "rev-parse", "HEAD"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, timeout=5, check=False).stdout.decode().strip()
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return said if COMMIT.fullmatch(said) else ""
