from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["jetbot_class", "jetbot_class.fleet", "jetbot_class.robot"],
                                 package_dir={"": "src"}))
