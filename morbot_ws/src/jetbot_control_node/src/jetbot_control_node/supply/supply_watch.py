"""Watches the supply: when it is read, and whether it dips as the motors start. No ROS here."""

import threading
import time
from typing import Callable, Optional

from jetbot.errors import BusStuck, FatalError, JetbotError
from jetbot.sentence import Sentence
from jetbot.supply import Reading, Supply

from ..control.supervisor import Step
from ..status.notes import NOTE_FOR
from ..status.remarks import remark

INTERVAL = 1.0      # s; there is one reading in each
START_DELAY = 0.05  # s from the start of the motors to its reading: they take their largest current at standstill, and
#                     an INA219 that averages 32 samples, as Waveshare's display sets it up, measures every 34 ms
DIP = 0.05          # of the voltage; the input of a Jetson Nano is specified as 5 V +- 5 %
DIP_WITHIN = 0.5    # s from the start of the motors
ALARM_WITHIN = 4.0  # s from it; Linux asks a Raspberry Pi's firmware every 2 s for an undervoltage since then


class SupplyWatch:
    """Reads the supply once in each second: shortly after the motors have started, if they do.

    It watches the Supervisor. A note reports the first dip. ``run`` is a thread of its own, for which no command waits;
    a supply whose reading has held up the bus is not read again.
    supply: None if nothing measures it; acceleration_limit: as the parameter. dips: how many were seen;
    settled: the last reading that is not from the start of the motors, in which a full battery may dip, too.
    """

    def __init__(self, supply: Optional[Supply], acceleration_limit: float = 0.0):
        self._supply, self._limit = supply, acceleration_limit
        self._reading, self._text = Reading(), "not read yet" if supply else "not measured"
        self._motors_started, self._started_at = threading.Event(), float("-inf")
        self._duties = 0.0, 0.0
        self._note, self._noted_at = None, float("-inf")
        self.dips = 0
        self.settled = Reading()

    def __str__(self) -> str:
        """The supply at its last reading, or why it is not known."""
        return self._text

    def __call__(self, step: Step) -> None:
        if any(new and new * old <= 0 for new, old in zip(step.duties, self._duties)):  # from a standstill, or reversed
            self._started_at = step.at
            self._motors_started.set()
        self._duties = step.duties

    def note(self, now: float) -> Optional[Sentence]:
        """Return a remark for ``NOTE_FOR`` seconds after what it reports, else None."""
        return self._note if now - self._noted_at < NOTE_FOR else None

    def run(self, publish: Callable[[Reading], None], is_over: Callable[[], bool]) -> None:
        """Read and publish once in each second. A reading without any value is a supply that does not answer."""
        publish(self.read(time.monotonic()))
        while self._supply and not is_over():
            end = time.monotonic() + INTERVAL
            started = self._motors_started.wait(INTERVAL)
            if started:
                time.sleep(START_DELAY)
            publish(self.read(time.monotonic()))
            if started:
                time.sleep(max(0.0, end - time.monotonic()))
                self._motors_started.clear()

    def read(self, now: float) -> Reading:
        """Return what the supply is at the time ``now``; one without any value if it cannot be read."""
        before, self._reading = self._reading, Reading()
        try:
            self._reading = self._supply.read()
            self._text = f"{self._reading}, by the {self._supply.sensor}"
        except JetbotError as error:
            self._text = f"unknown: {error.reason}"
            if isinstance(error, (BusStuck, FatalError)):
                self._supply = None
                self._text += "; restart the controller to read it again"
        self._check_dip(before, self._reading, now)
        if now - self._started_at >= DIP_WITHIN:
            self.settled = self._reading
        return self._reading

    def _check_dip(self, before, after, now):
        since = now - self._started_at
        lower = since < DIP_WITHIN and after.voltage < (1 - DIP) * before.voltage
        alarm = since < ALARM_WITHIN and after.undervoltage and before.undervoltage is False
        if not (lower or alarm):
            return
        self.dips += 1
        if self.dips == 1:
            code = ("dip" if lower else "undervoltage") + ("_limited" if self._limit else "")
            self._noted_at, self._note = now, remark(
                code, before=f"{before.voltage:.1f}", after=f"{after.voltage:.1f}", limit=self._limit)
