from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

ROOMS = "classroom", "remote", "robots", "session", "web"
PACKAGES = ["jetbot_cockpit", *(f"jetbot_cockpit.{room}" for room in ROOMS)]

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
