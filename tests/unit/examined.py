"""What the tests of the doctor share: a bare computer, and its lines."""

from jetbot import host, i2c
from jetbot_tools.doctor import camera_check, checkup, computer, jetbot_module


def lines(bus=None, port=None, address=None, board=""):
    """Return the doctor's lines, but for the one that a computer without a camera has."""
    return [str(check) for check in checkup.run_checks(bus, port, address, board) if check != camera_check.NONE]


def make_bare(monkeypatch, tmp_path):
    """Make this a computer with one package and no device, whose ROS home is this folder."""
    monkeypatch.setattr(checkup, "MODULES", ["json"])
    monkeypatch.setattr(checkup, "DEFAULT_PORT", "/dev/nowhere")
    monkeypatch.setattr(jetbot_module, "finding", lambda path: "")
    monkeypatch.setattr(host, "buses", lambda: [])
    monkeypatch.setattr(checkup, "check_users", lambda device: [])
    monkeypatch.setattr(computer, "is_free", lambda port: True)
    monkeypatch.setattr(host, "model", lambda: "")
    monkeypatch.setattr(i2c, "kernel_driver", lambda device: "")
    monkeypatch.setattr(checkup, "check_health", lambda: [])
    monkeypatch.setattr(camera_check, "DEV", tmp_path / "dev")
    monkeypatch.delenv("JETBOT_CAMERA", raising=False)
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
