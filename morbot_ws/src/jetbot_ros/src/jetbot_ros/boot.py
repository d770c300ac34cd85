"""The first import of every script: from here on, Ctrl-C and what breaks end it with one line at most."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # while the rest is imported, in which rospy might lose a Ctrl-C

from . import failures, launcher  # noqa: E402, F401  the launcher reads at once who has started this process

failures.install()
