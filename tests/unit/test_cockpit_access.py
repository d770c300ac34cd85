"""Who gets into the cockpit: codes, cookies, wrong tries, and the names by which its page is reached."""

import pytest

from jetbot_cockpit_server.web.access import ALPHABET, MAX_WRONG_IN_ALL, Access, TooManyTries, make_grants

GRANTS = make_grants(2)
PUPILS_ADDRESS, OTHER_ADDRESS, OWN_ADDRESS = "192.168.1.7", "192.168.1.8", "192.168.1.42"


@pytest.fixture
def access():
    return Access(8080, ["robot.local"], GRANTS)


def code_of(label):
    return next(grant.code for grant in GRANTS if grant.label == label)


def test_codes_are_short_for_pupils_of_one_robot_or_of_all_and_new_at_each_start():
    teacher, *pupils = make_grants(3)
    assert (teacher.role, teacher.robot, len(teacher.code)) == ("teacher", None, 10)
    assert [(pupil.role, pupil.robot, len(pupil.code)) for pupil in pupils] == [
        ("pupil", f"/jetbot_0{number}", 6) for number in (1, 2, 3)]
    assert set("".join(pupil.code for pupil in pupils)) <= set(ALPHABET) and not set("0O1IL") & set(ALPHABET)
    assert [(grant.role, grant.robot) for grant in make_grants(0)] == [("teacher", None), ("pupil", None)]
    codes = [grant.code for _ in range(20) for grant in make_grants(3)]
    assert len(set(codes)) == len(codes)


def test_a_code_may_be_typed_in_small_letters_and_with_spaces(access):
    code = code_of("jetbot_02")
    grant = access.log_in(f" {code[:3].lower()} {code[3:]}-", PUPILS_ADDRESS, None, now=0.0)
    assert (grant.role, grant.robot) == ("pupil", "/jetbot_02")


@pytest.mark.parametrize("code", ["", " ", "A", "ABCDEF", "\ud800", "ÄÖÜ", "x" * 900])
def test_a_wrong_code_gives_nothing(access, code):
    assert access.log_in(code, PUPILS_ADDRESS, None, now=0.0) is None


def test_five_wrong_codes_a_minute_from_one_address(access):
    code = code_of("teacher")
    for second in range(5):
        assert access.log_in("WRONG", PUPILS_ADDRESS, None, now=second) is None
    with pytest.raises(TooManyTries):
        access.log_in(code, PUPILS_ADDRESS, None, now=59.9)
    assert access.log_in(code, OTHER_ADDRESS, None, now=59.9)
    assert access.log_in(code, PUPILS_ADDRESS, None, now=60.0)
    assert access.take_log() == [f"5 wrong codes from a browser at {PUPILS_ADDRESS}: it must wait for a minute"]


def test_wrong_codes_of_one_browser_lock_out_no_other_behind_the_same_router(access):
    for second in range(5):
        access.log_in("WRONG", PUPILS_ADDRESS, "one", now=second)
    with pytest.raises(TooManyTries):
        access.log_in(code_of("jetbot_01"), PUPILS_ADDRESS, "one", now=5.0)
    assert access.log_in(code_of("jetbot_01"), PUPILS_ADDRESS, "another", now=5.0)


def test_many_addresses_try_no_more_than_a_hundred_codes_a_minute(access):
    for number in range(MAX_WRONG_IN_ALL):
        access.log_in("WRONG", f"10.0.0.{number}", None, now=0.0)
    with pytest.raises(TooManyTries):
        access.log_in(code_of("teacher"), OTHER_ADDRESS, None, now=1.0)
    assert access.log_in(code_of("teacher"), OTHER_ADDRESS, None, now=60.0)


def test_wrong_codes_lock_out_nobody_who_is_in(access):
    cookie = access.log_in(code_of("jetbot_01"), PUPILS_ADDRESS, "one", now=0.0).cookie
    for number in range(MAX_WRONG_IN_ALL):
        access.log_in("WRONG", PUPILS_ADDRESS, f"browser {number // 5}", now=0.0)
    with pytest.raises(TooManyTries):
        access.log_in(code_of("jetbot_01"), PUPILS_ADDRESS, "one", now=1.0)
    assert access.grant(cookie, PUPILS_ADDRESS, "robot.local:8080").label == "jetbot_01"


def test_a_cookie_gives_what_its_code_gave(access):
    for label in "teacher", "jetbot_01":
        grant = access.log_in(code_of(label), PUPILS_ADDRESS, None, now=0.0)
        assert access.grant(grant.cookie, PUPILS_ADDRESS, "robot.local:8080") == grant


@pytest.mark.parametrize("cookie", [None, "", "x", "\ud800"])
def test_without_a_cookie_nobody_gets_in_from_elsewhere(access, cookie):
    assert access.grant(cookie, PUPILS_ADDRESS, "localhost:8080") is None  # a Host header can be forged
    assert access.grant(cookie, "127.0.0.1", "robot.local:8080") is None   # a tunnel of another computer


@pytest.mark.parametrize("peer, host", [("127.0.0.1", "localhost:8080"), ("::1", "[::1]:8080"),
                                        ("127.0.0.1", "127.0.0.1:8080")])
def test_a_browser_of_this_computer_is_a_teacher(access, peer, host):
    assert access.grant(None, peer, host).role == "teacher"


@pytest.mark.parametrize("host, own_address", [
    *((host, OWN_ADDRESS) for host in ("localhost:8080", "LOCALHOST:8080", "127.0.0.1:8080", "[::1]:8080",
                                       "robot.local:8080", f"{OWN_ADDRESS}:8080")), ("[fd00::7]:8080", "fd00::7")])
def test_the_page_has_these_hosts_and_origins(access, host, own_address):
    assert access.accepts_host(host, own_address)
    assert access.accepts_origin(f"http://{host.lower()}", own_address)


@pytest.mark.parametrize("host", [None, "", "localhost", "localhost:80", "localhost:8081", "localhost:8080.evil.test",
                                  "evil.test:8080", "xrobot.local:8080", "localhost:8080,evil.test",
                                  "192.168.1.43:8080"])
def test_no_other_name_is_this_page(access, host):
    assert not access.accepts_host(host, OWN_ADDRESS)
    assert not access.accepts_origin(f"http://{host}", OWN_ADDRESS)


@pytest.mark.parametrize("origin", [None, "", "null", "localhost:8080", "https://localhost:8080",
                                    "http://localhost:8080/", "http://localhost:8080 "])
def test_an_origin_is_compared_exactly(access, origin):
    assert not access.accepts_origin(origin, OWN_ADDRESS)


def test_on_port_80_browsers_leave_out_the_port():
    access = Access(80, [], [])
    assert access.accepts_host("localhost", "127.0.0.1") and access.accepts_origin("http://[::1]", "::1")
