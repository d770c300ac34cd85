"""Node, which runs the page's scripts without a browser."""

import os
import shutil
import subprocess
from functools import lru_cache
from pathlib import Path

import pytest

from conftest import ROOT

OLDEST = 18


def node(*arguments: object, input: str = "", cwd: Path = ROOT) -> "subprocess.CompletedProcess[str]":
    """Run Node in the project's folder, or a copy; return how it ended, and what it printed."""
    environment = {name: value for name, value in os.environ.items() if name != "NODE_OPTIONS"}
    return subprocess.run(["node", *map(str, arguments)], cwd=cwd, env=environment, input=input,
                          stdout=subprocess.PIPE, text=True)


@lru_cache(maxsize=None)
def has_node() -> bool:
    """Return whether a Node is there that knows all that the tests use."""
    return bool(shutil.which("node")) and int(node("-p", "parseInt(process.versions.node)").stdout) >= OLDEST


needs_node = pytest.mark.node  # skips in conftest.py, if there is none
