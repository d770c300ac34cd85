"""What the doctor finds on a bus: motor boards and other chips."""

import errno

import pytest
from examined import lines, make_bare

from jetbot import host, i2c
from jetbot.boards import BOARDS
from jetbot_tools.doctor import checkup, computer, motor_board

PCA9685 = {0x00: 0x11, 0x01: 0x04, 0x02: 0xE2, 0x03: 0xE4, 0x04: 0xE8}
SCMD = {0x01: 0xA9}
LAUNCH = "roslaunch jetbot_control_node jetbot_controller.launch"
COULD, NONE = f"ok  robot: could drive. Start it with: {LAUNCH}", "NOT robot: no motor board found."
AN = "the chip that answers is an"


class Bus:
    """A bus that only reads. chips: {address: {register: byte}, or the number of the error}; read: the addresses."""

    def __init__(self, chips):
        self.chips, self.read = chips, []

    def read_byte_data(self, address, register):
        return self.read_i2c_block_data(address, register, 1)[0]

    def read_i2c_block_data(self, address, register, length):
        self.read.append(address)
        chip = self.chips.get(address, self.chips.get("any", errno.EREMOTEIO))
        if isinstance(chip, int):
            raise OSError(chip, "")
        return [chip.get(register + offset, 0) for offset in range(length)]

    def close(self):
        """Nothing to close."""


@pytest.fixture(autouse=True)
def bare(six_boards, monkeypatch, tmp_path):
    make_bare(monkeypatch, tmp_path)


@pytest.fixture
def plug_in(monkeypatch):
    """Make this computer's /dev/i2c-N, all of them, a Bus with these chips, and return it."""
    def make(chips):
        bus = Bus(chips)
        monkeypatch.setattr(i2c, "open_bus", lambda name, *address: bus)
        return bus
    return make


@pytest.mark.parametrize("chips, asked, line, verdict", [
    ({0x6F: PCA9685}, {}, "ok  0x6f on BUS: answers, and can be a board jetbot or adafruit or waveshare.",
     f"{COULD} i2c_address:=0x6f"),  # at an address that its jumpers select
    ({0x63: SCMD}, {}, "ok  0x63 on BUS: answers, and can be a board sparkfun.",
     f"{COULD} board:=sparkfun i2c_address:=0x63"),
    ({0x60: SCMD}, {}, "ok  0x60 on BUS: answers, and can be a board sparkfun.",
     f"{COULD} board:=sparkfun i2c_address:=0x60"),
    ({0x40: PCA9685, 0x5D: SCMD}, {}, "", f"{COULD} board:=sparkfun"),  # which is certain, unlike the servo board's
    ({0x60: PCA9685, 0x6E: PCA9685}, {"address": 0x6E}, "", f"{COULD} i2c_address:=0x6e"),
    ({0x60: PCA9685}, {"address": 0x62}, "NOT 0x62 on BUS: no answer from 0x62 on BUS.", NONE),
    ({0x40: PCA9685}, {"board": "waveshare_hat"}, "", f"{COULD} board:=waveshare_hat"),
    ({0x41: PCA9685}, {"board": "waveshare_hat"}, "", f"{COULD} board:=waveshare_hat i2c_address:=0x41"),
    ({0x40: PCA9685, 0x5D: {}, 0x60: PCA9685}, {"board": "adafruit"}, "", f"{COULD} board:=adafruit"),
    ({0x40: PCA9685, 0x5D: {}, 0x61: PCA9685}, {"board": "waveshare"}, "",
     f"{COULD} board:=waveshare i2c_address:=0x61"),
    ({0x40: PCA9685, 0x5D: {}, 0x58: SCMD}, {"board": "sparkfun"}, "", f"{COULD} board:=sparkfun i2c_address:=0x58"),
    ({0x68: {}}, {}, "", NONE), ({0x61: {}, 0x41: {0x00: 0x39, 0x01: 0x9F}}, {}, "", NONE), ({0x40: {}}, {}, "", NONE),
    ({0x40: {0x00: 0x39, 0x01: 0x9F}}, {}, f"NOT 0x40 on BUS: {AN} INA219, which measures the supply.", NONE),
    ({0x40: {0x00: 0x71, 0x01: 0x27}}, {}, f"NOT 0x40 on BUS: {AN} INA3221, which measures the supply.", NONE)],
    ids=lambda value: str(value)[:40])
def test_what_is_on_the_bus_and_how_to_drive_it(plug_in, chips, asked, line, verdict):
    bus = plug_in(chips)
    output = lines(1, **asked)
    assert any(each.startswith(line.replace("BUS", "/dev/i2c-1")) for each in output)
    assert output[-1] == verdict or verdict is NONE and output[-1].startswith(NONE)
    assert "address" not in asked or 0x60 not in bus.read
    assert asked.get("board", "waveshare_hat") == "waveshare_hat" or not any("0x40 on" in each for each in output)


@pytest.mark.parametrize("address, command", [
    (0x40, "board:=waveshare_hat"), (0x41, "board:=waveshare_hat i2c_address:=0x41")])
def test_what_may_be_a_servo_board_is_offered_on_one_condition(plug_in, address, command):
    plug_in({address: PCA9685})
    *_, chip, _, robot = checkup.run_checks(1)
    assert str(chip).endswith(" A servo board answers in the same way: do not drive that.")
    condition = f"the chip at 0x{address:02x} is the motor board waveshare_hat and no servo board"
    assert str(robot) == f"NOT robot: could drive if {condition}. Start it with: {LAUNCH} {command}"
    assert robot.condition == chip.condition == condition
    assert lines(1, address=address)[-1] == str(robot)


@pytest.mark.parametrize("board, address, uncertain", [
    ("waveshare_hat", 0x40, True), ("adafruit", 0x40, True), ("adafruit", 0x60, False), ("waveshare_hat", 0x61, False)])
def test_what_may_be_a_servo_board_is_marked_whatever_board_is_tried_there(plug_in, board, address, uncertain):
    plug_in({0x40: PCA9685, 0x60: PCA9685, 0x61: PCA9685})
    check = motor_board.check_board(board, 1, "", address)
    assert check.ok and bool(check.condition) == uncertain


@pytest.mark.parametrize("board, port", [("jetbot", "/dev/nowhere"), ("jetbot_pro", None), ("", "/dev/nowhere")])
def test_a_board_that_is_named_and_a_port_are_looked_for_where_they_can_be(plug_in, monkeypatch, board, port):
    plug_in({0x40: PCA9685, 0x5D: SCMD})
    monkeypatch.setattr(host, "buses", lambda: [1])
    output = "\n".join(lines(port=port, board=board))
    assert ("0x60 on /dev/i2c-1" in output, "/dev/nowhere" in output) == (board == "jetbot", board != "jetbot")
    assert "NOT robot: no motor board found." in output


def test_a_multiplexer_which_a_read_would_switch_is_left_alone(plug_in):
    bus = plug_in({})
    lines(1)
    assert (min(bus.read), max(bus.read)) == (0x40, 0x6F)


def test_other_addresses_are_read_on_the_robots_bus_alone(plug_in, monkeypatch):
    monkeypatch.setattr(host, "model", lambda: "NVIDIA Jetson Nano Developer Kit")
    monkeypatch.setattr(host, "buses", lambda: [0])
    bus = plug_in({})
    lines()
    assert set(bus.read) == {row.address for row in BOARDS.values() if row.address}
    monkeypatch.setattr(host, "buses", lambda: [1])
    lines()
    assert set(range(0x40, 0x70)) == set(bus.read)


def test_another_program_on_the_bus_is_the_first_line_after_the_computers(plug_in, monkeypatch):
    monkeypatch.setattr(checkup, "check_users", lambda device: [computer.Check(device, False, "also open in drive.py")])
    plug_in({})
    assert lines(1)[2] == "NOT /dev/i2c-1: also open in drive.py."


def test_a_bus_that_is_stuck_is_not_read_at_every_address(plug_in):
    bus = plug_in({"any": errno.ETIMEDOUT})
    assert lines(1)[2].startswith("NOT 0x60 on /dev/i2c-1: the bus /dev/i2c-1 is stuck.")
    assert len(bus.read) <= 3


@pytest.mark.parametrize("driver, reported", [("ina3221", False), ("pca9685-pwm", True)])
def test_a_chip_that_a_kernel_driver_holds(plug_in, monkeypatch, driver, reported):
    monkeypatch.setattr(i2c, "kernel_driver", lambda device: driver)
    plug_in({0x40: errno.EBUSY})
    output = lines(1)
    assert output[2].startswith("NOT 0x60 on /dev/i2c-1: no answer from 0x60")
    held = f"NOT 0x40 on /dev/i2c-1: 0x40 on /dev/i2c-1 is in use by the kernel driver {driver}."
    assert any(line.startswith(held) for line in output) == reported
    assert lines(1, address=0x40)[2].startswith(held)


@pytest.mark.parametrize("model, chip, reported", [
    ("Raspberry Pi 4 Model B Rev 1.4", SCMD, True), ("Raspberry Pi 4 Model B Rev 1.4", {}, True),
    ("Raspberry Pi 5 Model B Rev 1.0", SCMD, False)])
def test_a_computer_that_mishandles_the_clock_of_sparkfuns_board(plug_in, monkeypatch, model, chip, reported):
    monkeypatch.setattr(host, "model", lambda: model)
    plug_in({0x5D: chip})
    line = next(line for line in lines(1) if "0x5d on /dev/i2c-1" in line)
    assert ("dtoverlay=i2c-gpio,bus=3" in line) == reported


@pytest.mark.parametrize("board, address, finding", [
    ("waveshare", "0x61", "names the board waveshare, and 0x61 on /dev/i2c-1 answers"),
    ("sparkfun", "0x61", "names the board sparkfun, but the chip that answers is not a SparkFun motor driver"),
    ("waveshare", "0x5e", "names the board waveshare, but the chip that answers is not a PCA9685"),
    ("waveshare", "0x62", "names the board waveshare, but no answer from 0x62 on /dev/i2c-1")])
def test_the_files_board_must_be_at_the_files_address(tmp_path, plug_in, board, address, finding):
    plug_in({0x60: PCA9685, 0x61: PCA9685, 0x5E: SCMD})
    (tmp_path / "jetbot.yaml").write_text(f"board: {board}\ni2c_address: {address}")
    assert f"{tmp_path}/jetbot.yaml: {finding}." in lines()[2]
