"""RViz with one configuration, for a robot in any namespace; it is restarted when it crashes."""

import os
import runpy

import pytest

from conftest import SIMULATION

CONFIG = SIMULATION / "rviz/simulation.rviz"


@pytest.mark.parametrize("end, code, crashes, namespace, changed", [
    ("exit 1", 1, 0, "/", set()), ("kill -SEGV $$", -11, 3, "", set()),
    ("kill -ABRT $$", -6, 3, "/red", {'      TF Prefix: "red"', '      Target Frame: "red/base_footprint"'})])
def test_restarts_when_it_crashes(tmp_path, monkeypatch, capfd, end, code, crashes, namespace, changed):
    rviz = tmp_path / "rviz"
    rviz.write_text(f'#!/bin/sh\ncp "$2" {tmp_path}/config\nprintf %s "$2" >{tmp_path}/title\n{end}\n')
    rviz.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    monkeypatch.setenv("ROS_NAMESPACE", namespace)
    assert runpy.run_path(str(SIMULATION / "scripts/show_in_rviz.py"))["main"](CONFIG) == code
    assert capfd.readouterr().out == "".join(f"RViz crashed, {tries + 1} of 3 times\n" for tries in range(crashes))
    assert (tmp_path / "title").read_text() == f"MorBot {namespace.strip('/')}".strip()
    config = (tmp_path / "config").read_text()
    before = CONFIG.read_text().replace("Frame: base_footprint", 'Frame: "base_footprint"')
    assert set(config.splitlines()) - set(before.splitlines()) == changed
