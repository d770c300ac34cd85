"""What a class keeps: nothing is lost by a kill, a full disk or a second page, and nobody gets what is another's."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from conftest import PACKAGES, PYTHONPATH
from jetbot import InvalidValue
from jetbot_cockpit.classroom import program as one
from jetbot_cockpit.classroom import programs as rules
from jetbot_cockpit.classroom.classroom import Classroom, open_classroom
from jetbot_cockpit.classroom.folder import ClassFolder, Nowhere
from jetbot_cockpit.classroom.place import CLASS_NAME
from jetbot_cockpit.classroom.program import Program, is_id, is_program_name
from jetbot_cockpit.classroom.programs import Programs, Refused
from jetbot_cockpit.remote.fleet import Fleet
from jetbot_cockpit.web.access import make_grants, numbered

IDS = [f"{number:016x}" for number in range(100)]
SQUARE, CIRCLE, STAR = (json.dumps({"blocks": {name: 1}}) for name in ("square", "circle", "star"))
PAGES = [json.dumps({"blocks": '"' * 32700, "page": page}) for page in range(15)]
CALLS = (os, "replace"), (os, "fsync"), (os, "open"), (Path, "unlink")


class Killed(BaseException):
    """The process ends here: what would follow does not happen."""


@pytest.fixture
def classes(tmp_path):
    """A function that starts a cockpit with the class 7b, after the last one was killed, and returns its folder."""
    opened = []

    def start():
        if opened:
            start.end()
        opened.append(ClassFolder(str(tmp_path), "7b"))
        return opened[-1]
    start.path, start.end = tmp_path / "7b", lambda: opened.pop().close()
    yield start
    if opened:
        start.end()


@pytest.fixture
def programs():
    return Programs(Nowhere())


def save(programs, id=IDS[0], version=0, name="Square", program=SQUARE, robot="/red"):
    return programs.save(robot, id, version, name, program)


def kept(programs, robot="/red"):
    return {row["id"]: programs.open(robot, row["id"]).program for row in programs.rows(robot) if not row["deleted"]}


def test_without_a_name_a_class_ends_with_the_cockpit(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    classroom = open_classroom("~/classes", "")
    save(classroom.programs)
    classroom.keep("scores", [])
    classroom.do(str).result()
    assert kept(classroom.programs) and not list(tmp_path.iterdir())


def test_only_the_owner_reads_the_folder(classes):
    classes().write("codes", {})
    assert classes.path.stat().st_mode & 0o777 == 0o700
    classes.path.chmod(0o755)
    classes()
    assert classes.path.stat().st_mode & 0o777 == 0o700


def versions(programs):
    """Return the texts of all versions of the program, the newest first."""
    return [each.program for each in programs.open("/red", IDS[0]).versions()]


@pytest.mark.parametrize("saves, left", [
    ([(0, SQUARE), (1, CIRCLE), (1, STAR)], [STAR, CIRCLE]),
    ([(1, CIRCLE), (2, STAR)], [STAR, CIRCLE]),
    ([(0, SQUARE), (0, SQUARE), (1, CIRCLE), (1, STAR), (1, CIRCLE)], [CIRCLE, STAR]),
    ([(99, text) for text in PAGES], PAGES[:-12:-1])],
    ids=["two pages make of one version", "a page that outlives a cockpit without a class makes, and another one",
         "is sent again because its answer was lost", "many pages make: the newest, also the largest"])
def test_which_versions_are_kept_also_after_a_restart(classes, saves, left):
    programs = Programs(classes())
    for version, text in saves:
        save(programs, version=version, program=text)
    assert versions(programs) == versions(Programs(classes())) == left


def test_versions_have_names_also_after_a_restart(classes):
    programs = Programs(classes())
    for version, name in (0, "Square"), (1, "Circle"), (1, "Other"):
        save(programs, version=version, name=name)
    row = Programs(classes()).rows("/red")[0]
    assert (row["name"], row["version"], row["earlier"]) == ("Other", 3, [{"version": 2, "name": "Circle"}])


def test_a_version_is_replaced_by_what_is_made_of_it_and_by_nothing_else(programs):
    red = blue = save(programs).version
    for number in range(20):
        red = save(programs, version=red, program=json.dumps({"red": number})).version
        blue = save(programs, version=blue, program=json.dumps({"blue": number})).version
    assert versions(programs) == ['{"blue": 19}', '{"red": 19}'], "of each page its newest"
    save(programs, version=red, program=STAR)
    assert versions(programs) == [STAR, '{"blue": 19}'], "an earlier one was opened and changed"


def test_each_version_can_be_opened_and_the_newest_in_place_of_one_that_is_replaced(programs):
    for version, text in (0, SQUARE), (1, CIRCLE), (1, STAR):
        save(programs, version=version, program=text)
    program = programs.open("/red", IDS[0])
    assert [program.opened(version)["program"] for version in (None, 3, 2, 1)] == [STAR, STAR, CIRCLE, STAR]
    assert program.opened(2)["version"] == 2


def test_what_1_2_has_kept_is_read(classes):
    classes()
    (classes.path / f"program_{IDS[0]}.json").write_text(json.dumps({
        "id": IDS[0], "robot": "/red", "name": "Square", "version": 3, "changed": 8, "deleted": False,
        "program": SQUARE}))
    programs = Programs(classes())
    assert kept(programs) == {IDS[0]: SQUARE} and save(programs, version=3, program=CIRCLE).version == 4


def test_the_same_again_is_answered_as_before(programs):
    assert save(programs) == save(programs)
    assert programs.delete("/red", IDS[0], True) == programs.delete("/red", IDS[0], True)


def test_the_other_page_sees_that_something_has_changed(programs):
    seen = [programs.changed("/red")]
    for change in (lambda: save(programs), lambda: save(programs, version=1, name="Big square"),
                   lambda: programs.delete("/red", IDS[0], True), lambda: programs.delete("/red", IDS[0], False)):
        change()
        seen.append(programs.changed("/red"))
    assert seen == sorted(set(seen)) and programs.changed("/blue") == 0


def test_no_robot_reads_or_changes_another_ones_programs(programs):
    save(programs)
    for foreign in (lambda: programs.open("/blue", IDS[0]), lambda: programs.delete("/blue", IDS[0], True),
                    lambda: save(programs, version=1, robot="/blue", program=CIRCLE)):
        with pytest.raises(Refused):
            foreign()
    assert (kept(programs), kept(programs, "/blue")) == ({IDS[0]: SQUARE}, {})


def test_a_robot_has_room_for_some_programs_and_deleted_ones_make_room(classes):
    programs = Programs(classes())
    for id in IDS[:rules.MAX_PROGRAMS]:
        save(programs, id)
    with pytest.raises(Refused, match="no room"):
        save(programs, IDS[-1])
    save(programs, IDS[-1], robot="/blue")
    for id in IDS[3], IDS[2]:
        programs.delete("/red", id, True)
    save(programs, IDS[-2])
    left = set(kept(programs))
    assert left == {*IDS[:rules.MAX_PROGRAMS], IDS[-2]} - {IDS[2], IDS[3]}
    assert [row["id"] for row in programs.rows("/red") if row["deleted"]] == [IDS[2]], "the oldest goes first"
    assert set(kept(Programs(classes()))) == left


@pytest.mark.parametrize("pages", ["x", "abcd"], ids=["programs", "earlier versions, too"])
def test_a_robots_programs_are_limited_in_all(programs, pages):
    large = [json.dumps({"blocks": page * (one.MAX_TEXT - 20)}) for page in pages]
    with pytest.raises(Refused, match="no room"):
        for id in IDS:
            for text in large:
                save(programs, id, version=99, program=text)
    assert len(kept(programs)) == rules.MAX_TOTAL // len(large[0]) // len(large)


@pytest.mark.parametrize("program", [
    "", "x", "[]", "1", "null", '"text"', "[" * 10000, '{"a":' * 10, '{"a":' * 10000, '{"a":' * 5000 + "}" * 4999,
    '{"a":' * 5000 + "1" + "}" * 4999 + "]", '{"a": 1{}}', "{{}: 1}", '{"a": {}} {}', '{} "', "}", '"' + '\\"' * 30000,
    '{"a": "\ud800"}', '{"a": NaN}', '{"a": [-Infinity]}',
    json.dumps({"a": "x" * 65536}), json.dumps({"a": "ä" * 32768}, ensure_ascii=False), "9" * 60000],
    ids=lambda each: f"{each[:9]} {len(each)}")
def test_what_is_no_program_is_refused(programs, program):
    with pytest.raises(Refused):
        save(programs, program=program)
    assert not programs.rows("/red")


def test_a_chain_of_blocks_may_be_deeper_than_python_reads_json(classes):
    chain = '{"type":"robot_stop","next":{"block":' * 1000 + "{}" + "}}" * 1000
    save(Programs(classes()), program=chain)
    assert Programs(classes()).open("/red", IDS[0]).program == chain


@pytest.mark.parametrize("name, good", [
    ("<img src=x onerror=alert(1)>", True), ("../../etc/passwd", True), ("🙂" * 40, True), ("x" * 41, False),
    ("👩‍👩‍👧‍👦", True), ("می‌خواهم", True), ("前　進", True), ("a\u200fb", True),
    ("", False), (" ", False), ("a\nb", False), ("a\u2066b", False), ("a\u2028b", False),
    ("a\u202eb", False), ("\ud800", False), (7, False), (None, False)])
def test_the_name_of_a_program_is_printable_text(name, good):
    assert is_program_name(name) == good


def test_files_have_numbers_whatever_a_program_is_called(classes):
    save(Programs(classes()), name="../../codes")
    assert [file.name for file in classes.path.rglob("*")] == [f"program_{IDS[0]}.json"]


@pytest.mark.parametrize("content", [
    "{}", '{"id": 1}',
    *(json.dumps({**Program(IDS[0], "/red", "Square", 1, 1, False, SQUARE)._asdict(), **changes}) for changes in (
        {"id": IDS[1]}, {"name": ""}, {"version": "1"}, {"deleted": 0}, {"program": "x"}, {"robot": None},
        {"new": 1}, {"earlier": {}}, {"earlier": [1]}, {"earlier": [[1, "Square"]]}, {"earlier": [[1, "", SQUARE]]},
        {"earlier": [[1, "Square", "x"]]}))])
def test_a_damaged_file_is_put_aside_and_the_others_are_read(classes, content):
    folder = classes()
    save(Programs(folder), IDS[5])
    (classes.path / f"program_{IDS[0]}.json").write_text(content)
    folder = classes()
    assert set(kept(Programs(folder))) == {IDS[5]}
    assert "is damaged" in folder.problems[0]
    assert (classes.path / f"program_{IDS[0]}.damaged").read_text() == content


@pytest.mark.parametrize("content", ["{", "[1]"])
def test_damaged_codes_are_put_aside_and_the_terminal_says_so(classes, content):
    classroom = Classroom(classes())
    (classes.path / "codes.json").write_text(content)
    assert classroom.read("codes", dict) == {}
    assert classroom.take_problems() == [f"{classes.path}/codes.json is damaged, and was renamed to codes.damaged"]
    assert (classes.path / "codes.damaged").read_text() == content and not classroom.take_problems()


def interrupted(monkeypatch, target, name, at, exception, *arguments, **options):
    """Save this; let the call of this name fail the at-th time. Return whether it did."""
    real, calls = getattr(target, name), []

    def fails(*arguments, **options):
        calls.append(name)
        if len(calls) == at:
            raise exception
        return real(*arguments, **options)
    with monkeypatch.context() as patch:
        patch.setattr(target, name, fails)
        try:
            save(*arguments, **options)
        except (Killed, OSError):
            pass
    return len(calls) >= at


@pytest.mark.parametrize("exception", [Killed(), OSError(errno.ENOSPC, "No space")], ids=["kill", "full"])
@pytest.mark.parametrize("call", CALLS, ids=[name for _, name in CALLS])
def test_whatever_fails_while_saving_the_old_version_or_the_new_one_is_there(classes, monkeypatch, call, exception):
    failures = 0
    for at in range(1, 5):
        programs = Programs(classes())
        base = next((row["version"] for row in programs.rows("/red")), 0)
        save(programs, version=base, program=SQUARE)
        base = programs.rows("/red")[0]["version"]
        failures += interrupted(monkeypatch, *call, at, exception, programs, version=base, program=CIRCLE)
        again = Programs(classes())
        assert kept(again) in ({IDS[0]: SQUARE}, {IDS[0]: CIRCLE})
        assert [file.name for file in classes.path.iterdir()] == [f"program_{IDS[0]}.json"], "nothing is left over"
        save(again, version=again.rows("/red")[0]["version"], name="goes on", program=CIRCLE)
        again.delete("/red", IDS[0], True)
        again.delete("/red", IDS[0], False)
    assert failures


def test_a_program_is_on_the_disk_before_it_is_answered(classes, monkeypatch):
    programs, synced, fsync = Programs(classes()), [], os.fsync
    monkeypatch.setattr(os, "fsync", lambda file: fsync(file) or synced.append(os.readlink(f"/proc/self/fd/{file}")))
    save(programs)
    assert len(synced) == 2 and synced[0].endswith(".new") and synced[1] == str(classes.path)


STEPS = st.lists(st.tuples(st.sampled_from(["save", "delete", "restore", "restart", "kill"]), st.integers(0, 2),
                           st.integers(1, 4)), max_size=12)


@settings(max_examples=60, deadline=None, database=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(steps=STEPS)
def test_in_whatever_order_what_was_answered_is_there(classes, monkeypatch, steps):
    for file in classes.path.glob("*") if classes.path.exists() else ():
        file.unlink()
    programs, expected = Programs(classes()), {}
    for number, (step, index, at) in enumerate(steps):
        id = IDS[index]
        version = next((row["version"] for row in programs.rows("/red") if row["id"] == id), 0)
        text = json.dumps({"step": number})
        if step == "save":
            expected[id] = save(programs, id, version, program=text).program
        elif step in ("delete", "restore") and version:
            program = programs.delete("/red", id, step == "delete")
            expected.pop(id, None)
            expected.update({} if program.deleted else {id: program.program})
        elif step == "kill":
            interrupted(monkeypatch, os, "fsync", at, Killed(), programs, id, version, program=text)
            programs = Programs(classes())
            assert kept(programs).get(id) in (text, expected.get(id))
            expected = {**{key: value for key, value in expected.items() if key != id},
                        **{key: value for key, value in kept(programs).items() if key == id}}
        elif step == "restart":
            programs = Programs(classes())
        assert kept(programs) == expected


def test_a_second_cockpit_with_the_same_class_is_refused_until_the_first_one_ends(classes, tmp_path):
    classes()
    with pytest.raises(InvalidValue, match="nother cockpit has the class 7b open"):
        ClassFolder(str(tmp_path), "7b")
    classes()


def test_a_folder_that_cannot_be_used_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InvalidValue, match="file/7b cannot be used to keep a class: File exists"):
        ClassFolder(str(tmp_path / "file"), "7b")


@pytest.mark.parametrize("name, good", [("7b", True), ("Year_7-b", True), ("", True), ("x" * 21, False), ("a/b", False),
                                        ("..", False), ("a b", False), ("ä", False), ("a\n", False), (7, False)])
def test_a_class_has_a_plain_name(name, good):
    assert CLASS_NAME.accepts(name) == good


def test_printed_codes_hold_at_the_next_lesson_and_damaged_ones_are_new():
    grants = make_grants(numbered(2))
    kept = {each.label: [each.code, each.cookie] for each in grants}
    assert make_grants(numbered(2), kept) == grants
    assert make_grants(numbered(3), kept)[:3] == grants, "more robots than last time"
    for damaged in ["", "X"], ["ABC234"], "ABC234", None, ["ABC23!", "x" * 43], ["ABC234", ""], [1, 2]:
        code, cookie = make_grants(numbered(2), {**kept, "jetbot_01": damaged})[1][3:]
        assert [code, cookie] != damaged and len(code) == 6 and len(cookie) == 43


def test_what_a_full_disk_does_not_take_is_kept_when_there_is_room_again(classes, monkeypatch):
    classroom, newer = Classroom(classes()), [[2]]

    def full(_):
        if newer:
            classroom.keep("scores", newer.pop())
        raise OSError(errno.ENOSPC, "No space left on device")
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        for name, content in ("scores", [1]), ("tasks", ["metre"]), ("codes", {"teacher": "ABC"}):
            classroom.keep(name, content)
            classroom.do(str).result()
        sentence = "The class cannot be kept: No space left on device. The cockpit tries again."
        assert classroom.take_problems() == [sentence] and str(classroom.problem) == sentence
    classroom.retry()
    classroom.do(str).result()
    assert classroom.take_problems() == ["The class is kept again."] and not classroom.problem
    again = Classroom(classes())
    assert [again.read(*each) for each in (("scores", list), ("tasks", list), ("codes", dict))] == [
        [2], ["metre"], {"teacher": "ABC"}]


@pytest.mark.parametrize("call", ["mkdir", "chmod"], ids=["a new class", "one that was kept"])
def test_on_a_read_only_disk_a_class_starts_and_nothing_is_kept(tmp_path, classes, monkeypatch, call):
    if call == "chmod":
        save(Programs(classes()))
        classes.end()
    monkeypatch.setattr(Path, call, Mock(side_effect=OSError(errno.EROFS, "Read-only file system")))
    classroom = open_classroom(str(tmp_path), "7b")
    assert bool(kept(classroom.programs)) == (call == "chmod")
    save(classroom.programs, IDS[1], program=CIRCLE)
    assert kept(classroom.programs)[IDS[1]] == CIRCLE and not list(tmp_path.glob(f"*/*{IDS[1]}*"))
    assert classroom.id is None
    sentence = f"{classes.path} is on a disk that is read-only: nothing of this class is kept."
    assert classroom.take_problems() == [sentence] and str(classroom.problem) == sentence


def test_whatever_lies_in_a_class_it_starts_and_the_terminal_shows_no_escape_sequence(classes):
    classes()
    (classes.path / ".x.new").mkdir()
    (classes.path / "program_\033[2J.json").write_text("{")
    classroom = Classroom(classes())
    assert [r"program_\x1b[2J.json is damaged" in problem for problem in classroom.take_problems()] == [True]


def forget(*arguments, home):
    script = PACKAGES / "jetbot_cockpit/scripts/forget_class.py"
    return subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True,
                          env={**os.environ, "HOME": str(home), "PYTHONPATH": PYTHONPATH})


def test_a_class_has_another_id_once_one_of_its_name_was_deleted(classes, tmp_path):
    first = Classroom(classes()).id
    assert is_id(first) and Classroom(classes()).id == first
    classes.end()
    forget("7b", "--classes", tmp_path, home=tmp_path)
    assert is_id(Classroom(classes()).id) and Classroom(classes()).id != first


def test_a_class_is_forgotten_but_not_while_a_cockpit_has_it(classes, tmp_path):
    folder = classes()
    save(Programs(folder))
    folder.write("names", {"/red": "Ada"})
    refused = forget("7b", "--classes", tmp_path, home=tmp_path)
    assert (refused.returncode, refused.stderr) == (1, "A cockpit runs with the class 7b: end it first.\n")
    classes.end()
    done = forget("7b", "--classes", tmp_path, home=tmp_path)
    assert (done.returncode, done.stdout) == (0, f"Deleted {classes.path}: 2 files with the codes, names, programs and "
                                                 "best scores of the class 7b.\n")
    assert not classes.path.exists()
    classes()


def test_a_class_of_real_robots_keeps_its_key(tmp_path):
    fleet = Fleet(str(tmp_path), "7b")
    refused = forget("7b", "--classes", tmp_path, home=tmp_path)
    assert refused.returncode == 1 and "which this deletes: ./morbot fleet --class 7b forget" in refused.stderr
    assert Fleet(str(tmp_path), "7b").key == fleet.key


@pytest.mark.parametrize("name, sentence", [("8a", "There is no class 8a"), ("../x", "is no name of a class"),
                                            ("", "is no name of a class")])
def test_what_is_no_class_is_not_forgotten(tmp_path, name, sentence):
    (tmp_path / ".ros/x").mkdir(parents=True)
    assert sentence in forget(name, home=tmp_path).stderr
    assert (tmp_path / ".ros/x").is_dir()
