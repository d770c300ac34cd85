"""For catkin, and for pip: pip install ./morbot_ws/src/jetbot"""

from setuptools import setup

setup(name="jetbot", version="1.0.0", package_dir={"": "src"},
      packages=["jetbot", "jetbot.boards", "jetbot.camera", "jetbot.fake", "jetbot.guard"],
      python_requires=">=3.8", install_requires=["smbus2", "pyserial"],
      extras_require={"camera": ["traitlets", "numpy", "pillow"],
                      "notebook": ["traitlets", "numpy", "pillow", "ipywidgets"]})
