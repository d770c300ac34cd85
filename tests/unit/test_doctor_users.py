"""Which other programs the doctor finds on a bus or port."""

import os
import subprocess

import pytest

from jetbot_tools import probe


def test_who_else_has_a_device_open(tmp_path):
    device = tmp_path / "i2c-1"
    device.touch()
    assert probe.check_users(str(tmp_path / "none")) == []
    with device.open() as file:
        assert str(probe.check_users(str(device))[0]).startswith(f"ok  {device}: no other program")
        other = subprocess.Popen(["sleep", "60"], stdin=file)
    checks = probe.check_users(str(device))
    other.kill()
    other.wait()
    assert [str(check) for check in checks] == [
        f"NOT {device}: also open in sleep ({other.pid}). Two programs on one motor board disturb each other: "
        "end one of them."]


@pytest.mark.parametrize("cgroup, cmdline", [
    ("0::/system.slice/jetbot_stats.service", "python3"), ("0::/docker/1", "python3 -m jetbot.apps.stats"),
    ("0::/user.slice", "/usr/bin/python3 /home/jetbot/jetbot/jetbot/apps/stats.py")])
def test_the_service_of_the_jetbots_display_may_have_the_bus_open(tmp_path, monkeypatch, cgroup, cmdline):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    device = tmp_path / "i2c-1"
    device.touch()
    proc = tmp_path / "proc"
    add_process(proc / "7", device, cgroup, cmdline)
    assert [str(check) for check in probe.check_users(str(device), proc)] == [
        f"ok  {device}: no other program has it open but the service of the JetBot's display, which is normal."]
    add_process(proc / "8", device, "0::/user.slice", "python3 drive.py")
    assert [str(check) for check in probe.check_users(str(device), proc)] == [
        f"NOT {device}: also open in drive.py (8). Two programs on one motor board disturb each other: "
        "end one of them."]


def add_process(folder, device, cgroup, cmdline):
    """Make a process's folder in a fake /proc. cmdline: words without spaces."""
    (folder / "fd").mkdir(parents=True)
    (folder / "fd/3").symlink_to(device)
    (folder / "cgroup").write_text(cgroup + "\n")
    (folder / "cmdline").write_text(cmdline.replace(" ", "\0") + "\0")
