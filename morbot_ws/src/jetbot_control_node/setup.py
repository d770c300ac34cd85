from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(
    packages=["jetbot", "jetbot.boards", "jetbot.fake", "jetbot.guard", "jetbot_ros", "jetbot_tools"],
    package_dir={"": "src"}))
