"""One school for all of these tests; skipped where namespaces may not be made."""

import sys
import time
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent))
from lesson import NUMBERS, STOP_BOUND, Lesson, measured  # noqa: E402
from network import NotAllowed  # noqa: E402
from school import School  # noqa: E402


def pytest_addoption(parser):
    parser.addoption("--robots", type=int, default=15, help="how many robots the school has, at least 3")


def pytest_configure(config):
    config.addinivalue_line("markers", "short: what .ci/run runs, with three robots")


def pytest_terminal_summary(terminalreporter):
    terminalreporter.write_line("\n".join(NUMBERS))


@pytest.fixture(scope="session")
def whole_school(request, tmp_path_factory):
    try:
        school = School(tmp_path_factory.mktemp("school"), request.config.getoption("--robots"))
    except NotAllowed:
        pytest.skip("this user may not make network namespaces")
    yield school
    school.close()


@pytest.fixture
def school(whole_school, request):
    """The school with all robots well; none drives by one command for longer than the dead man's switch lets it."""
    whole_school.recover()
    start = time.monotonic()
    yield whole_school
    assert measured(f"{request.node.name}: longest command", whole_school.wheels.longest_command(start)) < STOP_BOUND


@pytest.fixture
def lesson(school):
    lesson = Lesson(school)
    yield lesson
    lesson.close()
