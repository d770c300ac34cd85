from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["driving_tasks", "driving_tasks.sources"], package_dir={"": "src"}))
