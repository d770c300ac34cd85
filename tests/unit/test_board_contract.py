"""The contract of MotorDriver, for each board and for two that jetbot does not know, by what its simulated wheels do.

What crosses the wire is tested for each chip by itself.
"""

import itertools

import another_chip
import pytest

from jetbot import boards
from jetbot.boards import MotorDriver, find_board
from jetbot.connection import open_board, stop_board
from jetbot.fake.bus import power_on
from jetbot.fake.motors import STOPPED, wheel_speeds

BOARDS = {**boards.BOARDS, **another_chip.ROWS}
READ_BACK = [name for name, board in BOARDS.items() if board.driver.verify is not MotorDriver.verify]
PARTS = 16        # more than any driver's ``verify`` goes through
SPEEDS = [(0.5, 0.5), (-0.5, -0.5), (-1, 1), (0.5, 0), (0, 0.25), (0.25, -0.75), (0.7, 0.3), (0, 0)]
A, B = (0.5, -0.25), (-0.75, 1)

read_back = pytest.mark.parametrize("board", READ_BACK)


@pytest.fixture(params=BOARDS)
def board(request):
    return request.param


@pytest.fixture
def make(board, folder, monkeypatch):
    """Opens drivers of the board on one fake bus, and closes them."""
    for name, row in another_chip.ROWS.items():
        monkeypatch.setitem(boards.BOARDS, name, row)
    drivers = []

    def make():
        drivers.append(open_board(find_board(board), f"fake:{folder}"))
        return drivers[-1]

    yield make
    for driver in drivers:
        driver.close()


@pytest.fixture
def driver(make):
    return make()


@pytest.fixture
def wheels(board, folder):
    """Returns the speeds of the simulated robot's wheels."""
    return lambda: wheel_speeds(folder, board)


def near(speeds, driver):
    return pytest.approx(speeds, abs=driver.resolution)


def count(driver, action, *arguments):
    """Return how many transfers an action takes."""
    before = driver.link.transfers
    action(*arguments)
    return driver.link.transfers - before


def verify_all(driver, speeds):
    """Read every part back, as the controller does while it drives at these speeds; each takes one transfer at most."""
    for _ in range(PARTS):
        assert count(driver, driver.verify) <= 1
        driver.drive(*speeds)


def test_the_wheels_turn_as_commanded_from_any_speeds_to_any(driver, wheels):
    for speeds in itertools.chain(*itertools.permutations(SPEEDS, 2)):
        driver.drive(*speeds)
        assert wheels() == near(speeds, driver)
        assert [speed != 0 for speed in wheels()] == [speed != 0 for speed in speeds]


def test_the_greatest_speed_and_half_a_step(driver, wheels):
    for sign in (1, -1):
        driver.drive(sign * driver.limit, sign * driver.limit)
        assert wheels() == near((sign * driver.limit,) * 2, driver)
        for part in (0, 0.3, 0.4, 0.6, 0.7, 1):
            driver.drive(part * driver.resolution, -sign * part * driver.resolution)
            assert (wheels() != STOPPED) == (part > 0.5)


def test_a_repeated_speed_takes_no_transfer(driver):
    for speeds in SPEEDS:
        driver.drive(*speeds)
        assert count(driver, driver.drive, *speeds) == 0


def test_starting_and_stopping_switch_both_motors_off(driver, make, board, folder, wheels):
    for stop in make, lambda: stop_board(find_board(board), f"fake:{folder}"):
        for speeds in A, B:
            driver.invalidate()
            driver.drive(*speeds)
            assert wheels() == near(speeds, driver)
            stop()
            assert wheels() == STOPPED


def test_closing_leaves_the_motors_as_they_are(driver, wheels):
    driver.drive(*A)
    driver.close()
    assert wheels() == near(A, driver)


def test_what_the_board_has_is_not_sent_again_while_it_is_verified_and_kept_alive(driver, wheels):
    driver.drive(*A)
    for _ in range(PARTS):
        driver.verify()
        driver.keep_alive()
        assert count(driver, driver.drive, *A) == 0
        assert driver.in_sync and wheels() == near(A, driver)
    assert (driver.resets, driver.overwritten) == (0, 0)


@read_back
@pytest.mark.parametrize("others", ["a brown-out", (0, 0), (0.5, 0), (0.5, 1), B])
def test_verify_finds_a_brown_out_and_what_another_program_writes_and_drive_repairs_it(driver, make, folder, wheels,
                                                                                     others):
    driver.drive(*A)
    power_on(folder) if others == "a brown-out" else make().drive(*others)
    verify_all(driver, A)
    assert wheels() == near(A, driver)


@pytest.mark.parametrize("others", [(0, 0), B])
def test_after_something_else_has_driven_the_board_all_is_sent_again(driver, make, wheels, others):
    driver.drive(*A)
    make().drive(*others)
    driver.invalidate()
    assert not driver.in_sync
    driver.drive(*A)
    assert driver.in_sync and wheels() == near(A, driver)
