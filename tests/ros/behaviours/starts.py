"""A program that starts with too little memory, or too few file descriptors, ends, and mostly with one sentence."""

from harness import CONTROLLER, START_TIMEOUT, RobotTest, program, read

LIMITS = ("--as=30000000", "--nofile=10")
LATER = "--as=60000000"  # too little for a thread: rospy's own words come first
PROGRAMS = (CONTROLLER, program("simulation", "simulator.py"), program("jetbot_cockpit", "cockpit.py"),
            program("jetbot_tools", "emergency_stop.py"))


class Starts(RobotTest):
    def test_with_too_little_each_program_says_so_and_ends(self):
        for path in PROGRAMS:
            for limit in (*LIMITS, LATER):
                process = self.start("prlimit", limit, path)
                code, printed = process.wait(START_TIMEOUT), read(process)
                self.assertEqual(code, 1, f"{path} {limit}: {printed}")
                self.assertTrue(limit == LATER or printed.count("\n") == 1, f"{path} {limit}: {printed}")
