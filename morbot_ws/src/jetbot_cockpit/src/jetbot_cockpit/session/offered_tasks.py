"""The driving tasks that the page offers, and which of them pupils may choose."""

from typing import Callable, Iterable, List, Optional, Set, Tuple

from ..notices import Notice, say
from .rights import TEACHER, Client


class OfferedTasks:
    """on: the names of the tasks that are on at first; keep: is called with all of them after each change."""

    def __init__(self, on: Iterable[str], keep: Callable[[List[str]], None]):
        self._on: Set[str] = {name for name in on if isinstance(name, str)}
        self._keep = keep
        self._offered: Tuple[Tuple[str, str], ...] = ()  # (name, title) of those that a judge knows
        self._sent = self.message()

    def update(self, offered: Tuple[Tuple[str, str], ...]) -> List[dict]:
        """Take what a judge offers now, nothing without a judge; return the message for the pages if it has changed."""
        self._offered = offered
        before, self._sent = self._sent, self.message()
        return [self._sent] if self._sent != before else []

    def message(self) -> dict:
        """Return the message "tasks"."""
        return {"type": "tasks", "tasks": [{"name": name, "title": title, "on": name in self._on}
                                           for name, title in self._offered]}

    def switch(self, task: str, on: bool) -> None:
        """Let pupils choose a task, or not."""
        if task in dict(self._offered):
            (self._on.add if on else self._on.discard)(task)
            self._keep(sorted(self._on))

    def refusal(self, client: Client, task: str) -> Optional[Notice]:
        """Return why this person may not choose this task, or None."""
        if task not in dict(self._offered):
            return say("no_judge")
        return None if client.role == TEACHER or task in self._on else say("task_off")
