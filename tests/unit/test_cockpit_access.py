"""Who gets into the cockpit: codes, cookies, wrong tries, and the names by which its page is reached."""

import contextlib
import secrets

import pytest

from jetbot_cockpit.web.access import ALPHABET, MAX_WRONG_AT_ADDRESS, Access, TooManyTries, make_grants, numbered

GRANTS = make_grants(numbered(2))
WRONG = "", " ", "A", "ABCDEF", "\ud800", "ÄÖÜ", "x" * 900
PUPILS_ADDRESS, OTHER_ADDRESS, OWN_ADDRESS = "192.168.1.7", "192.168.1.8", "192.168.1.42"


@pytest.fixture
def access():
    return Access(8080, ["robot.local"], GRANTS)


def code_of(label):
    return next(grant.code for grant in GRANTS if grant.label == label)


def test_codes_are_short_for_pupils_of_one_robot_or_of_all_and_new_at_each_start():
    teacher, *pupils = make_grants(numbered(3))
    assert (teacher.role, teacher.robot, len(teacher.code)) == ("teacher", None, 10)
    assert [(pupil.role, pupil.robot, len(pupil.code)) for pupil in pupils] == [
        ("pupil", f"/jetbot_0{number}", 6) for number in (1, 2, 3)]
    assert set("".join(pupil.code for pupil in pupils)) <= set(ALPHABET) and not set("0O1IL") & set(ALPHABET)
    assert [(grant.role, grant.robot) for grant in make_grants(numbered(0))] == [("teacher", None), ("pupil", None)]
    codes = [grant.code for _ in range(20) for grant in make_grants(numbered(3))]
    assert len(set(codes)) == len(codes)


def test_a_code_may_be_typed_in_small_letters_and_with_spaces(access):
    code = code_of("jetbot_02")
    grant = access.log_in(f" {code[:3].lower()} {code[3:]}-", PUPILS_ADDRESS, None, now=0.0)
    assert (grant.role, grant.robot) == ("pupil", "/jetbot_02")


def try_wrong_codes(access, count, peer=PUPILS_ADDRESS, cookie="browser {}"):
    """Try so many, by default each with a new cookie; return how many were compared."""
    compared = 0
    for number in range(count):
        with contextlib.suppress(TooManyTries):
            access.log_in("WRONG", peer, cookie and cookie.format(number), now=number / 1000)
            compared += 1
    return compared


@pytest.mark.parametrize("count, compared, cookie, out, let_in", [
    (9, 5, None, [(PUPILS_ADDRESS, None)], [(OTHER_ADDRESS, None), (PUPILS_ADDRESS, "another")]),
    (9, 5, "one", [(PUPILS_ADDRESS, "one")], [(PUPILS_ADDRESS, None), (PUPILS_ADDRESS, "another")]),
    (9, 5, OTHER_ADDRESS, [], [(OTHER_ADDRESS, None), (OTHER_ADDRESS, OTHER_ADDRESS)]),
    (9, 5, "theirs", [], [(OTHER_ADDRESS, "theirs")]),
    (1000, MAX_WRONG_AT_ADDRESS, "new {}", [(PUPILS_ADDRESS, "another")], [(OTHER_ADDRESS, "new 1")])],
    ids=["without a cookie", "of one browser", "with another's address", "with another's cookie", "with new cookies"])
def test_wrong_codes_lock_out_who_sends_them_for_a_minute_and_nobody_else(access, count, compared, cookie, out, let_in):
    cookie_given = access.log_in(code_of("jetbot_01"), PUPILS_ADDRESS, "one", now=0.0).cookie
    assert try_wrong_codes(access, count, cookie=cookie) == compared
    for sender in out:
        with pytest.raises(TooManyTries):
            access.log_in(code_of("teacher"), *sender, now=59.9)
    for sender in let_in:
        assert access.log_in(code_of("teacher"), *sender, now=59.9)
    for sender in out:
        assert access.log_in(code_of("teacher"), *sender, now=61.0)
    assert access.grant(cookie_given, PUPILS_ADDRESS, "robot.local:8080").label == "jetbot_01", "who was in stays"


def test_wrong_codes_of_many_addresses_lock_out_no_other(access):
    for number in range(250):
        assert try_wrong_codes(access, 5, f"10.0.0.{number}")
    assert access.log_in(code_of("teacher"), OTHER_ADDRESS, None, now=1.0)


def test_the_terminal_says_once_a_minute_which_addresses_are_refused(access):
    try_wrong_codes(access, MAX_WRONG_AT_ADDRESS)
    assert access.take_log(now=0.0) == []
    try_wrong_codes(access, 1000)
    assert access.take_log(now=0.0) == [f"too many wrong codes from {PUPILS_ADDRESS}: refused for a minute"]
    for peer in "10.0.0.2", "10.0.0.1":
        try_wrong_codes(access, 1000, peer)
    assert access.take_log(now=59.9) == []
    assert access.take_log(now=60.0) == ["too many wrong codes from 10.0.0.1 and another address: refused for a minute"]
    assert access.take_log(now=120.0) == []


@pytest.mark.parametrize("grant", GRANTS, ids=lambda grant: grant.label)
def test_a_code_gives_what_it_is_for_and_its_cookie_the_same(access, grant):
    assert access.log_in(grant.code, PUPILS_ADDRESS, None, now=0.0) == grant
    assert access.grant(grant.cookie, PUPILS_ADDRESS, "robot.local:8080") == grant


def neighbours(secret):
    """Return what differs from a secret in one character, or in its length."""
    changed = [secret[:place] + ("A" if each != "A" else "B") + secret[place + 1:] for place, each in enumerate(secret)]
    return [*changed, secret[:-1], secret[1:], secret + "A"]


def test_without_a_cookie_that_was_given_nobody_gets_in(access):
    almost = [each for grant in GRANTS for each in (
        grant.code, grant.label, grant.cookie.swapcase(), *neighbours(grant.cookie))]
    for cookie in [None, "", "x", "x" * 43, "\ud800", secrets.token_urlsafe(32), *almost]:
        assert access.grant(cookie, PUPILS_ADDRESS, "robot.local:8080") is None
        assert access.grant(cookie, PUPILS_ADDRESS, "localhost:8080") is None  # a Host header can be forged
        assert access.grant(cookie, "127.0.0.1", "robot.local:8080") is None   # a tunnel of another computer


@pytest.mark.parametrize("grant", GRANTS, ids=lambda grant: grant.label)
def test_what_is_almost_a_code_is_none(access, grant):
    for number, code in enumerate([*neighbours(grant.code), grant.cookie, grant.label, *WRONG]):
        assert access.log_in(code, f"10.0.0.{number}", None, now=0.0) is None


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
