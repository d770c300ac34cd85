"""One driver per robot, with a clock turned by hand."""

import pytest

from jetbot_cockpit_server.lease import TIMEOUT, Lease, Leases

ADA, BOB = 1, 2


@pytest.fixture
def leases():
    """Ada drives red since 10 s."""
    leases = Leases()
    leases.renew("/red", ADA, 10.0, driving=True)
    return leases


def test_a_free_robot_has_no_driver(leases):
    assert (leases.driver("/red"), leases.driver("/blue"), leases.robot_of(BOB)) == (ADA, None, None)


def test_nobody_gets_a_robot_that_another_drives(leases):
    with pytest.raises(ValueError):
        leases.renew("/red", BOB, 11.0, driving=True)
    assert leases.driver("/red") == ADA


def test_it_has_expired_after_five_seconds_without_a_command(leases):
    assert TIMEOUT == 5
    assert not leases.has_expired("/red", 14.9)
    assert leases.has_expired("/red", 15)
    leases.renew("/red", ADA, 14.9, driving=False)
    assert not leases.has_expired("/red", 19)


def test_who_drives_another_robot_leaves_the_first(leases):
    leases.renew("/blue", ADA, 11.0, driving=True)
    assert leases.robots() == ["/blue"]


def test_the_end_of_a_lease_tells_whether_it_moved_the_robot(leases):
    assert leases.end("/red") == Lease(ADA, 10.0, True)
    assert leases.end("/red") is None
