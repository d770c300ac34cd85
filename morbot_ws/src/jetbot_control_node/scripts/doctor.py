#!/usr/bin/env python3
"""Looks at everything that a JetBot needs to drive, and says what is missing. Needs no roscore; moves no wheel."""

import argparse
import json
import os
import sys

from jetbot.boards import PORT
from jetbot_tools import doctor
from jetbot_tools.terminal import as_options


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print the checks as a JSON list")
    parser.add_argument("--i2c-bus", default=os.environ.get("JETBOT_I2C_BUS") or None,
                        help="look at this bus only: N for /dev/i2c-N, fake, or fake:FOLDER")
    parser.add_argument("--port", default=os.environ.get("JETBOT_PORT") or PORT, help="of a JetBot Pro")
    options = parser.parse_args(as_options(sys.argv[1:]))
    checks = []
    for check in doctor.examine(options.i2c_bus, options.port):
        checks.append(check)
        if not options.json:
            print(check, flush=True)
    if options.json:
        print(json.dumps([check._asdict() for check in checks], indent=2))
    return 0 if checks[-1].ok else 1


if __name__ == "__main__":
    sys.exit(main())
