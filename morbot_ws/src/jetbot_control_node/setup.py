from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(
    packages=["jetbot_control_node",
              *(f"jetbot_control_node.{room}" for room in ("control", "odometry", "status", "supply"))],
    package_dir={"": "src"}))
