"""Of a workspace with broken packages, the others stay in use, and each broken one is reported with file and cure."""

import os

import pytest

pytest.importorskip("catkin_pkg")

from jetbot_tools.manifest import Problem, read_package  # noqa: E402
from jetbot_tools.packages import find_packages  # noqa: E402

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


@pytest.fixture
def source(tmp_path):
    """A workspace's source folder with the packages `workshop` and `mine`."""
    add(tmp_path / "src/scenarios/workshop", XML.replace("mine", "workshop"))
    add(tmp_path / "src/mine", XML)
    return tmp_path / "src"


def add(folder, text):
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(text)


def names(source, known=()):
    return [package.name for package in find_packages(source, known)[0]]


def test_a_healthy_workspace(source):
    packages, problems = find_packages(source)
    assert [package.name for package in packages] == ["mine", "workshop"] and problems == []


@pytest.mark.parametrize("now, then, problem", [
    ("</license>", "", ", line 7: <license> has no end: add </license>."),
    ("</license>", "</licence>", ", line 7: <license> has no end: add </license>."),
    ("</package>\n", "", ", line 2: <package> has no end: add </package>."),
    ("Mine.", "black & white", ", line 5: not well-formed (invalid token): add a missing quote, < or >; write &amp; "),
    ('email="me', "email=me", ", line 6: not well-formed (invalid token): add a missing quote"),
    (XML, "", " is empty: make it again with catkin_create_pkg, or remove its folder."),
    ("?>", ' encoding="klingon"?>', ', line 1: unknown encoding: klingon: write encoding="utf-8".'),
    ("  <version>0.0.1</version>\n", "", ': The manifest must contain exactly one "version" tag: add <version>0.0.1</'),
    ("  <license>MIT</license>\n", "", ': The package node must contain at least one "license" tag: add <license>'),
    ("0.0.1", "1", ': Package version "1" does not follow version conventions: correct it.'),
    ("<name>mine", "<name>My Robot", ': Package name "My Robot" does not follow naming conventions: correct it.')])
def test_a_package_xml_that_cannot_be_read(source, now, then, problem):
    file = source / "mine/package.xml"
    file.write_text(XML.replace(now, then))
    packages, [sentence] = find_packages(source)
    assert sentence.startswith(f"{file}{problem}")
    assert sentence.endswith(" Until then, the package is used as it was last built, or left out.")


@pytest.mark.parametrize("make, problem", [
    (os.mkfifo, " is not a regular file: mv "), (os.mkdir, " is not a regular file: mv "),
    (lambda file: file.symlink_to("nowhere"), " is a link that leads nowhere: rm "),
    (lambda file: os.truncate(open(file, "w").name, 50 * 10**9), " is too large to describe a package: mv "),
    (lambda file: file.write_bytes(b"<package>\n\xfc"), ", line 2: this is not text in UTF-8: save the file in this ")])
def test_a_package_xml_that_is_no_text(source, make, problem):
    file = source / "mine/package.xml"
    file.unlink()
    make(file)
    packages, [sentence] = find_packages(source)
    assert sentence.startswith(f"{file}{problem}")
    assert [package.name for package in packages] == ["workshop"]


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_a_build_file_that_is_no_file(source, make):
    make(source / "mine/CMakeLists.txt")
    packages, [sentence] = find_packages(source)
    assert f"{source}/mine/CMakeLists.txt is not a regular file: mv {source}/mine ~." in sentence
    assert [package.name for package in packages] == ["workshop"]


def test_a_folder_that_would_be_two_in_a_search_path(source):
    (source / "mine").rename(source / "mine:too")
    with pytest.raises(Problem, match="rename its folder 'mine:too', without : and ;"):
        read_package(source / "mine:too")


def test_a_copy_is_left_out_and_not_the_original(source):
    add(source / "copy", XML.replace("mine", "workshop"))
    packages, [sentence] = find_packages(source)
    assert source / "scenarios/workshop" in [package.folder for package in packages]
    assert sentence == (
        f"{source}/copy/package.xml has the same <name> as {source}/scenarios/workshop: write <name>copy</name> there "
        f"and project(copy) in its CMakeLists.txt, or mv {source}/copy ~. The copy is left out until then.")


def test_a_copy_whose_folder_bears_the_name_too_is_the_one_that_was_not_built(source):
    add(source / "workshop", XML.replace("mine", "workshop"))
    os.utime(source / "workshop/package.xml", (0, 0))
    assert source / "workshop" in [package.folder for package in find_packages(source)[0]]
    known = [source / "scenarios/workshop"]
    assert known[0] in [package.folder for package in find_packages(source, known)[0]]


@pytest.mark.parametrize("target", ["..", "../mine", "."])
def test_a_link_that_leads_back_into_the_workspace(source, target):
    link = source / "scenarios/again"
    link.symlink_to(target)
    packages, problems = find_packages(source)
    assert problems == [f"{link} leads to a folder that ROS searches already: rm {link}"]
    assert len(packages) == 2


def test_a_link_to_a_package_elsewhere_is_followed(source, tmp_path):
    add(tmp_path / "project", XML.replace("mine", "theirs"))
    (source / "theirs").symlink_to(tmp_path / "project")
    assert names(source) == ["mine", "theirs", "workshop"]


@pytest.mark.parametrize("folder", [".", "scenarios"])
@pytest.mark.parametrize("text", ["<package", XML.replace("mine", "other")])
def test_a_package_xml_beside_packages_does_not_hide_them(source, folder, text):
    file = (source / folder / "package.xml")
    file.write_text(text)
    packages, [sentence] = find_packages(source)
    assert sentence == f"{file} hides the packages in its folder from ROS: mv {file} ~"


def test_a_folder_with_catkin_ignore_is_not_read(source):
    (source / "mine/package.xml").write_text("<")
    (source / "mine/CATKIN_IGNORE").touch()
    assert names(source) == ["workshop"] and find_packages(source)[1] == []
