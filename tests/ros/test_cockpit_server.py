"""Who gets into the cockpit, with real sockets and forged requests."""

import gzip
import logging
import re

import pytest

from cockpit_server import DRIVE, FIRST_PUPIL, STOP, TEACHER
from web_client import UPGRADE, request

pytest_plugins = ["cockpit_server"]  # its fixtures


def test_every_answer_has_the_headers_that_protect_the_page(cockpit):
    host = cockpit.headers()
    answers = {
        200: request(cockpit.port, "GET", "/", host), 404: request(cockpit.port, "GET", "/other", host),
        403: request(cockpit.port, "POST", "/login", {**host, "Origin": "http://evil.test"}),
        415: request(cockpit.port, "POST", "/login", host), 405: request(cockpit.port, "GET", "/login", host)}
    answers[4040] = request(cockpit.port, "GET", "/", {"Host": "evil.test"})
    for status, answer in answers.items():
        assert str(status).startswith(str(answer.status))
        assert "frame-ancestors 'none'" in answer.headers["content-security-policy"]
        assert "default-src 'self'" in answer.headers["content-security-policy"]
        assert [answer.headers[name] for name in (
            "x-frame-options", "x-content-type-options", "referrer-policy", "cache-control")] == [
                "DENY", "nosniff", "no-referrer", "no-store"]
        assert not {"server", "access-control-allow-origin"} & set(answer.headers)


def test_only_the_page_for_programs_lets_blockly_insert_styles_and_no_page_other_scripts(cockpit):
    policies = {path: request(cockpit.port, "GET", path, cockpit.headers()).headers["content-security-policy"]
                for path in ("/", "/program", "/program.html", "/program/page.js", "/vendor/blockly/msg/en.js")}
    styled = [path for path, policy in policies.items() if "style-src 'self' 'unsafe-inline'" in policy]
    assert styled == ["/program", "/program.html"]
    assert not [policy for policy in policies.values() if "script-src" in policy or "unsafe-eval" in policy]


def test_a_script_comes_compressed_and_once(cockpit):
    path, headers = "/vendor/blockly/blockly_compressed.js", cockpit.headers()
    plain = request(cockpit.port, "GET", path, headers)
    packed = request(cockpit.port, "GET", path, {**headers, "Accept-Encoding": "gzip, deflate"})
    smaller = request(cockpit.port, "GET", path, {**headers, "Accept-Encoding": "gzip, br;q=1"})
    assert packed.headers["content-encoding"] == "gzip" and "content-encoding" not in plain.headers
    assert smaller.headers["content-encoding"] == "br" and len(smaller.body) < len(packed.body)
    assert gzip.decompress(packed.body) == plain.body and len(packed.body) < len(plain.body) / 3
    again = request(cockpit.port, "GET", path, {**headers, "Accept-Encoding": "gzip, deflate",
                                                "If-None-Match": packed.headers["etag"]})
    assert (again.status, again.body, packed.headers["cache-control"]) == (304, b"", "no-cache")


def test_what_a_page_names_is_kept_by_the_browser_for_good(cockpit):
    page = request(cockpit.port, "GET", "/program", cockpit.headers()).body.decode()
    path = re.search(r'href="([^"]+/program/page.js)"', page)[1]
    headers = {**cockpit.headers(), "Accept-Encoding": "gzip"}
    script = request(cockpit.port, "GET", f"/{path}", headers)
    assert script.headers["cache-control"] == "max-age=31536000, immutable" and "etag" not in script.headers
    assert script.headers["x-content-type-options"] == "nosniff"
    assert script.body == request(cockpit.port, "GET", "/program/page.js", headers).body
    assert request(cockpit.port, "GET", f"/{'0' * 16}/program/page.js", headers).status == 404


@pytest.mark.parametrize("path", ["/vendor/blockly/SHA256SUMS", "/vendor/blockly/msg/en.js.br", "/program/",
                                  "/../package.xml", "/%2e%2e/package.xml", "/www/index.html", "//etc/passwd",
                                  "/index.html/", "/.", "/main.js%00", "/socket/", "/login/"])
def test_nothing_but_the_pages_files_is_served(cockpit, path):
    assert request(cockpit.port, "GET", path, cockpit.headers()).status == 404


@pytest.mark.parametrize("method, path, headers", [
    ("GET", "/", {}), ("GET", "/socket", UPGRADE), ("POST", "/login", {})])
@pytest.mark.parametrize("host", ["", "evil.test", "evil.test:{port}", "localhost", "localhost:{port}, evil.test"])
def test_a_page_by_a_foreign_name_is_not_found(cockpit, method, path, headers, host):
    """DNS rebinding: a foreign page's name is resolved to this computer's address."""
    headers = {**cockpit.headers(), **headers, "Host": host.format(port=cockpit.port)}
    assert request(cockpit.port, method, path, headers).status in (400, 404)  # 400: newer Tornados check its form, too


def test_a_foreign_page_gets_no_socket_and_no_post(cockpit):
    for origin in None, "null", f"http://evil.test:{cockpit.port}", f"https://localhost:{cockpit.port}":
        assert cockpit.page(Origin=origin).status == 403, origin
        assert cockpit.log_in(TEACHER.code, Origin=origin).status == 403, origin


def test_a_code_becomes_a_cookie_that_scripts_and_other_pages_do_not_get(cockpit):
    answer = cockpit.log_in(FIRST_PUPIL.code)
    assert answer.status == 204
    flags = answer.headers["set-cookie"].lower()
    assert "httponly" in flags and "samesite=strict" in flags and "path=/" in flags
    for _ in range(2):  # it lives through a reconnect
        hello = cockpit.page("class.test", Cookie=cockpit.cookie(FIRST_PUPIL)).receive("hello")
        assert (hello["role"], hello["robot"]) == ("pupil", "/jetbot_01")


@pytest.mark.parametrize("cookie", [
    None, "", "jetbot_cockpit=x", "{name}=", "{name}=x", "{name}={code}", "{name}={made_up}", "{name}={almost}"])
def test_without_a_cookie_that_was_given_a_page_is_asked_to_log_in_and_stops_and_keeps_nothing(cockpit, cookie):
    cookie = cookie and cookie.format(name=cockpit.access.cookie_name, code=TEACHER.code, made_up="x" * 43,
                                      almost=FIRST_PUPIL.cookie[:-1] + "!")
    handled = list(cockpit.control.handled)
    page = cockpit.page("class.test", Cookie=cookie)
    page.send(STOP)
    page.send(DRIVE)
    assert page.wait_for_close().code == 4001
    assert cockpit.control.handled == handled
    headers = cockpit.headers("class.test", Cookie=cookie, Content_Type="application/json")
    assert request(cockpit.port, "POST", "/work", headers, b'{"do": "list", "robot": null}').status == 403


@pytest.mark.parametrize("body, status", [
    (b"", 400), (b"x", 400), (b"[]", 400), (b"{}", 400), (b'{"code": 1}', 400), (b'{"code": "A", "x": 1}', 400),
    (b"[" * 900, 400), (b'{"code": "\\ud800"}', 403), (b"\xff\xfe", 400),
    (b'{"code": "%s"}' % (b"A" * 2000), 400)],
    ids=lambda value: str(value)[:20])
def test_a_login_of_another_form_is_refused(cockpit, body, status):
    headers = cockpit.headers(Content_Type="application/json")
    assert request(cockpit.port, "POST", "/login", headers, body).status == status


def test_nothing_acts_on_get_nor_on_a_foreign_pages_form(cockpit):
    assert request(cockpit.port, "GET", f"/login?code={TEACHER.code}", cockpit.headers()).status == 405
    for method in "PUT", "DELETE", "PATCH", "OPTIONS":
        assert request(cockpit.port, method, "/login", cockpit.headers()).status == 405
    for kind in "text/plain", "application/x-www-form-urlencoded", "", "multipart/form-data; b=x":  # no form sends JSON
        assert cockpit.log_in(TEACHER.code, Content_Type=kind).status in (400, 415), kind


def test_wrong_codes_lock_out_the_browser_and_then_the_phone_that_sent_them_and_no_other(fresh):
    def attempt(code, phone, browser):
        return fresh.log_in(code, phone, Cookie=f"{fresh.access.visitor_cookie}={browser}").status
    cookie = request(fresh.port, "GET", "/", fresh.headers()).headers["set-cookie"].partition(";")[0]
    assert [fresh.log_in(code, Cookie=cookie).status for code in ["WRONG"] * 5 + [TEACHER.code]] == [403] * 5 + [429]
    assert attempt(TEACHER.code, "127.0.0.1", "other") == 204
    assert [attempt("WRONG", "127.0.0.2", number) for number in range(32)] == [403] * 30 + [429] * 2
    assert attempt(TEACHER.code, "127.0.0.2", "new") == 429
    assert attempt(TEACHER.code, "127.0.0.3", "new") == attempt(FIRST_PUPIL.code, "127.0.0.3", "1") == 204
    log = "too many wrong codes from 127.0.0.1 and another address: refused for a minute"
    assert fresh.access.take_log(0.0) == [log]


def test_nothing_is_logged_that_a_client_can_cause(caplog, cockpit):
    with caplog.at_level(logging.DEBUG):
        cockpit.log_in(TEACHER.code)
        cockpit.log_in("WRONG")
        request(cockpit.port, "GET", f"/{TEACHER.code}", cockpit.headers())
        page = cockpit.page()
        page.send(b"x")
        page.wait_for_close()
    assert TEACHER.code not in caplog.text and "WRONG" not in caplog.text
