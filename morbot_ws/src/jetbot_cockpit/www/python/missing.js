// What Python on a computer has, and the page has not: what to use instead.

import { t } from "../language.js";

const ROBOT = t("run the program on the robot with rosrun");
const CHECK = t("check its name, or run the program on the robot with rosrun");
const FILES = t("programs here have no files; print what you want to keep");
const PROGRAMS = t("programs here start no other programs");
const NETWORK = t("programs here reach their robot alone, and no network");
const KEYS = t("give the value to a name at the top of the program");

const ROWS = [
  ["numpy np scipy pandas sympy sklearn statistics", t("use lists and the module math")],
  ["torch torchvision tensorflow keras onnxruntime tensorrt torch2trt", ROBOT],
  ["cv2 cv_bridge PIL picamera skimage image_transport sensor_msgs.msg.Image sensor_msgs.msg.CompressedImage "
    + "sensor_msgs.msg.CameraInfo", t("programs here see no pictures; run it on the robot with rosrun")],
  ["tf tf2_ros tf2_geometry_msgs tf_conversions transformations transforms3d",
    t("the heading is 2 * math.atan2(orientation.z, orientation.w)")],
  ["matplotlib plt pylab seaborn plotly", t("print(\"name\", value) draws a curve")],
  ["open os.path pathlib shutil glob tempfile pickle csv sqlite3 zipfile rosbag rospkg logging", FILES],
  ["os subprocess signal platform psutil roslaunch rosnode rosgraph", PROGRAMS],
  ["threading multiprocessing concurrent asyncio queue _thread rospy.AsyncSpinner",
    t("do one thing after the other in a loop with rate.sleep()")],
  ["socket socketserver requests urllib urllib2 http websocket websockets paho ssl ftplib smtplib xmlrpc", NETWORK],
  ["input raw_input getpass curses pynput keyboard readchar termios tty select msvcrt argparse optparse sys.argv "
    + "sys.stdin", KEYS],
  ["tkinter pygame turtle PyQt5 ipywidgets IPython traitlets rviz",
    t("use print; the map shows where the robot drives")],
  ["jetbot Jetson RPi smbus smbus2 serial spidev board busio adafruit_motor Adafruit_MotorHAT gpiozero qwiic",
    t("publish a Twist on cmd_vel to drive the wheels")],
  ["rospy.Service rospy.ServiceProxy rospy.ServiceException rospy.wait_for_service std_srvs actionlib actionlib_msgs "
    + "dynamic_reconfigure", t("the page has topics, but no services and no actions")],
  ["exit quit", t("the program ends after its last line, and sys.exit() ends it before")],
  ["collections.Counter", t("count in a dictionary: counts[x] = counts.get(x, 0) + 1")],
  ["itertools.product itertools.permutations itertools.combinations", t("put a loop into a loop")],
  ["enum dataclasses", t("write a class with numbers and texts")], ["match.groups", t("use group(1)")],
  ["xrange", t("use range")], ["unicode", t("use str")],
];

const HINTS = new Map(ROWS.flatMap(([names, hint]) => names.split(" ").map((name) => [name, hint])));
export const NOT_HERE = [...HINTS.keys()];

// Returns what to use instead of a name, such as "numpy" or "rospy.Service", or undefined. Of "a.b.c", also "a.b" and
// "a" are looked for.
/** @param {string} name @returns {string | undefined} */
export function insteadOf(name) {
  const parts = name.split(".");
  const wholes = parts.map((_, index) => parts.slice(0, parts.length - index).join("."));
  return HINTS.get(wholes.find((each) => HINTS.has(each)) ?? "");
}

// Returns the sentence about a name that the page does not have.
/** @param {string} given such as "numpy", "input()", or "/scan", a topic */
export function missing(given) {
  if (given.startsWith("/")) return t("Nothing in the page publishes the topic {name}.", { name: given });
  const name = given.replace("()", "");
  return t("“{name}” is not in the page: {hint}.", { name, hint: insteadOf(name) ?? CHECK });
}
