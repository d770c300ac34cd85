"""What is typed after judge.py: a mistake ends it with one sentence."""

import pytest

from driving_tasks.arguments import is_single, parse_arguments
from driving_tasks.scoring.tasks import TASKS
from jetbot.text import enumeration


def test_the_source_and_the_files_of_a_judgement(tmp_path):
    given = parse_arguments(["metre", "--robot", "/red/", "jetbot_02", "--csv", "marks.csv"])
    assert (given.task.name, given.robot, given.csv, given.bag) == ("metre", ["red", "jetbot_02"], "marks.csv", None)
    assert not is_single(given)
    assert not is_single(parse_arguments(["metre", "--bag", str(tmp_path)]))
    assert is_single(parse_arguments(["metre", "--bag", "x.bag", "--robot", "red"]))


@pytest.mark.parametrize("arguments, sentence", [
    (["meter"], "There is no task meter. Did you mean metre?"),
    (["xyz"], f"There is no task xyz. The tasks are {enumeration(list(TASKS))}."),
    (["metre", "--bags", "x"], "Unrecognized arguments: --bags x. See judge.py --help."),
    (["metre", "--bag", ".", "--picture", "x.png"],
     "--picture is for one drive; for several, use --pictures FOLDER."),
    (["metre", "--bag", "x", "--record", "y.bag"], "--record is for a robot that drives now."),
    (["metre", "--bag", "x", "--robot", "a", "b"], "--robot names one robot of a bag, and none of a program."),
    (["metre", "--config", "si_units.yaml"], "--config and --variation belong to --program: "),
    (["metre", "--variation", "0.5"], "--config and --variation belong to --program: "),
    (["metre", "--program", "x", "--variation", "2"], "--variation: It must be from 0 to 1, not 2."),
    (["metre", "--bag", "x", "--program", "y"], "--program: not allowed with argument --bag. See judge.py --help."),
    (["--bag", "drive.bag"], "The task is missing. The tasks are metre, "),
    (["metre", "--bag", "x.bag", "--picture", "x.bag"], "--picture: Its name must end in .png, not x.bag."),
    (["metre", "--bag", "x.bag", "--csv", "x.bag"], "--csv: Its name must end in .csv, not x.bag."),
], ids=lambda value: " ".join(value) if isinstance(value, list) else "")
def test_what_cannot_be_meant_is_one_sentence(arguments, sentence):
    with pytest.raises(SystemExit) as end:
        parse_arguments(arguments)
    assert str(end.value).startswith(sentence)
