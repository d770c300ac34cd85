import pytest

from jetbot import host


@pytest.mark.parametrize("name, bus", [
    ("NVIDIA Jetson Nano Developer Kit", 1), ("NVIDIA Jetson Xavier NX Developer Kit", 8),
    ("NVIDIA Jetson Orin Nano Developer Kit", 7), ("Raspberry Pi 4 Model B Rev 1.4", 1), ("A PC", None), ("", None)])
def test_robot_bus(name, bus):
    assert host.robot_bus(name) == bus


def test_model(tmp_path):
    (tmp_path / "model").write_text("NVIDIA Jetson Nano Developer Kit\0")
    assert host.model(tmp_path / "model") == "NVIDIA Jetson Nano Developer Kit"
    assert host.model(tmp_path / "none") == ""


def test_buses_by_number(tmp_path):
    for name in ("i2c-10", "i2c-2", "i2c-1", "tty1"):
        (tmp_path / name).touch()
    assert [path.name for path in host.buses(tmp_path)] == ["i2c-1", "i2c-2", "i2c-10"]


FAKE = "Without a robot: i2c_bus:=fake (with rosrun, _i2c_bus:=fake)."


@pytest.mark.parametrize("model, buses, sentence", [
    ("Jetson Nano", ["/dev/i2c-0", "/dev/i2c-1"], "This computer has /dev/i2c-0, /dev/i2c-1. "
     "On a Jetson Nano the motors are on bus 1: i2c_bus:=1. " + FAKE),
    ("", [], "This computer has no /dev/i2c-* at all. " + FAKE),
])
def test_bus_advice(monkeypatch, model, buses, sentence):
    monkeypatch.setattr(host, "model", lambda: model)
    monkeypatch.setattr(host, "buses", lambda: buses)
    assert host.bus_advice() == sentence
