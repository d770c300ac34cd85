"""What the cockpit keeps of the robots for pages that open later: trails, scenes and scores. No ROS here."""

from typing import Callable, Dict, List

from .scene import Scenes
from .scores import Scores
from .trail import Trails
from .view import Robot


class History:
    """Messages of the socket with what changes seldom.

    restarted: called with the id of each robot that was put somewhere else, such as back to its start.
    """

    def __init__(self, restarted: Callable[[str], None]):
        self._restarted = restarted
        self._trails, self._scenes, self._scores = Trails(), Scenes(), Scores()

    def reset(self, robot: str, now: float) -> None:
        """The robot is asked to go back to its start."""
        self._trails.reset(robot, now)

    def update(self, robots: Dict[str, Robot], now: float) -> List[dict]:
        """Take all robots as they are now; return messages with what has changed."""
        restarts = self._trails.update({robot.id: robot.pose for robot in robots.values()}, now)
        for message in restarts:
            self._restarted(message["robot"])
        scenes = self._scenes.update({robot.id: robot.shapes for robot in robots.values()})
        return restarts + scenes + self._scores.update({robot.id: robot.task for robot in robots.values()})

    def messages(self) -> List[dict]:
        """Return messages with all of it."""
        return self._trails.messages() + self._scenes.messages() + self._scores.messages()
