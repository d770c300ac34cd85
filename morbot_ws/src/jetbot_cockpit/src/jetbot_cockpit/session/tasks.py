"""The driving tasks that the page offers, and which of them pupils may choose."""

from typing import Callable, Iterable, List, Set, Tuple

from .rights import TEACHER, Client


class Tasks:
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

    def switch(self, client: Client, task: str, on: bool) -> str:
        """Let pupils choose a task, or not; return why that is refused, or ""."""
        if client.role != TEACHER:
            return "Only a teacher chooses the tasks."
        if task in dict(self._offered):
            (self._on.add if on else self._on.discard)(task)
            self._keep(sorted(self._on))
        return ""

    def refusal(self, client: Client, task: str) -> str:
        """Return why this person may not choose this task, or ""."""
        if task not in dict(self._offered):
            return "No judge has this task. Is class_judge running?"
        return "" if client.role == TEACHER or task in self._on else "Your teacher has not switched this task on."
