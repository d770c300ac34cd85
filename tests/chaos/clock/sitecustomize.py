"""Python imports this when it starts: its wall clock is then off by the seconds that the file CHAOS_CLOCK holds."""

import mmap
import os
import struct
import time

_now = time.time
with open(os.environ["CHAOS_CLOCK"], "rb") as _file:
    _offset = mmap.mmap(_file.fileno(), 8, access=mmap.ACCESS_READ)

time.time = lambda: _now() + struct.unpack_from("d", _offset)[0]
