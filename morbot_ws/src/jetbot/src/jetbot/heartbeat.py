"""Notices that the browser no longer answers."""

import enum
import threading
import time
import traceback

import ipywidgets
import traitlets


class Heartbeat(traitlets.HasTraits):
    """Sends a pulse to the browser every ``period`` seconds, which sends it back; ``status`` is dead once one is late.

    status, period: traits. pulseout: the widget with the pulse, in seconds; a page must show it. pulsein: what came
    back. An observer's error is printed, and ends nothing.
    """

    class Status(enum.Enum):
        """Whether the browser answers."""

        dead = 0
        alive = 1

    status = traitlets.UseEnum(Status, default_value=Status.dead)
    period = traitlets.Float(0.5, min=0.001)
    running = traitlets.Bool(False)

    def __init__(self, period: float = 0.5):
        super().__init__()
        self.period = period
        self._epoch = time.time() - time.monotonic()  # a clock that is set must not make a pulse late, or early
        self.pulseout, self.pulsein = (ipywidgets.FloatText(value=self._now()) for _ in range(2))
        self.pulsein.value = self.pulseout.value
        self.link = ipywidgets.jsdlink((self.pulseout, "value"), (self.pulsein, "value"))
        self.start()

    def start(self) -> None:
        """Send pulses, unless it does already."""
        if not self.running:
            self.running = True
            threading.Thread(target=self._run, daemon=True).start()

    def stop(self) -> None:
        """Send no more pulses; the status stays."""
        self.running = False

    def _now(self) -> float:
        return self._epoch + time.monotonic()

    def _run(self) -> None:
        while self.running:
            try:
                late = self.pulseout.value - self.pulsein.value >= self.period
                self.status = self.Status.dead if late else self.Status.alive
                self.pulseout.value = self._now()
            except Exception:  # of an observer, or of a page that is closed
                traceback.print_exc()
            time.sleep(self.period)
