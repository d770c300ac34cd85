// What only a page does with a program: its commands, curves and prints, and what it does not have.

import assert from "node:assert/strict";
import { test } from "node:test";

import { write } from "./blockly.js";
import { runPython } from "./micropython.js";
import { interpret } from "./programs.js";

const { EMPTY } = await import("#www/program/check.js");
const { EXAMPLES } = await import("#www/program/examples.js");
const NODE = "import rospy\nfrom geometry_msgs.msg import *\nfrom std_msgs.msg import *\nrospy.init_node('node')\n";

const run = (text, options) => runPython(NODE + text, options);

// Returns the commands that differ from the one before, in the order of time: [tenths of a second, x, z].
function changes(commands) {
  const rounded = commands.map(([ms, ...command]) => [Math.round(ms / 100), ...command.map((each) => each.toFixed(6))]);
  return rounded.filter((each, index) => String(each.slice(1)) !== String(rounded[index - 1]?.slice(1)));
}

for (const [name, example] of Object.entries({ EMPTY, ...EXAMPLES })) {
  test(`the Python of ${name} commands what the blocks do`, async () => {
    const senses = { here: { X: 0 }, line: [0.3, 0, 1], wheels: [0, 0] };
    const page = await runPython(write(JSON.parse(example)).text, { senses: { line: senses.line }, longest: 9.9 });
    const blocks = interpret(JSON.parse(example), senses);
    const commands = page.drives.map(([seconds, ...command]) => [seconds * 1000, ...command]);
    assert.ok(["", "cut"].includes(page.error), page.error);
    if (name === "Drive until I am there") assert.deepEqual(page.lines.map(Number).map(Math.round), [1]);
    else assert.deepEqual(changes(commands), changes(blocks.commands));
  });
}

test("a lesson's node reads the robot's place while it drives, and stops there", async () => {
  const { drives, known } = await run(`
from nav_msgs.msg import Odometry
place = Pose2D()
def on_odom(message):
    place.x = message.pose.pose.position.x
rospy.Subscriber("odom", Odometry, on_odom)
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
while place.x < 0.96:
    publisher.publish(Twist(linear=Vector3(x=0.5)))
    rate.sleep()
publisher.publish(Twist())`);
  assert.ok(Math.abs(known.pose[0] - 0.96) < 0.04, known.pose);
  assert.deepEqual(drives.at(-1).slice(1), [0, 0]);
});

test("the speed is the robot's own, and so is the command beside the wheels", async () => {
  const { lines } = await run(`
from nav_msgs.msg import Odometry
twist = rospy.wait_for_message("odom", Odometry).twist.twist
print(twist.linear.x, twist.angular.z)
from std_msgs.msg import Float32MultiArray
print(rospy.wait_for_message("jetbot_controller/wheels", Float32MultiArray).data)`, {
    senses: { speed: [0.25, -1], command: [0.5, 0.1], wheels: [0.4, 0.6] } });
  assert.deepEqual(lines, ["0.25 -1.0", "(0.5, 0.1, 0.4, 0.6)"]);
});

test("a name and a number that are printed are a value of a curve, too", async () => {
  const { lines, curves } = await run(`
print("x", 1.5)
print("count", 3, sep=": ")
print("true", True)
print("a text alone", "b")
print(1, 2)
print("x", 1, 2)`);
  assert.deepEqual(curves, [["x", 1.5], ["count", 3]]);
  assert.deepEqual(lines, ["x 1.5", "count: 3", "true True", "a text alone b", "1 2", "x 1 2"]);
});

test("a line is shown once it ends, or the program does", async () => {
  const { lines } = await run(`
import io, sys
print("a", end="")
print("b\\nc", end="")
print("to nobody", file=io.StringIO())
print("!", file=sys.stderr)
print(".", end="", flush=True)
1 / 0`);
  assert.deepEqual(lines, ["ab", "c!", "."]);
});

test("messages for a person are shown with their level", async () => {
  const { lines } = await run(`
rospy.logdebug("nobody sees this")
rospy.loginfo("x is %.1f", 0.5)
rospy.logwarn("100 % sure")
rospy.logerr(5)
rospy.logfatal("the end")
for count in range(6):
    rospy.loginfo_once("once %s" % count)
    rospy.logwarn_throttle(0.25, f"x is {count / 10}")
    rospy.logerr_throttle_identical(9, "again")
    rospy.sleep(0.1)`);
  assert.deepEqual(lines, ["[INFO]: x is 0.5", "[WARN]: 100 % sure", "[ERROR]: 5", "[FATAL]: the end", "[INFO]: once 0",
    "[WARN]: x is 0.0", "[ERROR]: again", "[WARN]: x is 0.3"]);
  const debug = await runPython("import rospy\nrospy.init_node('a', log_level=rospy.DEBUG)\nrospy.logdebug('seen')");
  assert.deepEqual(debug.lines, ["[DEBUG]: seen"]);
});

for (const [text, error] of [
  ["rospy.Service('a', None, None)", "NotHere: rospy.Service"],
  ["from rospy import ServiceProxy", "NotHere: rospy.ServiceProxy"],
  ["rospy.spinn()", "AttributeError: module 'rospy' has no attribute 'spinn'"],
  ["from sensor_msgs.msg import Image", "NotHere: sensor_msgs.msg.Image"],
  ["from nav_msgs.msg import OccupancyGrid", "NotHere: nav_msgs.msg.OccupancyGrid"],
  ["from geometry_msgs.msg import Twits", "ImportError: can't import name Twits"],
  ["input('?')", "NotHere: input()"],
  ["open('a')", "NotHere: open()"],
  ...["js", "jsffi", "os", "vfs", "uctypes", "micropython", "asyncio", "select", "pathlib", "gc", "numpy", "os.path"]
    .map((name) => [`import ${name}`, `ImportError: no module named '${name}'`]),
  ["rospy.Publisher('cmd_vel', Float32, queue_size=1)",
    "TypeError: cmd_vel carries geometry_msgs/Twist, not std_msgs/Float32"],
  ["rospy.Subscriber('/odom', Twist)", "TypeError: /odom carries nav_msgs/Odometry, not geometry_msgs/Twist"],
  ["rospy.Publisher('a', Int32, queue_size=1)\nrospy.Subscriber('a', Float32)",
    "TypeError: a carries std_msgs/Int32, not std_msgs/Float32"],
  ["rospy.Subscriber('scan', Float32, print)\nrospy.spin()", "NotHere: /scan"],
  ["rospy.wait_for_message('scan', Float32)", "NotHere: /scan"],
  ["rospy.wait_for_message('line', Float32MultiArray, 0.5)",
    "ROSException: timeout exceeded while waiting for message on topic line"],
  ["rospy.Publisher('/blue/cmd_vel', Twist, queue_size=1)", "NotHeard: /blue/cmd_vel"],
  ["p = rospy.Publisher('cmd_val', Twist, queue_size=1)\nwhile not p.get_num_connections(): rospy.sleep(0.1)",
    "NotHeard: /cmd_val"],
  ["import sys\nsys.exit(3)", ""],
]) {
  test(`the page says of ${text.split("\n")[0]} what it lacks`, async () => {
    assert.equal((await run(text, { senses: { line: null } })).error, error);
  });
}

test("each function at the end runs, also after one that fails", async () => {
  const { lines, error } = await run(`
rospy.on_shutdown(lambda: 1 / 0)
rospy.on_shutdown(lambda: print("the last one"))`);
  assert.deepEqual([lines, error], [["the last one"], "ZeroDivisionError: divide by zero"]);
});

test("a program may ask for a time whether anybody hears what it publishes", async () => {
  const { lines, error } = await run(`
late = rospy.Publisher("late", Int32, queue_size=1)
print(late.get_num_connections())
rospy.sleep(2)
rospy.Subscriber("late", Int32)
print(late.get_num_connections())`);
  assert.deepEqual([lines, error], [["0", "1"], ""]);
});

test("a topic that the program begins to publish soon is waited for", async () => {
  const { lines, error } = await run(`
rospy.Subscriber("late", Int32, lambda message: print(message.data))
rospy.sleep(0.9)
late = rospy.Publisher("late", Int32, queue_size=1)
rospy.sleep(2)
late.publish(3)
rospy.sleep(0.1)`);
  assert.deepEqual([lines, error], [["3"], ""]);
});

test("a callback that waits is not called again meanwhile, but others are", async () => {
  const { lines, error } = await run(`
def slow(message):
    print("slow begins")
    rospy.sleep(0.5)
    print("slow ends", len(others) >= 4)
others = []
subscriber = rospy.Subscriber("line", Float32MultiArray, slow)
rospy.Subscriber("jetbot_controller/wheels", Float32MultiArray, others.append)
rospy.sleep(0.6)
print("main")`);
  assert.deepEqual(lines.slice(0, 2), ["slow begins", "slow ends True"]);
  assert.equal(error, "");
});

test("a callback that fails ends the program", async () => {
  const { error } = await run("rospy.Subscriber('line', Float32MultiArray, lambda message: 1 / 0)\nrospy.spin()");
  assert.equal(error, "ZeroDivisionError: divide by zero");
});

test("two topics that answer each other do not keep the program from what it does", async () => {
  const { lines, turns } = await run(`
ping, pong = [rospy.Publisher(name, Int32, queue_size=1) for name in ("ping", "pong")]
rospy.Subscriber("ping", Int32, lambda message: pong.publish(message.data + 1))
rospy.Subscriber("pong", Int32, lambda message: ping.publish(message.data + 1))
ping.publish(0)
rospy.sleep(1)
print("done")`);
  assert.deepEqual(lines, ["done"]);
  assert.ok(turns.length < 150, turns.length);
});

test("a full queue loses its oldest messages", async () => {
  const { lines } = await run(`
publisher = rospy.Publisher("x", Int32, queue_size=1)
rospy.Subscriber("x", Int32, lambda message: print(message.data), queue_size=2)
for number in range(5):
    publisher.publish(number)
rospy.sleep(0.1)`);
  assert.deepEqual(lines, ["3", "4"]);
});

test("a wait without callbacks is one wait of the page, and a spin takes its turn ten times a second", async () => {
  assert.deepEqual((await run("rospy.sleep(5)")).turns, [5]);
  const { turns, error } = await run("rospy.spin()", { longest: 1 });
  assert.equal(error, "cut");
  assert.ok(turns.length < 15, turns.length);
});

test("the robot's topics have its namespace, and the program's names, too", async () => {
  const { lines, drives } = await run(`
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
absolute = rospy.Publisher("/red/cmd_vel", Twist, queue_size=1)
print(rospy.get_name(), rospy.get_namespace(), publisher.name)
absolute.publish(Twist(Vector3(0.5, 0, 0), Vector3()))`, { more: { namespace: () => "/red" } });
  assert.deepEqual(lines, ["/red/node /red/ /red/cmd_vel"]);
  assert.deepEqual(drives.map(([, ...command]) => command), [[0.5, 0]]);
});
