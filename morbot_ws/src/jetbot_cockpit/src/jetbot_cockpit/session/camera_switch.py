"""Whether pupils see what the cameras see; a teacher always does."""

from typing import Any, Callable, Dict, List, Optional

from ..notices import Notice, say
from .rights import TEACHER, Client, Request


class CameraSwitch:
    """kept: {"on": whether pupils see}, or {}: they do; keep: is called with that after each change."""

    def __init__(self, kept: Dict[str, Any], keep: Callable[[Dict[str, bool]], None]):
        self._on = kept.get("on") is not False
        self._keep = keep
        self._sent = self.message()

    def switch(self, request: Request) -> None:
        """Let pupils see, or not."""
        self._on = request.message.on
        self._keep({"on": self._on})

    def refusal(self, client: Client) -> Optional[Notice]:
        """Return why this person does not see what a camera sees, or None."""
        return None if self._on or client.role == TEACHER else say("cameras_off")

    def message(self) -> dict:
        """Return the message "cameras"."""
        return {"type": "cameras", "on": self._on}

    def update(self) -> List[dict]:
        """Return the message for the pages if it has changed."""
        before, self._sent = self._sent, self.message()
        return [self._sent] if self._sent != before else []
