"""What the page keeps on the cockpit's computer: who reads and saves which programs, and what is refused."""

import json
import threading

import pytest

from cockpit_server import FIRST_PUPIL, TEACHER, WITHIN, Cockpit
from jetbot.wait import wait_until
from jetbot_cockpit.notices import say
from web_client import connect, head, request

ID, OTHER = "0" * 16, "1" * 16
PROGRAM = '{"blocks":{}}'
MINE, FOREIGN = "/jetbot_01", "/jetbot_02"
SAVE = {"do": "save", "robot": MINE, "id": ID, "version": 0, "name": "<b>Square</b>", "program": PROGRAM}
LIST = {"do": "list", "robot": MINE}


@pytest.fixture
def cockpit():
    cockpit = Cockpit()
    cockpit.control.robots = lambda: [{"id": MINE}, {"id": FOREIGN}]
    yield cockpit
    cockpit.server.end()


def post(cockpit, fields, grant=FIRST_PUPIL, **headers):
    """Return the status and the answer to what the page of this grant asks for; None: it has none."""
    headers = {"Content_Type": "application/json", "Cookie": grant and cockpit.cookie(grant), **headers}
    body = fields if isinstance(fields, bytes) else json.dumps(fields).encode()
    answer = request(cockpit.port, "POST", "/work", cockpit.headers("class.test", **headers), body)
    return answer.status, json.loads(answer.body) if answer.body[:1] == b"{" else None


def test_a_pupil_keeps_and_opens_the_programs_of_the_own_robot(cockpit):
    status, saved = post(cockpit, SAVE)
    row = {"id": ID, "robot": MINE, "name": "<b>Square</b>", "version": 1, "deleted": False, "earlier": []}
    assert (status, saved) == (200, {"class": None, **row})
    assert post(cockpit, LIST) == (200, {"class": None, "programs": [row]})
    assert post(cockpit, {"do": "open", "robot": MINE, "id": ID})[1]["program"] == PROGRAM
    assert post(cockpit, {"do": "delete", "robot": MINE, "id": ID})[1]["deleted"]
    assert not post(cockpit, {"do": "restore", "robot": MINE, "id": ID})[1]["deleted"]


def test_a_pupil_reads_and_changes_no_other_robots_programs_and_a_teacher_all(cockpit):
    theirs = {**SAVE, "robot": FOREIGN, "id": OTHER}
    assert post(cockpit, theirs, TEACHER)[0] == 200
    refused = say("own_programs_only").fields()
    for fields in (theirs, {"do": "list", "robot": FOREIGN}, {"do": "open", "robot": FOREIGN, "id": OTHER},
                   {"do": "delete", "robot": FOREIGN, "id": OTHER}, {"do": "list", "robot": None}):
        assert post(cockpit, fields) == (409, refused)
    for fields in {"do": "open", "robot": MINE, "id": OTHER}, {**SAVE, "id": OTHER, "version": 1}:
        assert post(cockpit, fields) == (409, say("gone").fields())
    assert [row["robot"] for row in post(cockpit, {"do": "list", "robot": None}, TEACHER)[1]["programs"]] == [FOREIGN]


def test_a_program_of_another_class_is_refused(cockpit):
    cockpit.classroom.id = OTHER
    assert post(cockpit, {**SAVE, "class": ID}) == (409, say("other_class").fields())
    assert post(cockpit, {**SAVE, "class": OTHER})[1]["class"] == OTHER
    assert post(cockpit, {**SAVE, "class": None, "version": 1})[1]["class"] == OTHER


def test_without_a_code_or_from_another_page_nobody_gets_in(cockpit):
    assert post(cockpit, LIST, grant=None)[0] == 403
    assert post(cockpit, LIST, Origin="http://evil.test")[0] == 403
    assert post(cockpit, LIST, Origin=None)[0] == 403
    assert post(cockpit, LIST, Host="evil.test")[0] == 404
    assert post(cockpit, LIST, Content_Type="text/plain")[0] == 415
    assert request(cockpit.port, "GET", "/work", cockpit.headers(Content_Type="application/json")).status == 405


def test_what_two_pages_make_of_one_version_is_both_kept_and_can_be_opened(cockpit):
    post(cockpit, SAVE)
    assert post(cockpit, {**SAVE, "version": 1, "name": "A"})[0] == 200
    status, answer = post(cockpit, {**SAVE, "version": 1, "name": "B"}, TEACHER)
    assert (status, answer["version"], answer["earlier"]) == (200, 3, [{"version": 2, "name": "A"}])
    names = [post(cockpit, {"do": "open", "robot": MINE, "id": ID, **version})[1]["name"]
             for version in ({}, {"version": 2})]
    assert names == ["B", "A"]


@pytest.mark.parametrize("change", [
    {"id": "../../etc/passwd"}, {"id": ID[1:]}, {"id": 7}, {"robot": 7}, {"robot": None}, {"version": -1},
    {"version": 1.5}, {"name": ""}, {"name": "x" * 41}, {"name": "a\nb"}, {"program": {}}, {"do": "run"}, {"do": []},
    {"new": 1}], ids=str)
def test_a_request_of_another_form_is_refused(cockpit, change):
    assert post(cockpit, {**SAVE, **change})[0] == 400


@pytest.mark.parametrize("body", [b"x", b"[]", b"[" * 100000, b'{"do":' * 20000, b"\xff",
                                  b'{"do":' + b"9" * 150000 + b"}"],
                         ids=lambda body: str(body[:9]))
def test_what_is_no_request_is_refused(cockpit, body):
    assert post(cockpit, body)[0] == 400


def test_a_program_of_64_kb_is_kept_however_much_its_text_grows_on_the_way(cockpit):
    text = json.dumps({"a": '"' * 32760})
    assert post(cockpit, {**SAVE, "program": text})[0] == 200
    assert post(cockpit, {"do": "open", "robot": MINE, "id": ID})[1]["program"] == text


def refused_upload(cockpit, size, cookie):
    """Announce a request of so many bytes; return the first line of the answer."""
    headers = cockpit.headers("class.test", Cookie=cookie, Content_Type="application/json", Content_Length=str(size))
    with connect(cockpit.port) as connection:
        connection.sendall(head("POST", "/work", headers))
        return connection.recv(1000).split(b"\r\n")[0]


def test_10_mb_are_not_even_read_and_without_a_code_not_1_kb(cockpit):
    assert b" 400 " in refused_upload(cockpit, 10_000_000, cockpit.cookie(FIRST_PUPIL))
    assert b" 403 " in refused_upload(cockpit, 100_000, None)
    assert post(cockpit, LIST)[0] == 200


def test_a_robot_that_nobody_knows_gets_no_programs(cockpit):
    assert post(cockpit, {**SAVE, "robot": "/jetbot_99"}, TEACHER) == (409, say("ended", robot="jetbot_99").fields())
    assert post(cockpit, {"do": "list", "robot": "/../.."}, TEACHER)[0] == 409


def test_a_full_disk_is_said_in_a_sentence_and_the_old_version_stays(cockpit, monkeypatch):
    post(cockpit, SAVE)

    def full(*_):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr(cockpit.classroom.programs._folder, "write", full)
    assert post(cockpit, {**SAVE, "version": 1, "name": "New"}) == (
        507, say("disk", problem="No space left on device").fields())
    assert post(cockpit, LIST)[1]["programs"][0]["name"] == "<b>Square</b>"


def test_a_disk_that_hangs_holds_up_no_page(cockpit, monkeypatch):
    hangs, goes_on = threading.Event(), threading.Event()
    monkeypatch.setattr(cockpit.classroom.programs._folder, "write", lambda *_: hangs.set() or goes_on.wait())
    saving = threading.Thread(target=post, args=(cockpit, SAVE), daemon=True)
    saving.start()
    try:
        assert hangs.wait(WITHIN)
        assert cockpit.page().receive("hello")
        assert post(cockpit, LIST)[1]["programs"] == []
    finally:
        goes_on.set()
    saving.join(WITHIN)
    assert wait_until(lambda: post(cockpit, LIST)[1]["programs"], WITHIN)
