"""For catkin, and for pip: pip install ./morbot_ws/src/jetbot"""

from pathlib import Path

from setuptools import setup

URL = "https://github.com/arieldo/MorBot"

setup(name="jetbot", version="1.2.0", package_dir={"": "src"},
      description="Drives a JetBot's two motors, on any of its motor boards, and stops them when nobody does.",
      long_description=Path(__file__).with_name("README.md").read_text(encoding="utf-8"),
      long_description_content_type="text/markdown",
      license="MIT", url=URL, project_urls={"Changelog": f"{URL}/blob/main/morbot_ws/src/jetbot/CHANGELOG.rst"},
      author="MorBot maintainers", author_email="morbot@users.noreply.github.com",
      classifiers=["Intended Audience :: Education", "Operating System :: POSIX :: Linux",
                   "Programming Language :: Python :: 3", "Topic :: Scientific/Engineering", "Typing :: Typed"],
      packages=["jetbot", "jetbot.boards", "jetbot.camera", "jetbot.fake", "jetbot.guard"],
      package_data={"jetbot": ["py.typed"]}, zip_safe=False,
      python_requires=">=3.8", install_requires=["smbus2", "pyserial"],
      extras_require={"camera": ["traitlets", "numpy", "pillow"],
                      "notebook": ["traitlets", "numpy", "pillow", "ipywidgets"]})
