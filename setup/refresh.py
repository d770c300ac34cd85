"""Updates the search path of open shells after a change, and reports what ROS cannot read: refresh.py SOURCE DEVEL."""

import sys
import time
from pathlib import Path

from packages import find_packages
from state import read_stamp, search_path, write_search_path

source, devel = map(Path, sys.argv[1:])
now = time.time()
packages, problems = find_packages(source, read_stamp(devel).folders)
write_search_path(devel, search_path(source, packages, problems), now)
for problem in problems:
    print(f"morbot: {problem}", file=sys.stderr)
