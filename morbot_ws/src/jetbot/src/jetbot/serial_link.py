"""The edge to a serial port: which port a name means, and one sentence for each failure."""

import errno
import termios
import threading
from pathlib import Path
from typing import Any, Callable

from . import fake
from .errors import EXHAUSTED, BusError, InvalidValue, JetbotError, NoAnswer, OutOfResources
from .host import permission_advice

# Of pyserial's other URLs, spy:// writes files, alt:// and hwgrep:// choose a class or a device by themselves.
SCHEMES = ("socket", "rfc2217", "loop")
BAUD_RATE = 115200
READ_TIMEOUT = 0.05  # s: how long a read waits for the first byte
WRITE_TIMEOUT = 0.15  # s: how long a write may take, pauses of a busy computer included


class SerialLink:
    """Bytes to and from a serial port, which is opened at the first use, and again after a failure.

    port: a device, a URL of pyserial with one of SCHEMES, ``fake`` or ``fake:FOLDER``.
    transfers, errors: how many writes were tried, and how many reads and writes failed.
    Reads and writes raise BusError, or OutOfResources.
    """

    address = None  # one port, one board

    def __init__(self, port: str):
        if not isinstance(port, str) or not port:
            raise InvalidValue(f"a serial port cannot be {port!r}", "Give a device such as /dev/ttyACM0, or fake.")
        self.name = fake.expand(port)
        scheme, separator, _ = self.name.partition("://")
        if separator and not fake.folder_of(self.name) and scheme.lower() not in SCHEMES:
            raise InvalidValue(f"a serial port cannot be {port!r}",
                               "Give a device such as /dev/ttyACM0, a URL socket://... or rfc2217://..., or fake.")
        self.transfers = self.errors = 0
        self._port: Any = None
        self._opening = threading.RLock()  # one thread may write while another reads; a signal handler may write, too

    def write(self, data: bytes) -> None:
        """Send bytes at once."""
        self.transfers += 1
        self._try(lambda port: port.write(data))

    def read(self) -> bytes:
        """Return the bytes that have arrived; wait up to READ_TIMEOUT for the first, and maybe return none."""
        return self._try(lambda port: port.read(port.in_waiting or 1))

    def close(self) -> None:
        """Close the port; the next use opens it again."""
        with self._opening:
            port, self._port = self._port, None
            if port is not None:
                port.close()

    def _try(self, action: Callable[[Any], Any]) -> Any:
        port = None
        try:
            with self._opening:
                port = self._port = self._port or open_port(self.name)
            return action(port)
        except BusError:
            raise  # has its sentence already
        except (OSError, termios.error, TypeError) as error:  # TypeError: of a port that another thread closed
            self.errors += 1
            with self._opening:
                if port is self._port:  # and not one that another thread has opened since
                    self.close()
            raise explain(error, self.name) from None


def open_port(name: str) -> Any:
    """Return the port with this name, at 115200 8N1, with the methods of serial.Serial."""
    folder = fake.folder_of(name)
    if folder:
        from .fake.port import FakePort
        return FakePort(folder, READ_TIMEOUT)
    try:
        from serial import serial_for_url  # here: a robot without a serial port does not need it
        return serial_for_url(name, BAUD_RATE, timeout=READ_TIMEOUT, write_timeout=WRITE_TIMEOUT)
    except ImportError:
        raise BusError("the Python package pyserial is missing",
                       "Install it: sudo apt install python3-serial") from None
    except ValueError as error:
        raise InvalidValue(f"a serial port cannot be {name!r}: {error}") from None


def explain(error: Exception, name: str) -> JetbotError:
    """Return the BusError for an error that pyserial raised, or OutOfResources."""
    number = getattr(error, "errno", None)
    if number in EXHAUSTED:
        return OutOfResources(number)
    folder = fake.folder_of(name)
    if folder:
        advice = f"To plug it in: {fake.power_on_command(folder)}"
        return NoAnswer(f"no answer from {name}", advice, number)
    if number == errno.EACCES:
        return BusError(f"no permission to open {name}", permission_advice(name, "dialout"), number)
    if Path(name).exists() and not Path(name).is_char_device():
        return BusError(f"{name} is not a serial port", "Give a serial device such as /dev/ttyACM0.", number)
    reason = f"there is no serial port {name}" if number == errno.ENOENT else f"no answer from {name}"
    return NoAnswer(reason, "Is the board plugged in and switched on?", number, option="port")
