#!/usr/bin/env python3
"""Takes the pictures of the cockpit in docs: real nodes, a real cockpit, and a headless Chromium that drives.

Type: ./morbot shell docs/screenshots.py. It needs chromium, chromium-driver, python3-selenium and imagemagick.
"""

import base64
import contextlib
import os
import signal
import socket
import subprocess
import tempfile
import threading
import time
import urllib.request
from pathlib import Path
from typing import Iterator, Tuple

import rospy
from geometry_msgs.msg import Twist
from selenium import webdriver
from selenium.webdriver.chrome.service import Service

DOCS = Path(__file__).resolve().parent
PHONE, DESKTOP = (390, 844, 2), (1280, 800, 1)  # width and height in CSS pixels; pixels per CSS pixel
COLORS = 128            # of a PNG
START_TIMEOUT = 120.0   # s
CLASS = 15
SLALOM = [(0.5, 0.1, 3.5), (0.5, -0.12, 5.0), (0.6, 0.1, 5.0), (0.5, -0.05, 2.0)]  # forward, left, s


def main() -> None:
    with launched("simulation", "simulation.launch", "cockpit:=true", "cockpit_port:={}", "rviz:=false") as address:
        take(address, DESKTOP, "cockpit_desktop.png")
    with launched("simulation", "simulation.launch", "cockpit:=true", "cockpit_port:={}", "rviz:=false") as address:
        take(address, PHONE, "cockpit_phone.png")
    with launched("jetbot_cockpit", "class.launch", f"robots:={CLASS}", "cockpit_port:={}") as address, others_drive():
        take(address, DESKTOP, "cockpit_class.png")


@contextlib.contextmanager
def launched(package: str, file: str, *arguments: str) -> Iterator[str]:
    """Run a launch file, with a master of its own; {} stands for the cockpit's port. Return the page's address."""
    port, ros_port = free_port(), free_port()
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{ros_port}", ROS_HOSTNAME="localhost")
    with tempfile.TemporaryDirectory() as home:
        command = ["roslaunch", "-p", str(ros_port), package, file, *(word.format(port) for word in arguments)]
        process = subprocess.Popen(command, env={**os.environ, "HOME": home, "ROS_HOME": home}, start_new_session=True)
        try:
            wait_for_page(f"http://localhost:{port}")
            yield f"http://localhost:{port}"
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(timeout=60)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def wait_for_page(address: str) -> None:
    """Wait until the cockpit answers; raise TimeoutError if it does not start."""
    deadline = time.monotonic() + START_TIMEOUT
    while time.monotonic() < deadline:
        with contextlib.suppress(OSError), urllib.request.urlopen(address):
            return
        time.sleep(0.2)
    raise TimeoutError(f"no cockpit at {address}: read what roslaunch prints")


def take(address: str, size: Tuple[int, int, int], name: str) -> None:
    """Open the page, drive the slalom with the pad, and save what the page shows meanwhile."""
    with browser(size) as driver:
        driver.get(address)
        time.sleep(3.0)  # the robots appear
        pad = driver.find_element("id", "pad").rect
        center, radius = (pad["x"] + pad["width"] / 2, pad["y"] + pad["height"] / 2), pad["width"] / 2
        touch(driver, "touchStart", center)
        for forward, left, seconds in SLALOM:
            touch(driver, "touchMove", (center[0] - left * radius, center[1] - forward * radius))
            time.sleep(seconds)
        save(driver, DOCS / name)
        touch(driver, "touchEnd")


@contextlib.contextmanager
def browser(size: Tuple[int, int, int]) -> Iterator[webdriver.Chrome]:
    """Run a headless Chromium with a screen of this size, and touch."""
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--hide-scrollbars", *(["--no-sandbox"] if os.geteuid() == 0 else [])):
        options.add_argument(argument)
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    try:
        width, height, scale = size
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": scale, "mobile": width < height})
        driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "light"}]})
        yield driver
    finally:
        driver.quit()


def touch(driver: webdriver.Chrome, kind: str, *places: Tuple[float, float]) -> None:
    """Touch the page with one finger there, or with none."""
    driver.execute_cdp_cmd("Input.dispatchTouchEvent", {
        "type": kind, "touchPoints": [{"x": x, "y": y} for x, y in places]})


def save(driver: webdriver.Chrome, path: Path) -> None:
    png = base64.b64decode(driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"])
    subprocess.run(["convert", "png:-", "-strip", "+dither", "-colors", str(COLORS), f"PNG8:{path}"],
                   input=png, check=True)
    print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


@contextlib.contextmanager
def others_drive() -> Iterator[None]:
    """All robots of the class but the first one drive arcs of their own, without the cockpit."""
    rospy.init_node("pupils", anonymous=True, disable_signals=True)
    publishers = [rospy.Publisher(f"/jetbot_{number:02}/cmd_vel", Twist, queue_size=1)
                  for number in range(2, CLASS + 1)]
    ended = threading.Event()

    def publish():
        while not ended.wait(0.1):
            for number, publisher in enumerate(publishers):
                motion = Twist()
                motion.linear.x, motion.angular.z = 0.3 + 0.02 * number, 0.15 - 0.02 * number
                publisher.publish(motion)

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


if __name__ == "__main__":
    main()
