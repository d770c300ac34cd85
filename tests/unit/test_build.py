"""What is built, with which packages, and what an interrupted build leaves; with a fake catkin_make."""

import os
import time

import pytest
from test_packages import XML, add

from build import BuildFailed, Spaces, update
from state import STAMP

CATKIN_MAKE = """#!/bin/sh
printf '%s\\n' "$@" >>{0}/calls
for argument; do
    case $argument in -DCATKIN_DEVEL_PREFIX=*) devel=${{argument#*=}} ;; *BLACKLIST*) left_out=$argument ;; esac
done
[ ! -e $devel/morbot.stamp ] || exit 9
touch $devel/setup.sh
mkdir -p $devel/share/mine/cmake $devel/share/workshop/cmake
[ ! -e {0}/killed ] || exit 1
for folder in {0}/src/lib*; do
    name=${{folder##*/}}
    case ";${{left_out#*=}};" in *";$name;"*) continue ;; esac
    [ -d $folder ] || continue
    printf -- '-- ==> add_subdirectory(%s)\nCMake Error at %s/CMakeLists.txt:1 (bad):\n' $name $name
    exit 1
done
case $left_out in *mine*) exit 0 ;; esac
grep -q Error {0}/src/mine/CMakeLists.txt || exit 0
echo "-- ==> add_subdirectory(mine)"
cat {0}/src/mine/CMakeLists.txt
exit 1
"""
ERROR = 'CMake Error at mine/CMakeLists.txt:3 (bad):\n  Unknown CMake command "bad".\n'


@pytest.fixture
def spaces(tmp_path, monkeypatch):
    """A workspace with the packages `workshop` and `mine`, built; ``calls`` holds catkin_make's arguments."""
    (tmp_path / "bin").mkdir()
    for name, text in {"catkin_make": CATKIN_MAKE.format(tmp_path), "catkin_init_workspace": "#!/bin/sh\n"}.items():
        (tmp_path / "bin" / name).write_text(text)
        (tmp_path / "bin" / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}/bin:{os.environ['PATH']}")
    for name in "workshop", "mine":
        add(tmp_path / "src" / name, XML.replace("mine", name))
        (tmp_path / "src" / name / "CMakeLists.txt").write_text("catkin_package()\n")
    spaces = Spaces(*(tmp_path / name for name in ("src", "build", "devel")))
    update(spaces)
    return spaces


def calls(spaces):
    """Return the arguments of catkin_make since the last call, as one string."""
    file = spaces.source.parent / "calls"
    text = file.read_text() if file.exists() else ""
    file.write_text("")
    return text


def write(file, text):
    """Write a file, and set back what tells when the last build was: the clock may be too coarse."""
    file.write_text(text)
    stamp = file.parents[2] / "devel" / STAMP
    if stamp.exists():
        os.utime(stamp, (time.time() - 10, time.time() - 10))
    os.utime(file)


def problems(spaces):
    return (spaces.devel / "morbot.problems").read_text()


def searched(spaces):
    return (spaces.devel / ".catkin").read_text()


def test_a_healthy_workspace_is_built_as_catkin_make_alone_does_it(spaces):
    arguments = calls(spaces).splitlines()
    assert arguments[:6] == ["-C", str(spaces.source.parent), "--source", str(spaces.source), "--build",
                             str(spaces.build)]
    assert arguments[-1] == "-DCATKIN_BLACKLIST_PACKAGES="
    assert problems(spaces) == "" and searched(spaces) == str(spaces.source)


def test_a_package_xml_that_breaks_leaves_the_last_build_in_use(spaces):
    calls(spaces)
    (spaces.source / "mine/package.xml").write_text("<package>")
    update(spaces)
    assert calls(spaces) == ""
    assert "<package> has no end" in problems(spaces)
    assert searched(spaces) == str(spaces.source / "workshop")


def test_with_a_broken_package_xml_the_first_build_is_of_links_to_the_others(spaces):
    (spaces.devel / STAMP).unlink()
    (spaces.source / "mine/package.xml").write_text("<package>")
    update(spaces)
    view = spaces.build / "view/src"
    assert str(view) in calls(spaces).splitlines()
    assert os.listdir(view) == ["workshop"] and os.readlink(view / "workshop") == str(spaces.source / "workshop")
    assert searched(spaces) == str(spaces.source / "workshop")


def test_a_corrected_package_is_built_again(spaces):
    write(spaces.source / "mine/package.xml", "<package>")
    update(spaces)
    calls(spaces)
    write(spaces.source / "mine/package.xml", XML)
    update(spaces)
    assert "-DCATKIN_BLACKLIST_PACKAGES=\n" in calls(spaces)
    assert problems(spaces) == "" and searched(spaces) == str(spaces.source)


def test_a_package_that_fails_is_left_out_and_the_others_are_built(spaces):
    calls(spaces)
    write(spaces.source / "mine/CMakeLists.txt", ERROR)
    update(spaces)
    assert calls(spaces).splitlines()[-1] == "-DCATKIN_BLACKLIST_PACKAGES=mine"
    assert problems(spaces) == (f"morbot: {spaces.source}/mine/CMakeLists.txt, line 3: there is no command bad: "
                                "correct its name. Until then, mine is not built.\n")
    assert searched(spaces) == str(spaces.source)
    assert (spaces.devel / STAMP).read_text().splitlines() == [str(spaces.source), str(spaces.source / "workshop")]


def test_a_package_of_ros_2_is_left_out(spaces):
    write(spaces.source / "mine/package.xml",
          XML.replace("</package>", "<export><build_type>ament_python</build_type></export></package>"))
    update(spaces)
    assert "package.xml is for ament_python, which ROS 1 does not build" in problems(spaces)


def test_a_package_that_does_not_call_catkin_package(spaces):
    add(spaces.source / "quiet", XML.replace("mine", "quiet"))
    (spaces.source / "quiet/CMakeLists.txt").write_text("project(quiet)\n")
    update(spaces)
    assert "quiet/CMakeLists.txt does not call catkin_package()" in problems(spaces)


@pytest.mark.parametrize("marker", ["repository/quiet/AMENT_IGNORE", "repository/COLCON_IGNORE"])
def test_a_package_that_catkin_ignores_is_no_problem(spaces, marker):
    add(spaces.source / "repository/quiet", XML.replace("mine", "quiet"))
    (spaces.source / marker).touch()
    update(spaces)
    assert problems(spaces) == ""
    calls(spaces)
    update(spaces)
    assert calls(spaces) == ""


@pytest.mark.parametrize("text", ["", "# later\n"])
def test_an_empty_file_does_not_count_as_the_package_that_was_built_before(spaces, text):
    update(spaces)
    write(spaces.source / "mine/CMakeLists.txt", text)
    update(spaces)
    assert "mine/CMakeLists.txt does not call catkin_package()" in problems(spaces)


def test_a_repository_of_many_packages_that_fail_does_not_take_an_hour(spaces):
    for number in range(100, 130):
        add(spaces.source / f"lib{number}", XML.replace("mine", f"lib{number}"))
    calls(spaces)
    update(spaces)
    assert calls(spaces).count("-C\n") < 20
    assert problems(spaces).splitlines()[-1] == (
        "morbot: All packages that were never built are left out until these are corrected.")
    assert (spaces.devel / STAMP).read_text().splitlines()[1:] == [str(spaces.source / name)
                                                                   for name in ("mine", "workshop")]


def test_an_interrupted_build_leaves_no_stamp_and_is_not_continued(spaces):
    cache = spaces.build / "CMakeCache.txt"
    cache.write_text("of the good build")
    (spaces.source.parent / "killed").touch()
    write(spaces.source / "mine/setup.py", "")
    with pytest.raises(BuildFailed):
        update(spaces)
    assert cache.exists() and not (spaces.devel / STAMP).exists()
    (spaces.source.parent / "killed").unlink()
    update(spaces)
    assert not cache.exists() and (spaces.devel / STAMP).exists()
