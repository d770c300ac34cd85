"""A package that cannot be read or built is marked with the reason, and the others are built; no real catkin_make."""

import os

import pytest

pytest.importorskip("catkin_pkg")
import build  # noqa: E402

XML = """<?xml version="1.0"?>
<package format="2">
  <name>mine</name>
  <version>0.0.1</version>
  <description>Mine.</description>
  <maintainer email="me@example.com">Me</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
</package>
"""
FIND_PACKAGE = """-- ==> add_subdirectory(scenarios/workshop)
-- +++ processing catkin package: 'mine'
-- ==> add_subdirectory(mine)
-- Could NOT find no_such_pkg (missing: no_such_pkg_DIR)
CMake Error at /usr/share/catkin/cmake/catkinConfig.cmake:82 (find_package):
  Could not find a package configuration file provided by "no_such_pkg" with
  any of the following names:

Call Stack (most recent call first):
  mine/CMakeLists.txt:10 (find_package)


-- Configuring incomplete, errors occurred!
"""
COMPILER = """[ 50%] Building CXX object mine/CMakeFiles/node.dir/node.cpp.o
/ws/src/mine/node.cpp:1:10: fatal error: nothing.h: No such file or directory
make[2]: *** [mine/CMakeFiles/node.dir/build.make:76: mine/CMakeFiles/node.dir/node.cpp.o] Error 1
"""
CIRCULAR = """CMake Error at build/catkin_generated/order_packages.cmake:79 (message):
  Circular dependency in subset of packages:

  mine, other
Call Stack (most recent call first):
"""
CATKIN_MAKE = """#!/bin/sh
echo built >>{0}/builds
[ ! -e {0}/log ] || [ -e {0}/src/mine/CATKIN_IGNORE ] || {{ cat {0}/log; exit 1; }}
"""


@pytest.fixture
def source(tmp_path, monkeypatch):
    """A source folder with the packages workshop and mine; catkin_make fails with the file ``log`` until mine is left
    out.
    """
    add(tmp_path / "src/scenarios/workshop", XML.replace("mine", "workshop"))
    add(tmp_path / "src/mine", XML)
    (tmp_path / "build").mkdir()
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/catkin_make").write_text(CATKIN_MAKE.format(tmp_path))
    (tmp_path / "bin/catkin_make").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}/bin:{os.environ['PATH']}")
    return tmp_path / "src"


def add(folder, text):
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(text)


def reasons(source):
    """Build; return {folder: reason} of the packages that are left out."""
    build.main(source, source.parent / "build", source.parent / "devel")
    return {str(marker.parent.relative_to(source)): marker.read_text() for marker in source.rglob(build.MARKER)}


def test_nothing_is_left_out_of_a_healthy_workspace(source):
    assert reasons(source) == {}


@pytest.mark.parametrize("now, then, reason", [
    ("</license>", "", "mismatched tag: line 9"), (XML, "", "no element found"), ("Mine.", "black & white", "line 5"),
    ("  <version>0.0.1</version>\n", "", 'exactly one "version" tag'),
    ("</package>", "<export><build_type>ament_python</build_type></export></package>", "is for ament_python")])
def test_a_package_that_catkin_cannot_read(source, now, then, reason):
    (source / "mine/package.xml").write_text(XML.replace(now, then))
    (folder, sentence), = reasons(source).items()
    assert folder == "mine" and reason in sentence
    assert sentence.startswith(f"morbot: {source}/mine is left out: ") and sentence.endswith("then: ./morbot setup\n")
    assert sentence.count("\n") == 1


@pytest.mark.parametrize("log, reason", [
    (FIND_PACKAGE, 'mine/CMakeLists.txt:10 CMake Error at /usr/share/catkin/cmake/catkinConfig.cmake:82 '
                   '(find_package): Could not find a package configuration file provided by "no_such_pkg"'),
    (COMPILER, "/ws/src/mine/node.cpp:1:10: fatal error: nothing.h: No such file or directory"),
    (CIRCULAR, "Circular dependency in subset of packages: mine, other")])
def test_a_package_that_cannot_be_built(source, log, reason):
    (source.parent / "log").write_text(log)
    (folder, sentence), = reasons(source).items()
    assert folder == "mine" and reason in sentence
    assert (source.parent / "builds").read_text() == 2 * "built\n"


def test_a_corrected_package_is_built_again(source):
    (source / "mine/package.xml").write_text("<package>")
    assert reasons(source)
    (source / "mine/package.xml").write_text(XML)
    assert reasons(source) == {}


def test_a_marker_of_the_users_own_stays(source):
    (source / "mine/package.xml").write_text("<package>")
    (source / "mine/CATKIN_IGNORE").write_text("")
    assert reasons(source) == {"mine": ""}


def test_of_two_packages_of_one_name_the_copy_is_left_out(source):
    add(source / "a_copy", XML.replace("mine", "workshop"))
    (folder, sentence), = reasons(source).items()
    assert folder == "a_copy" and f"has the same <name> as {source}/scenarios/workshop" in sentence


def test_a_package_xml_that_hides_all_others_is_named(source):
    (source / "package.xml").write_text(XML)
    with pytest.raises(SystemExit, match="hides all packages in its folder: mv .*/src/package.xml ~"):
        reasons(source)


def test_a_failure_of_no_package_ends_the_build(source):
    (source.parent / "log").write_text("cp: error writing: No space left on device\n")
    with pytest.raises(SystemExit, match="No space left on device\n\nmorbot: the build failed"):
        reasons(source)
