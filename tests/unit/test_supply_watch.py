"""The supply is read once a second, shortly after the motors start if they do; what is wrong is reported once."""

import threading
import time

import pytest

from conftest import step_of
from jetbot import JetbotError
from jetbot.supply import Reading, Supply, percentage
from jetbot.wait import wait_until
from jetbot_control_node.status.notes import NOTE_FOR
from jetbot_control_node.supply import supply_watch
from jetbot_control_node.supply.supply_watch import ALARM_WITHIN, DIP_WITHIN, START_DELAY, SupplyWatch

STOPPED, AHEAD, BACK = (0.0, 0.0), (0.4, 0.6), (-0.4, -0.6)


class Sensor:
    """A sensor that reads as ``reading``, which may be an error, and counts how often."""

    def __init__(self, reading):
        self.reading, self.count = reading, 0

    def read(self):
        self.count += 1
        if isinstance(self.reading, Exception):
            raise self.reading
        return self.reading


def volts(value):
    return Reading(value, percentage(value))


@pytest.fixture
def sensor():
    return Sensor(volts(12.0))


@pytest.fixture
def watch(sensor):
    watch = SupplyWatch(Supply("INA219", sensor.read))
    watch.read(now=0.0)
    watch(step_of(STOPPED, 0.0))
    return watch


def start(watch, sensor, reading, now, after=START_DELAY):
    """Start the motors, and read this ``after`` seconds later; return the note."""
    watch(step_of(AHEAD, now))
    sensor.reading = reading
    watch.read(now + after)
    return watch.note(now + after)


def stop(watch, sensor, now):
    sensor.reading = volts(12.0)
    watch.read(now)
    watch(step_of(STOPPED, now))


@pytest.mark.parametrize("limit, advice", [
    (0, "set acceleration_limit:=1"), (2.5, "lower acceleration_limit (now 2.5)")])
def test_a_dip_is_reported_once_with_advice(sensor, limit, advice):
    watch = SupplyWatch(Supply("INA219", sensor.read), acceleration_limit=limit)
    watch.read(now=0.0)
    note = start(watch, sensor, volts(11.1), now=1.0)
    assert str(note) == f"its supply dips from 12.0 to 11.1 V as the motors start: {advice}"
    assert watch.note(1.0 + NOTE_FOR - 0.1)
    assert watch.note(1.1 + NOTE_FOR) is None
    stop(watch, sensor, now=9.0)
    assert start(watch, sensor, volts(11.1), now=10.0) is None
    assert watch.dips == 2


def test_what_the_battery_reads_as_the_motors_start_is_not_its_charge(watch, sensor):
    start(watch, sensor, volts(9.0), now=1.0)
    assert (watch.dips, watch.settled) == (1, volts(12.0))
    watch.read(now=1.0 + DIP_WITHIN)
    assert watch.settled == volts(9.0)


@pytest.mark.parametrize("before, reading, after", [
    (volts(12.0), volts(11.5), START_DELAY), (volts(12.0), volts(11.1), DIP_WITHIN), (volts(12.0), volts(0.0), 5.0),
    (Reading(undervoltage=True), Reading(undervoltage=True), START_DELAY)])
def test_what_is_small_or_long_after_the_start_or_from_before_it_is_no_dip(watch, sensor, before, reading, after):
    sensor.reading = before
    watch.read(now=0.5)
    assert start(watch, sensor, reading, now=1.0, after=after) is None
    assert watch.dips == 0


@pytest.mark.parametrize("duties, dips", [((0.8, 0.9), 0), (BACK, 1)], ids=["faster", "reversed"])
def test_wheels_that_turn_already_start_again_only_as_they_reverse(watch, sensor, duties, dips):
    start(watch, sensor, volts(12.0), now=1.0)
    sensor.reading = volts(11.0)
    watch(step_of(duties, 5.0))
    watch.read(now=5.1)
    assert watch.dips == dips


def test_a_raspberry_pi_reports_an_undervoltage_some_seconds_later(watch, sensor):
    sensor.reading = Reading(undervoltage=False)
    watch.read(now=0.5)
    note = start(watch, sensor, Reading(undervoltage=True), now=1.0, after=ALARM_WITHIN - 0.5)
    assert str(note) == "its supply dips as the motors start: set acceleration_limit:=1"
    assert str(watch) == "undervoltage, by the INA219"


def test_a_sensor_that_is_unplugged_is_reported_and_read_again(watch, sensor):
    assert watch.settled.battery == {"volts": 12.0, "percent": pytest.approx(83.3, abs=0.1)}
    assert start(watch, sensor, JetbotError("no answer from 0x41"), now=1.0) is None
    assert str(watch) == "unknown: no answer from 0x41"
    watch.read(now=1.0 + DIP_WITHIN)
    assert watch.settled.battery == {}
    sensor.reading = volts(11.0)
    assert watch.read(now=9.0) == volts(11.0)
    assert (str(watch), watch.dips) == ("11.00 V, 56 %, by the INA219", 0)
    assert str(SupplyWatch(None)) == "not measured"


@pytest.fixture
def moments(watch, monkeypatch):
    """The moments of the thread's readings, one in each 0.4 s."""
    monkeypatch.setattr(supply_watch, "INTERVAL", 0.4)
    moments, over = [], threading.Event()
    threading.Thread(target=watch.run, args=[lambda reading: moments.append(time.monotonic()), over.is_set],
                     daemon=True).start()
    yield moments
    over.set()


def test_a_start_of_the_motors_has_a_reading_of_its_own_but_no_interval_has_two(watch, moments):
    assert wait_until(lambda: moments, 10.0)
    begin = time.monotonic()
    while len(moments) < 4:
        watch(step_of(AHEAD, time.monotonic()))
        watch(step_of(STOPPED, time.monotonic()))
        time.sleep(0.01)
    assert START_DELAY <= moments[1] - begin < 0.4
    assert moments[3] - begin >= 2 * 0.4
