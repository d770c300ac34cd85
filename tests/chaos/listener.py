"""Does what `rostopic echo TOPIC` does, in so many processes, with one start of Python. Arguments: COUNT TOPIC."""

import os
import sys

import rostopic

if __name__ == "__main__":
    for _ in range(int(sys.argv[1]) - 1):
        if os.fork() == 0:
            break
    rostopic.rostopicmain(["rostopic", "echo", sys.argv[2]])
