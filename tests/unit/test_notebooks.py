"""NVIDIA's notebooks for the JetBot, unchanged, cell by cell, on a fake bus and a fake camera.

MORBOT_NOTEBOOKS names a folder with basic_motion.ipynb, teleoperation.ipynb, and the two data_collection.ipynb, in
whatever folders or with whatever prefixes: https://github.com/NVIDIA-AI-IOT/jetbot, MIT license.
"""

import importlib.util
import json
import os
import sys
import types
from pathlib import Path

import pytest

from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until

NOTEBOOKS = os.environ.get("MORBOT_NOTEBOOKS")
if not NOTEBOOKS:
    pytest.skip("MORBOT_NOTEBOOKS names no folder with NVIDIA's notebooks", allow_module_level=True)
missing = [name for name in ("ipywidgets", "IPython", "numpy", "PIL") if not importlib.util.find_spec(name)]
if missing:
    pytest.fail(f"The notebooks need {', '.join(missing)}: "
                "sudo apt install python3-ipywidgets python3-ipython python3-numpy python3-pil", pytrace=False)
import ipywidgets  # noqa: E402
from IPython.core.interactiveshell import InteractiveShell  # noqa: E402
from ipywidgets.widgets import widget_controller  # noqa: E402

import jetbot.robot  # noqa: E402


class ClickableImageWidget(ipywidgets.Image):
    """In place of NVIDIA's own widget, which is no Debian package."""


@pytest.fixture
def shell(tmp_path, monkeypatch):
    """A shell that runs the cells of a notebook, in a folder of its own; what they start ends with it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("JETBOT_I2C_BUS", f"fake:{tmp_path / 'bus'}")
    monkeypatch.setenv("JETBOT_CAMERA", "fake")
    monkeypatch.setitem(sys.modules, "cv2", types.SimpleNamespace(circle=lambda picture, *_: picture))
    monkeypatch.setitem(sys.modules, "jupyter_clickable_image_widget",
                        types.SimpleNamespace(ClickableImageWidget=ClickableImageWidget))
    shell = InteractiveShell()
    yield shell
    for each in shell.user_ns.values():
        if isinstance(each, jetbot.Heartbeat):
            each.stop()
    jetbot.robot.close_all(jetbot.robot.open_robots)


def cells(name):
    """Return the sources of the code cells of a notebook."""
    file, = (file for file in Path(NOTEBOOKS).rglob("*.ipynb") if name in str(file.relative_to(NOTEBOOKS)))
    return ["".join(cell["source"]) for cell in json.loads(file.read_text())["cells"] if cell["cell_type"] == "code"]


def run(shell, sources):
    for source in sources:
        shell.run_cell(source).raise_error()


def is_jpeg(data):
    return data[:2] == b"\xff\xd8" and data[-2:] == b"\xff\xd9"


def test_basic_motion(shell, tmp_path):
    sources = cells("basic_motion")
    link, unlink = (next(i for i, source in enumerate(sources) if word in source) for word in (
        "traitlets.link", "unlink"))
    run(shell, sources[:link + 1])
    names = shell.user_ns
    names["left_slider"].value = 0.4
    assert wheel_speeds(tmp_path / "bus") == (pytest.approx(0.4, abs=0.001), 0)
    run(shell, sources[link + 1:unlink + 1])
    names["left_slider"].value = 0.1
    assert wheel_speeds(tmp_path / "bus") == (0, 0)
    run(shell, sources[unlink + 1:])
    assert (names["left_slider"].value, names["right_slider"].value) == (-0.2, 0.2)
    assert wheel_speeds(tmp_path / "bus") == pytest.approx((-0.2, 0.2), abs=0.001)
    assert wait_until(lambda: wheel_speeds(tmp_path / "bus") == (0, 0), 10)  # no page answers the heartbeat
    assert wait_until(lambda: names["left_slider"].value == 0, 10)


def test_teleoperation(shell, tmp_path):
    sources = cells("teleoperation")
    shell.run_cell(sources[0]).raise_error()
    names = shell.user_ns
    names["controller"].set_trait("axes", [widget_controller.Axis() for _ in range(4)])
    names["controller"].set_trait("buttons", [widget_controller.Button() for _ in range(6)])
    run(shell, sources[1:-1])
    assert is_jpeg(names["image"].value)
    names["controller"].axes[1].set_trait("value", -0.5)
    assert wheel_speeds(tmp_path / "bus") == (pytest.approx(0.5, abs=0.001), 0)
    names["controller"].buttons[5].set_trait("value", 1.0)
    assert is_jpeg(next((tmp_path / "snapshots").glob("*.jpg")).read_bytes())
    assert wait_until(lambda: wheel_speeds(tmp_path / "bus") == (0, 0), 10)
    run(shell, sources[-1:])


def test_data_for_collision_avoidance(shell, tmp_path):
    *sources, stop, archive = cells("collision_avoidance")
    run(shell, sources)
    shell.user_ns["free_button"]._handle_button_msg(None, {"event": "click"}, [])
    assert shell.user_ns["free_count"].value == 1
    assert is_jpeg(next((tmp_path / "dataset/free").iterdir()).read_bytes())
    run(shell, [stop, archive])


def test_data_for_road_following(shell, tmp_path):
    *sources, stop, archive = cells("road_following")
    run(shell, sources)
    click = {"event": "click", "eventData": {"offsetX": 100, "offsetY": 50}}
    shell.user_ns["camera_widget"]._handle_custom_msg(click, [])
    file, = (tmp_path / "dataset_xy").iterdir()
    assert file.name.startswith("xy_100_050_") and is_jpeg(file.read_bytes())
    assert is_jpeg(shell.user_ns["snapshot_widget"].value)
    run(shell, [stop, archive])
    assert os.listdir(tmp_path / "dataset_xy") == [file.name]
