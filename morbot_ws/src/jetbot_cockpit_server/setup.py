from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

PACKAGES = ["jetbot_cockpit_server"] + [f"jetbot_cockpit_server.{room}" for room in ("robots", "session", "web")]
setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
