#!/usr/bin/env python3
"""The wheels turn as commanded: left = x - z, right = x + z, each within [-1, 1]."""

from harness import RobotTest, main

TABLE = [  # x, z, left, right
    (0.5, 0.0, 0.5, 0.5), (-0.5, 0.0, -0.5, -0.5), (0.0, 0.4, -0.4, 0.4), (0.0, -0.4, 0.4, -0.4),
    (0.5, 0.1, 0.4, 0.6), (0.8, 0.7, 0.1, 1.0), (1.0, 2.0, -1.0, 1.0), (3.0, 0.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.0)]


class Mixing(RobotTest):
    def test_table(self):
        self.controller()
        for x, z, left, right in TABLE:
            self.command(x, z)
            self.wait_for_wheels(left, right)


if __name__ == "__main__":
    main(Mixing)
