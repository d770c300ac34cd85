"""Which package could not be built, where the error is and what to do, from what catkin_make printed."""

from pathlib import Path

import pytest

from build_log import failures, summary
from manifest import Package

SOURCE = Path("/ws/src")
PACKAGES = [Package(name, SOURCE / "scenarios" / name, "catkin") for name in ("mine", "other", "third")]
LOG = """-- +++ processing catkin package: 'other'
-- ==> add_subdirectory(scenarios/other)
-- +++ processing catkin package: 'mine'
-- ==> add_subdirectory(scenarios/mine)
{}
-- Configuring incomplete, errors occurred!
make: *** [Makefile:576: cmake_check_build_system] Error 1
"""


@pytest.mark.parametrize("error, sentence", [
    ("""-- Could NOT find no_such_pkg (missing: no_such_pkg_DIR)
CMake Error at /usr/share/catkin/cmake/catkinConfig.cmake:82 (find_package):
  Could not find a package configuration file provided by "no_such_pkg" with
  any of the following names:

    no_such_pkgConfig.cmake

Call Stack (most recent call first):
  scenarios/mine/CMakeLists.txt:10 (find_package)
""", "CMakeLists.txt, line 10: there is no package no_such_pkg to build with: correct its name, or install it."),
    ("""CMake Error at scenarios/mine/CMakeLists.txt:105:
  Parse error.  Expected "(", got newline with text "

  ".
""", "CMakeLists.txt, line 105: a bracket or a quote is missing there or before: add it."),
    ("""CMake Error at /usr/share/catkin/cmake/catkin_package_xml.cmake:54 (message):
  catkin_package_xml() package name 'mine' in '/ws/src/scenarios/mine/package.xml'
  does not match current PROJECT_NAME 'yours'.  You must call project() with the
  same package name before.
Call Stack (most recent call first):
  /usr/share/catkin/cmake/catkin_package.cmake:99 (catkin_package_xml)
  scenarios/mine/CMakeLists.txt:104 (catkin_package)
""", "CMakeLists.txt, line 104: write project(mine): the same name as in package.xml."),
    ("""CMake Error at /usr/share/catkin/cmake/catkin_install_python.cmake:86 (message):
  catkin_install_python() called with non-existing file
  '/ws/src/scenarios/mine/scripts/drive.py'.
Call Stack (most recent call first):
  scenarios/mine/CMakeLists.txt:206 (catkin_install_python)
""", "CMakeLists.txt, line 206: there is no file /ws/src/scenarios/mine/scripts/drive.py: correct its name."),
    ("""CMake Error at scenarios/mine/CMakeLists.txt:7 (catkin_instal):
  Unknown CMake command "catkin_instal".
""", "CMakeLists.txt, line 7: there is no command catkin_instal: correct its name."),
    ("""CMake Error at /usr/share/catkin/cmake/catkin_workspace.cmake:121 (add_subdirectory):
  The source directory

    /ws/src/scenarios/mine

  does not contain a CMakeLists.txt file.
Call Stack (most recent call first):
  CMakeLists.txt:68 (catkin_workspace)
""", "CMakeLists.txt: there is no such file: write one, or mv /ws/src/scenarios/mine ~."),
    ("""CMake Error at scenarios/mine/CMakeLists.txt:3 (set):
  set given invalid arguments for CACHE mode.
""", "CMakeLists.txt, line 3: set given invalid arguments for CACHE mode.")])
def test_cmake_error(error, sentence):
    found = failures(LOG.format(error), PACKAGES, SOURCE)
    assert found == {"mine": f"/ws/src/scenarios/mine/{sentence} Until then, mine is not built."}


def test_several_errors_in_one_log():
    error = "CMake Error at scenarios/{0}/CMakeLists.txt:3 (bad):\n  Unknown CMake command \"bad\".\n"
    log = LOG.format(error.format("mine")) .replace("other)\n", "other)\n" + error.format("other"))
    assert list(failures(log, PACKAGES, SOURCE)) == ["mine", "other"]


def test_compiler_error():
    log = ("/ws/src/scenarios/mine/src/a.cpp:1:10: fatal error: nothing.h: No such file or directory\n"
           "make[2]: *** [scenarios/mine/CMakeFiles/node.dir/build.make:76: scenarios/mine/CMakeFiles/a.o] Error 1\n")
    assert failures(log, PACKAGES, SOURCE) == {
        "mine": "/ws/src/scenarios/mine/src/a.cpp, line 1: nothing.h: No such file or directory. "
                "Until then, mine is not built."}


def test_packages_that_need_each_other():
    found = failures("CMake Error:\n  Circular dependency in subset of packages:\n\n  mine, third\n", PACKAGES, SOURCE)
    assert list(found) == ["mine", "third"]
    assert found["mine"].startswith("/ws/src/scenarios/mine/package.xml: mine and a package that it needs also need ")


def test_an_error_of_no_package():
    log = LOG.format("").replace("mine", "else") + "c++: fatal error: Killed signal terminated program cc1plus\n"
    assert failures(log, PACKAGES, SOURCE) == {}
    assert "Killed signal" in summary(log)
    assert summary("cp: error writing: No space left on device") == "the disk is full; make room on it"
