"""Which version of MorBot this is."""

import subprocess
from pathlib import Path

import jetbot

TIMEOUT = 5.0  # s


def installed() -> str:
    """Return what git calls this version, as 1.2.0-5-g0123abc; without git, the release."""
    command = ["git", "-C", str(Path(__file__).resolve().parent), "describe", "--tags", "--always", "--dirty"]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=TIMEOUT, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return jetbot.__version__
    return done.stdout.decode(errors="replace").strip() or jetbot.__version__
