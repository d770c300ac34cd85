"""Who collects pictures of a robot: its driver."""

from typing import Callable, Dict, Optional

from ..notices import Notice, say
from .collection import Collection
from .feed import Picture
from .leases import Leases
from .rights import Client, Request
from .snapshot import label


class Collecting:
    """cameras: what the robots see (robots.camera_topics.Cameras); refusal: why somebody may not see that.

    Each method returns why it refuses, or None.
    """

    def __init__(self, cameras, collection: Collection, leases: Leases,
                 refusal: Callable[[Client], Optional[Notice]]):
        self._cameras, self._collection, self._leases, self._camera_refusal = cameras, collection, leases, refusal
        self._saved: Dict[str, Picture] = {}  # the last one, by robot

    def save(self, request: Request) -> Optional[Notice]:
        """Keep the robot's newest picture, once."""
        robot, picture = request.robot, self._cameras.newest(request.robot, request.now)
        refusal = self._refuse(request) or self._camera_refusal(request.client)
        refusal = refusal or (None if picture else say("no_picture"))
        if not refusal and picture != self._saved.get(robot):
            refusal = self._collection.save(robot, request.message.label, picture.jpeg)
            if not refusal:
                self._saved[robot] = picture
        return refusal

    def delete(self, request: Request) -> Optional[Notice]:
        """Delete the robot's pictures."""
        return self._refuse(request) or self._collection.delete(request.robot)

    def _refuse(self, request):
        """Refuse who does not drive the robot; who collects keeps it."""
        if not self._leases.is_driver(request.client, request.robot):
            return say("driver_collects", robot=label(request.robot))
        self._leases.keep(request)
        return None
