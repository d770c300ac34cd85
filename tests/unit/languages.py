"""What a page says in the language of whoever reads it."""

from typing import List

from driving_tasks.scoring.sentences import SENTENCES
from driving_tasks.scoring.tasks import TASKS
from jetbot_cockpit.notices import NOTICES
from jetbot_ros.state import CAUSES


def templates() -> List[str]:
    """Return what Python says to a page in English, each template once: the keys of its translations."""
    said = [*NOTICES.values(), *CAUSES.values(), *SENTENCES.values()]
    for task in TASKS.values():
        said += [task.title, task.invitation.template]
    return list(dict.fromkeys(said))
