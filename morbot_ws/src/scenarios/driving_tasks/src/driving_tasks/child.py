"""What a child process does first: it ends with its parent, and takes no more than its limits."""

import ctypes
import multiprocessing
import os
import resource
from pathlib import Path
from typing import Dict

FORK = multiprocessing.get_context("fork")
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36  # of prctl(2)
_prctl = ctypes.CDLL(None).prctl


def end_with_parent(parent: int, signum: int) -> None:
    """From now on, this process gets a signal when its parent ends; end it now if that has ended already."""
    _prctl(PR_SET_PDEATHSIG, signum)
    if os.getppid() != parent:
        os._exit(1)


def adopt_orphans() -> None:
    """From now on, what this process's children leave behind becomes its own child."""
    _prctl(PR_SET_CHILD_SUBREAPER, 1)


def set_limits(limits: Dict[int, int]) -> None:
    """Limit this process and its children for good. limits: by RLIMIT_..., in getrlimit(2)'s units."""
    for kind, value in {resource.RLIMIT_CORE: 0, **limits}.items():
        highest = resource.getrlimit(kind)[1]
        value = value if highest == resource.RLIM_INFINITY else min(value, highest)
        resource.setrlimit(kind, (value, value))


def address_space() -> int:
    """Return how large this process's address space is, in bytes: proc(5). Threads reserve more than they use."""
    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
