from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["jetbot_tools", "jetbot_tools.calibration", "jetbot_tools.doctor"],
                                 package_dir={"": "src"}))
