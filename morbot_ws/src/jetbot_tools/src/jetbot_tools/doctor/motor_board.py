"""Checks of a motor board: on an I2C bus, whose chips are only read, or on a serial port."""

import contextlib
import errno
import threading
from typing import List, Optional, Sequence, Type, Union

from jetbot import host
from jetbot.boards import BOARDS, SERIAL_BOARD, MotorDriver, PwmMotors, find_board
from jetbot.boards.jetbot_pro import JetBotPro
from jetbot.connection import locate
from jetbot.errors import BusError, JetbotError, NoAnswer
from jetbot.i2c import I2CDevice, bus_name
from jetbot.serial_link import SerialLink
from jetbot.supply import CONFIGURATION, read_word

from ..options import launch_command
from .computer import Check

TELEMETRY_TIMEOUT = 1.0  # s; a JetBot Pro sends many frames in that time

# What to know of a JetBot's own address. Waveshare's revisions:
# https://github.com/dusty-nv/jetbot_ros/issues/31, https://github.com/NVIDIA-AI-IOT/jetbot/issues/314
LAYOUTS = {0x60: "jetbot drives both layouts; Waveshare's boards from before August 2020 have Adafruit's."}
SERVO_ADDRESSES = range(0x40, 0x60)  # a PCA9685 there may as well be a servo board's, whose own address is 0x40
SERVO_ADVICE = "A servo board answers in the same way: do not drive that."
CONDITION = "the chip at 0x{:02x} is the motor board {} and no servo board"
CLOCK_STRETCHING = ("It stretches the clock, which a Raspberry Pi 4 or older mishandles. If transfers fail, write to "
                    "its config.txt dtparam=i2c_arm=off and dtoverlay=i2c-gpio,bus=3,i2c_gpio_sda=2,i2c_gpio_scl=3, "
                    "restart it, and use i2c_bus:=3")

# CONFIGURATION of the power monitors, 16 bits, at power-on (Texas Instruments SBOS448, SBOS576).
CONFIGURATIONS = {0x399F: "INA219", 0x7127: "INA3221"}
MONITOR_ADDRESSES = range(0x40, 0x50)

# Not from 0x70 on: a read begins with the byte of a register, which would switch a multiplexer (TCA9548A).
JUMPER_ADDRESSES = range(0x40, 0x70)


def check_board(board: str, i2c_bus: Union[int, str], port: str, i2c_address: Union[int, str, None] = None) -> Check:
    """Check that a board answers on its bus or port; raise InvalidValue for an unknown board or a bad bus."""
    row = find_board(board, i2c_address)
    place = locate(row, i2c_bus, port)
    if not row.address:
        return check_serial(place)
    try:
        return check_chip(place, row.address, board)
    except JetbotError as error:
        return failed(place, row.address, error)


def check_chips(bus: Union[int, str], addresses: Sequence[int], board: str = "") -> List[Check]:
    """Check the first address, and the others at which a chip answers; if the bus does not work, no further one.

    board: the one that must be there, if it is named.
    """
    checks = []
    for address in addresses:
        try:
            checks.append(check_chip(bus, address, board))
        except NoAnswer as error:
            if address == addresses[0]:
                checks.append(failed(bus, address, error))
        except JetbotError as error:
            checks.append(failed(bus, address, error))
            if not isinstance(error, BusError) or error.errno != errno.EBUSY:
                break
    return checks


def failed(bus: Union[int, str], address: int, error: JetbotError) -> Check:
    """Return the check of an address that cannot be read."""
    return Check(f"0x{address:02x} on {bus_name(bus)}", False, error.reason, error.advice)


def check_chip(bus: Union[int, str], address: int, board: str = "") -> Check:
    """Check which motor boards the chip at an address can be, or whether the one that is named; raise JetbotError."""
    name = f"0x{address:02x} on {bus_name(bus)}"
    with contextlib.closing(I2CDevice(bus, address)) as device:
        driver = driver_for(device)
        monitor = "" if driver else power_monitor(device)
    boards = boards_with(driver, address)
    may_be_servos = boards and driver is PwmMotors and address in SERVO_ADDRESSES
    condition = CONDITION.format(address, " or ".join(boards)) if may_be_servos else ""
    if board:
        boards = [board] if BOARDS[board].driver is driver else []
    if not boards:
        wanted = board or next((each for each, row in BOARDS.items() if row.address == address), "jetbot")
        found = f"an {monitor}, which measures the supply" if monitor else f"not a {BOARDS[wanted].driver.chip_name}"
        return Check(name, False, f"the chip that answers is {found}", clock_advice(address))
    own = BOARDS[boards[0]].address
    command = launch_command(board=boards[0], i2c_bus=bus, i2c_address=None if address == own else f"0x{address:02x}")
    advice = SERVO_ADVICE if condition else LAYOUTS.get(own) or clock_advice(own)
    return Check(name, True, f"answers, and can be a board {' or '.join(boards)}", advice, command, condition)


def clock_advice(address: int) -> str:
    """Return what to do where this computer mishandles the clock of the board at this address, or ""."""
    stretches = any(row.driver.stretches_clock for row in BOARDS.values() if row.address == address)
    return CLOCK_STRETCHING if stretches and host.mishandles_clock_stretching(host.model()) else ""


def driver_for(chip: I2CDevice) -> Optional[Type[MotorDriver]]:
    """Return the driver of the motor board that the chip belongs to, None for any other chip; raise JetbotError.

    At a JetBot's own address, any other chip is taken for its board's: Linux's test chip, i2c-stub, holds only zeros.
    """
    for driver in dict.fromkeys(row.driver for row in BOARDS.values()):
        if driver.recognizes(chip):
            return driver
    return BOARDS["jetbot"].driver if chip.address == BOARDS["jetbot"].address else None


def power_monitor(chip: I2CDevice) -> str:
    """Return "INA219" or "INA3221" for one as it is at power-on, "" for any other chip; raise JetbotError."""
    if chip.address not in MONITOR_ADDRESSES:
        return ""
    return CONFIGURATIONS.get(read_word(chip, CONFIGURATION), "")


def boards_with(driver: Optional[Type[MotorDriver]], address: int) -> List[str]:
    """Return the boards with this driver whose address this is, then those whose jumpers select it."""
    own = [board for board, row in BOARDS.items() if row.driver is driver and row.address == address]
    return own + [board for board, row in BOARDS.items()
                  if row.driver is driver and address in row.jumpers and board not in own]


def check_serial(port: str) -> Check:
    """Check that a JetBot Pro sends telemetry on the serial port."""
    arrived = threading.Event()
    try:
        with contextlib.closing(JetBotPro(SerialLink(port))) as driver:
            driver.link.read()  # raises what ``listen`` would not
            driver.listen(lambda telemetry: arrived.set())
            arrived.wait(TELEMETRY_TIMEOUT)
    except JetbotError as error:
        return Check(port, False, error.reason, error.advice)
    if arrived.is_set():
        return Check(port, True, "a JetBot Pro reports", command=launch_command(board=SERIAL_BOARD, port=port))
    return Check(port, False, "opens, but no JetBot Pro reports", "Is it this port, and is the robot switched on?")
