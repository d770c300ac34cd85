"""``Camera``: the newest picture as an array, by the names of the JetBot library."""

import atexit
import os
import threading
from typing import Any, Iterator, List, Optional

import numpy  # noqa: F401  here, and not first in the thread that decodes
import PIL.Image  # noqa: F401
import traitlets

from ..errors import JetbotError
from .jpeg import decode
from .sources import find_command
from .stream import Stream, print_sentence

running: List["Camera"] = []  # of this process


class Camera(traitlets.HasTraits):
    """What the robot sees. The camera runs from here on, until ``stop``.

    width, height: of the pictures, in pixels; fps: pictures per second; source: as for ``sources.find_command``.
    value: the newest picture: an array, height x width x 3, BGR, uint8; a trait. Observers are called in a thread of
    the camera, and while they are, newer pictures replace each other. What is wrong later is printed, once a minute.
    Waits for the first picture; raises JetbotError if none comes. A new camera with the same source stops the old one,
    such as a notebook's cell leaves behind when it is run again.
    """

    value = traitlets.Any()

    def __init__(self, width: int = 224, height: int = 224, fps: int = 30, source: str = ""):
        super().__init__()
        self.width, self.height, self.fps = width, height, fps
        self.source = source or os.environ.get("JETBOT_CAMERA", "")
        self._stream: Optional[Stream] = None
        self._thread: Optional[threading.Thread] = None
        self.start()

    @classmethod
    def instance(cls, width: int = 224, height: int = 224, fps: int = 30, source: str = "") -> "Camera":
        """Return the camera that runs with these arguments, or a new one."""
        wanted = width, height, fps, source or os.environ.get("JETBOT_CAMERA", "")
        same = (each for each in running if (each.width, each.height, each.fps, each.source) == wanted)
        return next(same, None) or cls(*wanted)

    def start(self) -> None:
        """Wait for the first picture, then let ``value`` follow. Raise JetbotError. Does nothing if it runs already."""
        if self._stream is not None:
            return
        command = find_command(self.source, self.width, self.height, self.fps)
        for other in [other for other in running if other.source == self.source]:
            other.stop()
        self._stream = Stream(command, self._report, lambda jpeg: decode(jpeg, self.width, self.height))
        running.append(self)
        try:
            self._begin(self._stream)
        except BaseException:  # also Ctrl-C
            self.stop()
            raise

    def _begin(self, stream: Stream) -> None:
        pictures = iter(stream)
        stream.start()
        stream.require_picture()
        self.value = next(pictures, None)
        self._thread = threading.Thread(target=self._follow, args=[stream, pictures], daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Release the camera; ``value`` keeps the last picture."""
        stream, self._stream = self._stream, None
        if stream is not None:
            running.remove(self)
            stream.stop()
            if self._thread not in (None, threading.current_thread()):
                self._thread.join()

    def restart(self) -> None:
        """Stop, then start."""
        self.stop()
        self.start()

    def _report(self, sentence: str) -> None:
        """Print a sentence, unless ``start`` raises it."""
        stream = self._stream
        if stream and (stream.count or not stream.error):
            print_sentence(sentence)

    def _follow(self, stream: Stream, pictures: Iterator[Any]) -> None:
        for picture in pictures:
            try:
                self.value = picture
            except Exception as error:  # an observer's: it ends nothing
                stream.complain(JetbotError(f"an observer of the camera failed: {error!r}"))


@atexit.register
def abandon_all() -> None:
    """Do not wait: the robot has yet to be stopped."""
    for stream in filter(None, [camera._stream for camera in running]):
        stream.abandon()


os.register_at_fork(after_in_child=running.clear)  # the parent's
