"""How a robot is: what computers measure whose files a test writes, what is said of it, and how a page gets it."""

import os
import threading
from types import SimpleNamespace

import pytest

from jetbot import health_sensors
from jetbot.health import BAD, OK, WARNING, judge, worst
from jetbot.health_sensors import Computer
from jetbot.supply import Reading
from jetbot.wait import wait_until
from jetbot_cockpit.robots.reports import health
from jetbot_cockpit.session.messages import HEALTH
from jetbot_cockpit.session.snapshot import RobotSnapshot
from jetbot_control_node.status.health_watch import STALE_AFTER, HealthWatch

NANO_INPUT = "sys/bus/i2c/drivers/ina3221x/6-0040/iio:device0/in_voltage0_input"
THROTTLED_4 = "sys/devices/platform/soc/soc:firmware/get_throttled"
THROTTLED_5 = "sys/devices/platform/soc@107c000000/soc@107c000000:firmware/get_throttled"


def zone(number, name, text):
    return {f"sys/class/thermal/thermal_zone{number}/type": f"{name}\n",
            f"sys/class/thermal/thermal_zone{number}/temp": f"{text}\n"}


def cooling(number, name, state):
    return {f"sys/class/thermal/cooling_device{number}/type": f"{name}\n",
            f"sys/class/thermal/cooling_device{number}/cur_state": f"{state}\n"}


def hwmon(number, name, **files):
    folder = f"sys/class/hwmon/hwmon{number}"
    return {f"{folder}/name": f"{name}\n", **{f"{folder}/{file}": f"{text}\n" for file, text in files.items()}}


def wifi(*lines):
    header = ("Inter-| sta-|   Quality        |   Discarded packets               | Missed | WE\n"
              " face | tus | link level noise |  nwid  crypt   frag  retry   misc | beacon | 22\n")
    return {"proc/net/wireless": header + "".join(f"{line}\n" for line in lines)}


NANO = {**zone(0, "AO-therm", 41500), **zone(1, "CPU-therm", 34000), **zone(2, "GPU-therm", 36000),
        **zone(4, "PMIC-Die", 100000), **zone(5, "thermal-fan-est", 99000), **cooling(0, "pwm-fan", 3),
        **cooling(1, "cpu-balanced", 0), NANO_INPUT: "5064\n"}
ORIN = {**zone(0, "cpu-thermal", 48000), **zone(1, "cv0-thermal", -256000), **zone(8, "tj-thermal", 51500),
        **cooling(0, "cpufreq-cpu0", 0), **cooling(7, "pwm-fan", 4), **cooling(8, "cpu-throttle-alert", 0),
        **hwmon(3, "soctherm_oc", oc1_event_cnt=0, oc3_event_cnt=179)}
PI_4 = {**zone(0, "cpu-thermal", 55017), THROTTLED_4: "0\n", **hwmon(1, "rpi_volt", in0_lcrit_alarm=0),
        **wifi(" wlan0: 0000   61.  -49.  -256        0      0      0      0     11        0")}
PI_5 = {**zone(0, "cpu-thermal", 60350), THROTTLED_5: "0\n", **hwmon(2, "rpi_volt", in0_lcrit_alarm=0)}
PC = {**zone(0, "acpitz", 27800), **zone(1, "x86_pkg_temp", 62000), **cooling(0, "Processor", 0)}


@pytest.fixture
def make(tmp_path):
    """Return a function that makes a computer with these files, by their paths."""
    def make(files, power_save=lambda interface: False):
        for name, text in files.items():
            file = tmp_path / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return Computer(tmp_path / "sys", tmp_path / "proc", str(tmp_path), power_save)
    return make


def without_disk(computer):
    readings = computer.read()
    assert readings.pop("megabytes") == pytest.approx(os.statvfs(computer.home).f_bavail
                                                      * os.statvfs(computer.home).f_frsize / 1e6, abs=1000)
    return readings


@pytest.mark.parametrize("files, readings", [
    (NANO, {"input_volts": 5.064, "celsius": 36.0, "throttled": 0}),
    ({**NANO, **cooling(1, "cpu-balanced", 2)}, {"input_volts": 5.064, "celsius": 36.0, "throttled": 1}),
    (ORIN, {"undervoltage": 0, "celsius": 51.5, "throttled": 0}),
    ({**ORIN, **cooling(8, "cpu-throttle-alert", 1)}, {"undervoltage": 0, "celsius": 51.5, "throttled": 1}),
    ({**ORIN, **hwmon(3, "soctherm_oc", oc1_event_cnt=2)}, {"undervoltage": 1, "celsius": 51.5, "throttled": 0}),
    (PI_4, {"undervoltage": 0, "celsius": 55.017, "throttled": 0, "dbm": -49, "power_save": 0}),
    ({**PI_4, THROTTLED_4: "50000\n"},
     {"undervoltage": 0, "celsius": 55.017, "throttled": 0, "dbm": -49, "power_save": 0}),  # it was, but is not now
    ({**PI_4, **hwmon(1, "rpi_volt", in0_lcrit_alarm=1), THROTTLED_4: "50005\n"},
     {"undervoltage": 1, "celsius": 55.017, "throttled": 1, "dbm": -49, "power_save": 0}),
    ({**PI_5, THROTTLED_5: "e0002\n"}, {"undervoltage": 0, "celsius": 60.35, "throttled": 1}),
    ({**PI_5, THROTTLED_5: "80008\n"}, {"undervoltage": 0, "celsius": 60.35, "throttled": 0}),  # a soft limit alone
    (PC, {"celsius": 62.0, "throttled": 0}), ({}, {})],
    ids=["Nano", "hot Nano", "Orin", "hot Orin", "weak Orin", "Pi 4", "Pi 4 that was slow", "weak Pi 4", "hot Pi 5",
         "warm Pi 5", "PC", "nothing"])
def test_what_a_computer_measures(make, files, readings):
    assert without_disk(make(files)) == readings


@pytest.mark.parametrize("spoilt", ["", "hot", "nan", "inf", "9" * 5000, "-5", "\0\udcff", "1e999"],
                         ids=lambda text: repr(text)[:8])
def test_a_file_that_lies_hides_no_other_and_is_not_believed(make, tmp_path, spoilt):
    computer = make({**PI_4, **zone(7, "gpu-thermal", 20000), **cooling(0, "cpufreq-cpu0", 0)})
    for name in ("class/thermal/thermal_zone0/temp", "class/thermal/cooling_device0/cur_state",
                 "class/hwmon/hwmon1/in0_lcrit_alarm", "devices/platform/soc/soc:firmware/get_throttled"):
        (tmp_path / "sys" / name).write_bytes(spoilt.encode(errors="surrogateescape"))
    rows = {row.code: row for row in judge(computer.read())}
    assert str(rows["temperature"]) == "Temperature: 20 °C." and str(rows["wifi"]) == "Wi-Fi signal: -49 dBm."


@pytest.mark.parametrize("lines, dbm", [
    ([" wlan0: 0000    0.  -256.  -256 0 0 0 0 0 0"], None),  # not connected
    ([" wlan0: 0000   70.   45.    0.  0 0 0 0 0 0"], None),  # a driver that reports a percentage
    ([" wlan0: 0000"], None), (["wlan0: 0000 x y z"], None), ([], None),
    ([" wlan0: 0000    0.  -256. -256 0 0 0 0 0 0", "wlx00c0: 0000 40. -72. -256 0 0 0 0 0 0"], -72),
    ([" wlan0: 0000   20.  -80.  -256 0 0 0 0 0 0", "wlx00c0: 0000 40. -60. -256 0 0 0 0 0 0"], -60)])  # the better one
def test_the_wifi_that_is_connected_counts(make, lines, dbm):
    asked = []
    readings = make(wifi(*lines), lambda interface: asked.append(interface) or True).read()
    assert (readings.get("dbm"), readings.get("power_save")) == (dbm, dbm and True)
    assert asked == (["wlx00c0"] if dbm else [])


def test_a_driver_that_does_not_tell_whether_the_wifi_saves_power(make):
    def unknown(interface):
        raise OSError("Operation not supported")
    readings = make(PI_4, unknown).read()
    assert readings["dbm"] == -49 and "power_save" not in readings


@pytest.mark.parametrize("disabled, saves", [(0, True), (1, False)])
def test_linux_is_asked_whether_the_wifi_saves_power(monkeypatch, disabled, saves):
    def ioctl(file, request, argument):  # struct iwreq: a name of 16 bytes, then value (4), fixed, disabled, flags
        assert (request, argument[:16], len(argument)) == (0x8B2D, b"wlan0".ljust(16, b"\0"), 32)
        return argument[:21] + bytes([disabled]) + argument[22:]
    monkeypatch.setattr(health_sensors.fcntl, "ioctl", ioctl)
    assert health_sensors.power_save("wlan0") == saves


@pytest.mark.parametrize("readings, level, text", [
    ({"volts": 12.1, "percent": 86.1}, OK, "Battery: 12.1 V, about 86 %."),
    ({"volts": 10.44, "percent": 40}, WARNING, "Battery: 10.4 V, about 40 %. Charge it before the lesson."),
    ({"volts": 9.36, "percent": 10}, BAD, "Battery: 9.4 V, about 10 %. It is empty: charge it now."),
    ({"celsius": 80}, WARNING, "Temperature: 80 °C. Let air reach the computer, and check its fan."),
    ({"megabytes": 99}, BAD, "Free disk space: 99 MB. Delete files now: soon nothing can be saved."),
    ({"dbm": -70}, WARNING, "Wi-Fi signal: -70 dBm, which is weak. Move the access point closer."),
    *((nothing, OK, "") for nothing in (  # it is in order and no number, or it cannot be
        {"undervoltage": 0, "throttled": 0, "power_save": 0}, {"celsius": 151}, {"celsius": float("nan")},
        {"percent": -1, "volts": 9}, {"dbm": 45}, {"loudness": 3}, {"volts": 12.1}))], ids=str)
def test_what_is_said_of_a_reading(readings, level, text):
    rows = judge(readings)
    assert (worst(rows), "\n".join(map(str, rows))) == (level, text)


@pytest.mark.parametrize("name, value, level", [
    ("percent", 40, WARNING), ("percent", 10, BAD), ("input_volts", 4.75, WARNING), ("undervoltage", 1, WARNING),
    ("celsius", 80, WARNING), ("celsius", 95, BAD), ("throttled", 1, WARNING), ("megabytes", 500, WARNING),
    ("megabytes", 100, BAD), ("dbm", -70, WARNING), ("dbm", -80, BAD), ("power_save", 1, WARNING)])
def test_from_which_value_on_it_is_worse(name, value, level):
    better = value + (0.1 if name in ("percent", "input_volts", "megabytes", "dbm") else -0.1)
    assert worst(judge({"volts": 10, name: value})) == level != worst(judge({"volts": 10, name: better}))


def test_a_page_gets_what_the_controller_reads_and_nothing_that_is_not_believed():
    rows = health({"volts": "12.1", "percent": "86", "celsius": "hot", "megabytes": "1e400", "dbm": "\33[2J", "x": "1"})
    message = RobotSnapshot("/", health=rows).message(None, None, None, None, 0, None, 0)["health"]
    assert message == [{"code": "battery", "template": "Battery: {volts} V, about {percent} %.",
                        "arguments": {"volts": "12.1", "percent": "86"}, "level": "ok"}]
    assert all(map(HEALTH.accepts, message))
    assert RobotSnapshot("/").message(None, None, None, None, 0, None, 0)["health"] is None


FULL = SimpleNamespace(settled=Reading(12.6, 1.0))


def test_a_sensor_that_hangs_is_forgotten_after_a_while_and_the_battery_is_not():
    watch, hangs, ended = HealthWatch(FULL), threading.Event(), threading.Event()
    answers = iter([{"celsius": 48.0}])

    def read():
        for answer in answers:
            return answer
        hangs.set()
        ended.wait()
        return {}

    thread = threading.Thread(target=watch.run, args=[read, lambda seconds: ended.is_set()], daemon=True)
    thread.start()
    try:
        assert hangs.wait(10.0)
        now = health_watch_time(watch)
        assert watch.readings(now) == {"volts": 12.6, "percent": 100, "celsius": 48.0}
        assert watch.readings(now + STALE_AFTER) == {"volts": 12.6, "percent": 100}
    finally:
        ended.set()
    assert wait_until(lambda: not thread.is_alive(), 10.0)


def health_watch_time(watch):
    """Return when the computer was last read."""
    return watch._computer[0]


def test_the_terminal_reads_each_warning_once():
    watch = HealthWatch(FULL)
    low, empty = (judge({"volts": 10.0, "percent": percent}) for percent in (30, 5))
    assert [watch.news(rows) for rows in (low, low, empty, low, judge({"celsius": 48}))] == [low, [], empty, [], []]
