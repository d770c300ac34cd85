from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

ROOMS = ["driving_tasks", "driving_tasks.report", "driving_tasks.scoring", "driving_tasks.sources"]
setup(**generate_distutils_setup(packages=ROOMS, package_dir={"": "src"}))
