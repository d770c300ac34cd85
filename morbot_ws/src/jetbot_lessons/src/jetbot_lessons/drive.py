"""The check of lesson 9: the recorded drive, judged again."""

from driving_tasks.scoring.tasks import TASKS

from . import Problem
from .packages import NameOrFolder, folder

TASK = "metre"
BAG = f"{TASK}.bag"
NEEDED = 60.0  # points of 100
RECORD = f"rosrun driving_tasks judge.py {TASK} --record"


def check_drive(package: NameOrFolder) -> Problem:
    """Return the problem, or None if the bag in the package is a drive with NEEDED points; nothing is executed."""
    bag = folder(package) / BAG
    if not bag.is_file():
        return f"There is no file {bag}: record your drive with {RECORD} {bag}"
    from driving_tasks.sources.bags import judge_bag  # here: rosbag takes long to import
    mark = judge_bag(TASKS[TASK], str(bag))
    if not mark.result:
        return f"{bag} has no score: {mark.problem}"
    if mark.source:
        return f"{bag} holds no ground truth, but {mark.source}: record your drive with {RECORD} {bag}"
    score = round(mark.result.score, 1)
    if score >= NEEDED:
        return None
    return (f"{BAG} has {score:.1f} of 100 points, and {NEEDED:.0f} are needed: "
            f"it {mark.result.largest_loss}; improve your program, and record it again")
