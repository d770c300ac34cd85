"""What the robots of a class say besides what they do, as one class says it: trails, scenes, tasks, scores."""

from typing import Dict, List

LATEST = "trail", "scene"  # of each robot the last one counts


class Tables:
    """Each robot's messages go in, and come out as those of one cockpit for the class."""

    def __init__(self):
        self._said: Dict[str, Dict[str, dict]] = {kind: {} for kind in (*LATEST, *self._unions())}  # by robot
        self._changes: Dict[str, List[dict]] = {}  # what is new, of each robot or of the class

    def update(self, robot: str, message: dict) -> None:
        """Take what a robot has said."""
        kind = message["type"]
        if kind in LATEST and message["robot"] != robot or kind not in self._said:
            return
        self._said[kind][robot] = message
        if kind in LATEST:
            self._changes[kind + robot] = [message]
        else:
            self._changes[kind] = self._unions()[kind]()

    def take_changes(self) -> List[dict]:
        """Return the messages for all pages since the last call."""
        changes, self._changes = self._changes, {}
        return [message for messages in changes.values() for message in messages]

    def messages(self) -> List[dict]:
        """Return the messages that a new page needs."""
        latest = [message for kind in LATEST for message in self._said[kind].values()]
        return latest + [message for union in self._unions().values() for message in union()]

    def _unions(self):
        return {"tasks": self._tasks, "scores": self._scores, "cameras": self._cameras}

    def _cameras(self):
        """Return whether pupils see any robot's camera: one that missed the switch is seen."""
        said = self._said["cameras"].values()
        return [{"type": "cameras", "on": any(message["on"] for message in said)}] if said else []

    def _tasks(self):
        """Return which tasks any robot offers; one is on if it is on at a robot."""
        tasks: Dict[str, dict] = {}
        for message in self._said["tasks"].values():
            for task in message["tasks"]:
                tasks[task["name"]] = {**task, "on": task["on"] or tasks.get(task["name"], task)["on"]}
        return [{"type": "tasks", "tasks": list(tasks.values())}] if self._said["tasks"] else []

    def _scores(self):
        """Return the scores of all, the best of each task first."""
        scores = [score for message in self._said["scores"].values() for score in message["scores"]]
        scores.sort(key=lambda score: (score["task"], -score["score"], score["robot"]))
        return [{"type": "scores", "scores": scores}] if scores else []
