"""Which program a node is."""

import contextlib
import os
from pathlib import Path
from typing import List
from urllib.parse import urlsplit

import rosgraph

from .master import NO_ANSWER, address_of, ask, proxy


def command_of(node: str) -> List[Path]:
    """Return the program and the script of a node on this computer; nothing for another computer's node."""
    with contextlib.suppress(*NO_ANSWER):
        uri = address_of(node)
        if rosgraph.network.is_local_address(urlsplit(uri).hostname):
            process = Path("/proc", str(ask(proxy(uri), "getPid")))
            working_folder = (process / "cwd").resolve()
            words = [os.fsdecode(word) for word in (process / "cmdline").read_bytes().split(b"\0")[1:]]
            return [(process / "exe").resolve(),
                    *[(working_folder / word).resolve() for word in words if word and not word.startswith("-")][:1]]
    return []
