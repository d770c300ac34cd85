#!/usr/bin/env python3
"""Checks everything that a JetBot needs to drive, and prints what is missing. Needs no roscore; moves no wheel."""

import jetbot_ros.boot

import argparse
import json
import signal
import sys

from jetbot_tools.doctor.jetbot_module import require_own

try:
    from jetbot_tools.doctor.checkup import run_checks
    from jetbot_tools.options import add_options, parse
except Exception:
    require_own()
    raise


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print the checks as a JSON list")
    add_options(parser, board="any", i2c_bus="every bus", i2c_address="those of the boards", port="")
    options = parse(parser, sys.argv[1:])
    checks = []
    for check in run_checks(options.i2c_bus, options.port, options.i2c_address, options.board or ""):
        checks.append(check)
        if not options.json:
            print(check, flush=True)
    if options.json:
        print(json.dumps([check._asdict() for check in checks], indent=2))
    return 0 if checks[-1].ok else 1


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # `| head` simply ends it
    sys.exit(main())
