#!/usr/bin/env python3
"""ROS node: judges the robots for which somebody presses Judge me on the cockpit's page, until Ctrl-C."""

import jetbot_ros.boot

import signal
import sys

from driving_tasks.sources.requests import serve
from jetbot import JetbotError
from jetbot.text import printable
from jetbot_ros.lifecycle import leave

if __name__ == "__main__":
    try:
        for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(signum, signal.default_int_handler)
        serve()
    except JetbotError as error:
        print(printable(str(error)), file=sys.stderr, flush=True)
        leave(1)
    except KeyboardInterrupt:
        leave(0)
