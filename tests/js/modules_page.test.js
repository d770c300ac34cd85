// What only a page does with a program: its commands, curves and prints, and what it does not have. What it says to
// a pupil of what it does not have is in mistakes.test.js.

import assert from "node:assert/strict";
import { test } from "node:test";

import { runPython } from "./micropython.js";

const NODE = "import rospy\nfrom geometry_msgs.msg import *\nfrom std_msgs.msg import *\nrospy.init_node('node')\n";

const run = (text, options) => runPython(NODE + text, options);

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
  ...["asyncio", "select", "pathlib", "gc", "os.path"]
    .map((name) => [`import ${name}`, `ImportError: no module named '${name}'`]),
  ["rospy.Subscriber('/odom', Twist)", "TypeError: /odom carries nav_msgs/Odometry, not geometry_msgs/Twist"],
  ["rospy.Publisher('a', Int32, queue_size=1)\nrospy.Subscriber('a', Float32)",
    "TypeError: a carries std_msgs/Int32, not std_msgs/Float32"],
  ["rospy.wait_for_message('scan', Float32)", "NotHere: /scan"],
  ["rospy.wait_for_message('line', Float32MultiArray, 0.5)",
    "ROSException: timeout exceeded while waiting for message on topic line"],
  ["rospy.Subscriber('line', Float32MultiArray, lambda message: 1 / 0)\nrospy.spin()",
    "ZeroDivisionError: divide by zero"],
  ["import sys\nsys.exit(3)", ""],
]) {
  test(`${text.split("\n").at(-1)} ends with: ${error}`, async () => {
    assert.equal((await run(text, { senses: { line: text.includes("1 / 0") ? [0, 0, 0] : null } })).error, error);
  });
}

const PRINTS = { // a program, its lines, and how it fails
  "each function at the end runs, also after one that fails": [`
rospy.on_shutdown(lambda: 1 / 0)
rospy.on_shutdown(lambda: print("the last one"))`, ["the last one"], "ZeroDivisionError: divide by zero"],
  "a program may ask for a time whether anybody hears what it publishes": [`
late = rospy.Publisher("late", Int32, queue_size=1)
print(late.get_num_connections())
rospy.sleep(2)
rospy.Subscriber("late", Int32)
print(late.get_num_connections())`, ["0", "1"]],
  "a topic that the program begins to publish soon is waited for": [`
rospy.Subscriber("late", Int32, lambda message: print(message.data))
rospy.sleep(0.9)
late = rospy.Publisher("late", Int32, queue_size=1)
rospy.sleep(2)
late.publish(3)
rospy.sleep(0.1)`, ["3"]],
  "a callback that waits is not called again meanwhile, but others are": [`
def slow(message):
    print("slow begins")
    rospy.sleep(0.5)
    print("slow ends", len(others) >= 4)
others = []
rospy.Subscriber("line", Float32MultiArray, slow)
rospy.Subscriber("jetbot_controller/wheels", Float32MultiArray, others.append)
rospy.sleep(0.55)`, ["slow begins", "slow ends True"]],
  "a full queue loses its oldest messages": [`
publisher = rospy.Publisher("x", Int32, queue_size=1)
rospy.Subscriber("x", Int32, lambda message: print(message.data), queue_size=2)
for number in range(5):
    publisher.publish(number)
rospy.sleep(0.1)`, ["3", "4"]],
  "the speed is the robot's own, and so is the command beside the wheels": [`
from nav_msgs.msg import Odometry
twist = rospy.wait_for_message("odom", Odometry).twist.twist
print(twist.linear.x, twist.angular.z)
print(rospy.wait_for_message("jetbot_controller/wheels", Float32MultiArray).data)`,
  ["0.25 -1.0", "(0.5, 0.1, 0.4, 0.6)"]],
  "a line is shown once it ends, or the program does": [`
import io, sys
print("a", end="")
print("b\\nc", end="")
print("to nobody", file=io.StringIO())
print("!", file=sys.stderr)
print(".", end="", flush=True)
1 / 0`, ["ab", "c!", "."], "ZeroDivisionError: divide by zero"],
};
const SENSES = { speed: [0.25, -1], command: [0.5, 0.1], wheels: [0.4, 0.6] };
for (const [what, [text, lines, error = ""]] of Object.entries(PRINTS)) {
  test(what, async () => {
    const page = await run(text, { senses: SENSES });
    assert.deepEqual([page.lines, page.error], [lines, error]);
  });
}

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

test("a wait without callbacks is one wait of the page, and a spin takes its turn ten times a second", async () => {
  assert.deepEqual((await run("rospy.sleep(5)")).turns, [5]);
  const { turns, error } = await run("rospy.spin()", { longest: 1 });
  assert.equal(error, "cut");
  assert.ok(turns.length < 15, turns.length);
});
