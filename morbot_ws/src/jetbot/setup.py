"""For catkin, and for pip: pip install ./morbot_ws/src/jetbot"""

from setuptools import setup

setup(name="jetbot", version="1.2.0", package_dir={"": "src"},
      description="Drives a JetBot's two motors, on any of its motor boards, and stops them when nobody does.",
      license="MIT", url="https://github.com/arieldo/MorBot", author="MorBot maintainers",
      packages=["jetbot", "jetbot.boards", "jetbot.camera", "jetbot.fake", "jetbot.guard"],
      python_requires=">=3.8", install_requires=["smbus2", "pyserial"],
      extras_require={"camera": ["traitlets", "numpy", "pillow"],
                      "notebook": ["traitlets", "numpy", "pillow", "ipywidgets"]})
