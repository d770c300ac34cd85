"""The parameters of a simulated robot. config/jetbot.yaml holds those of its body."""

from typing import Dict

from jetbot import fake
from jetbot.boards import find_board
from jetbot.connection import locate
from jetbot.kinds import ADDRESS, FRACTION, NUMBER, POSITIVE, SECONDS, Kind, is_number
from jetbot_control_node import parameters as controller
from jetbot_ros.node_parameters import Parameter, check_values, given

from .diff_drive import JETBOT

SHARED = ("board", "i2c_address", "publish_odom")  # that the controller's file may hold
FAKE = Kind(controller.is_fake_place, "fake, or fake:FOLDER")

PARAMETERS = {
    "board": Parameter("jetbot", controller.BOARD,
                       "motor board that the controller drives; jetbot is simulated with Adafruit's layout"),
    "i2c_bus": Parameter("fake", FAKE, "I2C bus that the controller drives: fake or fake:FOLDER"),
    "i2c_address": Parameter(None, ADDRESS, "I2C address of the board that the controller drives"),
    "port": Parameter("fake", FAKE, "serial port of a jetbot_pro: fake or fake:FOLDER"),
    "publish_odom": controller.PARAMETERS["publish_odom"],
    "wheel_separation": Parameter(JETBOT.wheel_separation, POSITIVE,
                                  "distance between the wheels, of NVIDIA's model in Isaac Sim", "m"),
    "wheel_diameter": Parameter(JETBOT.wheel_diameter, POSITIVE, "diameter of the left wheel, of the same model", "m"),
    "wheel_ratio": Parameter(JETBOT.wheel_ratio, POSITIVE, "diameter of the right wheel over that of the left one"),
    "max_speed": Parameter(JETBOT.max_speed, POSITIVE,
                           "speed of a wheel at full power; TT motors, about 200 rpm at 5 V", "m/s"),
    "motor_lag": Parameter(JETBOT.motor_lag, SECONDS,
                           "time to 63 % of a change of speed; an estimate: 0.35 kg on each wheel, and the 0.065 N m "
                           "of a TT motor at 5 V", "s"),
    "dead_band": Parameter(JETBOT.dead_band, FRACTION,
                           "duty below which a motor does not turn, at 1526 Hz; an estimate: 0.23 V of 5 V, to which "
                           "Adafruit's speeds of TT motor 3777 extrapolate"),
    **{name: controller.PARAMETERS[name] for name in ("swap_motors", "invert_left", "invert_right")},
    "variation": Parameter(JETBOT.variation, Kind(lambda value: is_number(value) and 0 <= value <= 1, "from 0 to 1"),
                           "how much this robot differs from the others, by its name; 0: not at all"),
    "world": Parameter("", Kind(lambda value: isinstance(value, str), "the name of a YAML file"),
                       "YAML file of the walls and lines around the robot; arena.yaml is one; none: nothing is there"),
    "x": Parameter(0.0, NUMBER, "where the robot starts", "m"),
    "y": Parameter(0.0, NUMBER, "where the robot starts", "m"),
    "yaw": Parameter(0.0, NUMBER, "heading at the start, counterclockwise", "rad"),
}


def resolve(typed: Dict[str, object]) -> Dict[str, object]:
    """Return all parameters: what is typed wins over the file ``body``, the file over the default.

    What the controller has too is the controller's: typed, or from its file ``config``, or its default.
    Raises InvalidValue.
    """
    own = {name: value for name, value in given(typed).items() if name not in ("config", "body")}
    body = controller.load(typed["body"]) if typed.get("body") else {}
    parameters = check_values({**body, **own}, PARAMETERS)
    shared = {name: typed.get(name, "") for name in (*SHARED, "config")}
    shared.update({name: parameters[name] for name in ("i2c_bus", "port")})
    resolved = controller.resolve(shared)
    return {**parameters, **{name: resolved[name] for name in SHARED}}


def fake_folder(parameters: Dict[str, object], namespace: str) -> str:
    """Return the folder of the fake bus or port that the board is on. namespace: the node's."""
    i2c_bus, port = (fake.expand(parameters[name], namespace) for name in ("i2c_bus", "port"))
    return fake.folder_of(locate(find_board(parameters["board"]), i2c_bus, port))
