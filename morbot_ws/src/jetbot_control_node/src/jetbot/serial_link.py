"""The edge to a serial port: which port a name means, and what to do when it fails."""

import errno
import termios
import threading
from pathlib import Path

from .errors import BusError, InvalidValue
from .host import how_to_open

BAUD_RATE = 115200
PATIENCE = 0.05  # seconds that a write may take before the port counts as stuck


class SerialLink:
    """Bytes to and from a serial port, which is opened when first used, and anew after a failure.

    name: a device or any pyserial URL. Raises BusError.
    """

    address = None  # one port, one board

    def __init__(self, name):
        if not isinstance(name, str) or not name:
            raise InvalidValue(f"port cannot be {name!r}", "Give a serial device such as /dev/ttyACM0.")
        self.name = name
        self.transfers = self.errors = 0
        self._port = None
        self._opening = threading.RLock()  # one thread may write while another reads; a signal handler may write, too

    def write(self, data):
        """Send bytes at once."""
        self.transfers += 1
        self._try(lambda port: port.write(data))

    def read(self):
        """The bytes that have arrived; waits up to ``PATIENCE`` seconds for the first, and may return none."""
        return self._try(lambda port: port.read(port.in_waiting or 1))

    def close(self):
        """Close the port; the next use opens it again."""
        with self._opening:
            port, self._port = self._port, None
            if port is not None:
                port.close()

    def _try(self, action):
        port = None
        try:
            with self._opening:
                port = self._port = self._port or open_port(self.name)
            return action(port)
        except BusError:
            raise  # already in words
        except (OSError, termios.error, TypeError) as error:  # TypeError: of a port that another thread closed
            self.errors += 1
            with self._opening:
                if port is self._port:  # and not one that another thread has opened since
                    self.close()
            raise explain(error, self.name) from None


def open_port(name):
    """The port with this name, at 115200 8N1."""
    try:
        from serial import serial_for_url  # here, so that a robot without a serial port does not need it
        return serial_for_url(name, BAUD_RATE, timeout=PATIENCE, write_timeout=PATIENCE)
    except ImportError:
        raise BusError("the Python package pyserial is missing",
                       "Install it: sudo apt install python3-serial") from None
    except ValueError as error:
        raise InvalidValue(f"port cannot be {name!r}: {error}") from None


def explain(error, name):
    """The BusError that says what an error of pyserial means and what to do."""
    number = getattr(error, "errno", None)
    if Path(name).exists() and not Path(name).is_char_device():
        return BusError(f"{name} is no serial port", "Give a serial device such as /dev/ttyACM0.", errno.ENOTTY)
    reason, advice = {
        errno.ENOENT: (f"there is no serial port {name}", "Is the board plugged in and switched on?"),
        errno.EACCES: (f"no permission to open {name}", how_to_open(name, "dialout")),
    }.get(number, (f"no answer from {name}", "Is the board plugged in and switched on?"))
    return BusError(reason, advice, number)
