// What a pupil reads after a mistake in a Python program, and on which line. MicroPython itself says what went wrong.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

import { explain } from "#www/python/mistakes.js";
import { syntaxProblem } from "#www/python/syntax.js";

import { failureInPage, failureOf } from "./micropython.js";

const CONVERT = "str(x) makes a text of a number, float(x) a number of a text.";
const NO_RESULT = "A function without return gives None.";
const CALL = "A function is called with brackets after its name: f()";
const SELF = "The first parameter of a method is self: def name(self):";
const NO_COLUMN = "This line begins in a column in which no line above it begins.";
const NO_PICTURES = "is not in the page: programs here see no pictures; run it on the robot with rosrun.";
const NO_FUNCTION = "What comes before “(” is not a function, but: module.";
const FORMAT = "In a text that begins with f, each { needs a name and a }: f\"{x}\"";
const FORMAT_LESS = "What is in { } is too much for the page's Python: first give it a name, x = ..., then write "
  + "f\"{x}\"";
const GIVE = "Give it a value before, or put a text between quotation marks.";
const UNKNOWN_LINE = "Python cannot read this line. Compare it with an example.";
const RUN_THERE = "or run the program on the robot with rosrun";
const gap = (one, other) => `Something is missing between “${one}” and “${other}”: perhaps a comma, +, or quotation `
  + "marks.";

// A program, what is said of it, and the line that is marked (1)
const SYNTAX = [
  ["x = 1\nif x == 1\n    print(x)", "A colon is missing: a line with “if” ends with :", 2],
  ["if f(lambda: 1)\n    pass", "A colon is missing: a line with “if” ends with :"],
  ["x = 1\ntry:\n    x = 2\n", "“try” needs “except” below its lines.", 3],
  ["if True:\n    pass\nelse\n    pass", "A colon is missing: a line with “else” ends with :", 3],
  ["if True:\nprint(1)", "This line belongs to “if” above it: put 4 more spaces in front.", 2],
  ["if True:\n    print(1)\nwhile True:\n", "“while” needs a line below it, with 4 more spaces in front.", 3],
  ["def f():\n    # nothing yet\n", "“def” needs a line below it, with 4 more spaces in front."],
  ["x = 1\n  y = 2", "This line is indented too far: align it with the line above.", 2],
  ["  x = 1", "This line is indented too far: align it with the line above."],
  ["if True:\n    x = 1\n  y = 2", NO_COLUMN, 3],
  ["if True:\n\tx = 1\n        y = 2", "This line begins with tabs and spaces mixed: use spaces alone.", 3],
  ["print(1\nprint(2)", "The bracket “(” is never closed."],
  ["x = 1\ny = [1, (2, 3)\nz = 3", "The bracket “[” is never closed.", 2],
  ["print(1))", "“)” closes no bracket: delete it, or open one before."],
  ["x = (1,\n     2]", "“]” closes the bracket “(”: use ).", 2],
  ["x = 1\nprint('hello)", "The text that begins here is not closed on its line: put ' at its end.", 2],
  ["x = \"\"\"hello\nprint(x)", "The text that begins here is never closed: put \"\"\" at its end."],
  ["x = 5\nif x = 5:\n    pass", "= gives a value to a name; == compares two values.", 2],
  ["x = [1 2]", gap("1", "2")], ["x = (1,\n     2 3)", gap("2", "3"), 2],
  ["x = 1 +", "Something is missing after “+”."],
  ["x = ", "Something is missing after “=”."], ["x = = 1", "Something is missing before “=”."],
  ["print \"hello\"", "print needs brackets: print(...)"], ["x = 1\nx++", "Python has no “++”: use += 1.", 2],
  ["if x && y:\n    pass", "Python has no “&&”: use and."], ["if !x:\n    pass", "Python has no “!”: use not."],
  ["if x => 1:\n    pass", "Python has no “=>”: use >=."], ["// drive", "A comment begins with #"],
  ["int x = 1", "Python has no “int”: delete it."], ["x = 5 $ 3", "Python has no “$”: delete it."],
  ["if x:\n    pass\nelse if y:\n    pass", "Python has no “else if”: use elif.", 3],
  ["if x:\n    pass\nelse y:\n    pass", "“else” has no condition: delete it, or use elif.", 3],
  ["else:\n    pass", "“else” has no “if” above it in the same column."],
  ["if x:\n    if y:\n        pass\n  else:\n    pass", NO_COLUMN, 4],
  ["try:\n    x = 1\nprint(x)", "“try” needs “except” below its lines.", 3],
  ["If x == 1:\n    pass", "“If” is not known here. Do you mean if?"],
  ["whlie True:\n    pass", "“whlie” is not known here. Do you mean while?"],
  ["elseif x:\n    pass", "“elseif” is not known here. Do you mean elif?"],
  ["for i range(3):\n    pass", "“for” needs “in”: for i in range(10):"],
  ["class = 3", "“class” is a word of Python: choose another name."],
  ["def f:\n    pass", "A function needs brackets after its name: def f():"],
  ["2x = 1", "“2x” is neither a number nor a name: a name begins with a letter."],
  ["x = “a”", "Python has no ““”: use \"."],
  ["if True:\n\u3000\u3000x = 1", "Here is a space of a kind that Python does not know: type it again.", 2],
  ["x = 007", "Python cannot read this number."],
  ["x = 5 if True", "“if” inside a line needs “else”: x = 1 if a else 2"],
  ["x = [i for i in a] if b", "“if” inside a line needs “else”: x = 1 if a else 2"],
  ["from math sin", "“from” needs “import”: from math import sin"], ["print(f'{x')", FORMAT], ["print(f'{}')", FORMAT],
  ["print(1)\nx == 1:\n    pass", "A line that ends with : begins with a word such as if, while or def.", 2],
  ["f(x.y = 1)", "= gives a value to a name; == compares two values."], ["x = 2 not y", gap("2", "not")],
  ["print(1) return", gap(")", "return")], ["x.", "Something is missing after “.”."],
  ["x = {'a': }", "Something is missing after “:”."], ["f(1,, 2)", "Something is missing before “,”."],
  ["match x:\n    case 1:\n        pass", "The page's Python has no “match”: use if and elif."],
];

const COMPILED = [
  ["yield 1", "“yield” belongs in a function: this line is in none."],
  ["x = 1\nreturn x", "“return” ends a function: this line is in none.", 2],
  ["if True:\n    break", "“break” and “continue” belong in a loop: this line is in none.", 2],
  ["f() = 1", "Only a name can get a value: put one on the left of =."],
  ["def f(a, a): pass", "Two parameters have the same name."],
  ["def f(a=1, b):\n    pass", "A parameter without a value cannot follow one with a value."],
  ["print(sep='', 1)", "A value without a name cannot follow one with a name."],
  ["x = {1: 2, 3}", "Each item of a dictionary is a key, a colon, and a value."],
  ["def f():\n    x = 1\n    global x", "“global” comes first in a function, before the name is used.", 3],
  ["import", UNKNOWN_LINE],
  ["x = 1\nprint(f'{x = }')", FORMAT_LESS, 2],
];

const NAMES = [
  ["pritn(1)", "“pritn” is not known here. Do you mean print?"],
  ["Print(1)", "“Print” is not known here. Do you mean print?"],
  ["x = true", "“true” is not known here. Do you mean True?"],
  ["speed = 1\nprint(spede)", "“spede” is not known here. Do you mean speed?", 2],
  ["def turn_left():\n    pass\nturnleft()", "“turnleft” is not known here. Do you mean turn_left?", 3],
  ["for count in range(3):\n    print(Count)", "“Count” is not known here. Do you mean count?", 2],
  ["print(hello)", `“hello” is not known here. ${GIVE}`],
  ["import math, random\nprint(Random)", "“Random” is not known here. Do you mean random?", 2],
  ["x1 = 1\nprint(x2)", `“x2” is not known here. ${GIVE}`, 2],
  ["speed = 1\nprint(spots)", `“spots” is not known here. ${GIVE}`, 2],
  ["class A:\n    pass\na = A()\na.speed = 1\nprint(speed)", `“speed” is not known here. ${GIVE}`, 5],
  ["x = {}\nx[int(speed)] = 1", `“speed” is not known here. ${GIVE}`, 2],
  ["motion = Twist()", "“Twist” is not imported: write from geometry_msgs.msg import Twist at the top."],
  ["x = math.sin(1)", "“math” is not imported: write import math at the top."],
  ["x = np.zeros(3)", "“np” is not in the page: use lists and the module math."],
  ["print(x)\nx = 1", "“x” has no value here: it gets one only further down, or inside a function."],
  ["def f():\n    x = 1\nf()\nprint(x)",
    "“x” has no value here: it gets one only further down, or inside a function.", 4],
  ["class A:\n    def f(it):\n        self.x = 1\nA().f()", SELF, 3],
  ["n = 0\ndef f():\n    n += 1\nf()",
    "“n” has no value in this function. To use the one outside, begin the function with: global n", 3],
  ["def f():\n    print(n)\n    n = 1\nf()", "This line uses a name before the function gives it a value.", 2],
  ["def g(n):\n    pass\ndef f():\n    n += 1\nf()",
    "This line uses a name before the function gives it a value.", 4],
  ["import maths", "There is no module “maths”. Do you mean math?"],
  ["from math import squareroot", "“math” has no “squareroot”."],
  ["from math import Sqrt", "“math” has no “Sqrt”. Do you mean sqrt?"],
  ["import math\nmath.sine(1)", "“math” has no “sine”. Do you mean sin?", 2],
  ["x = []\nx.apend(1)", "“list” has no “apend”. Do you mean append?", 2],
  ["class Twist:\n    linear = 0\nprint(Twist().Linear)", "“Twist” has no “Linear”. Do you mean linear?", 3],
  ["class Robot:\n    def go(self):\n        pass\nx = []\nx.go()", "“list” has no “go”.", 5],
  ["linear = 0.5\nlinear.x = 1", "“number” has no “x”. Write motion.linear.x = 0.1, not motion.linear = 0.1", 2],
  ["x = [1].length", "len(x) gives the length of x."],
  ["def f():\n    pass\nf().x", `What is before “.x” is None. ${NO_RESULT}`, 3], ["print.x", CALL],
];

const TYPES = [
  ["x = 1\nprint('x: ' + x)", `This does not work: text + number. ${CONVERT}`, 2],
  ["x = 1.5 * 'a'", `This does not work: number * text. ${CONVERT}`],
  ["if '5' > 3:\n    pass", `This does not work: text > number. ${CONVERT}`],
  ["x = 0,5\ny = x * 0.5", "This does not work: tuple * number. A decimal number has a point, and no comma: 0.5", 2],
  ["def f():\n    return 1\nx = f + 1", `This does not work: function + number. ${CALL}`, 3],
  ["def f():\n    pass\nx = f() + 1", `This does not work: None + number. ${NO_RESULT}`, 3],
  ["import math\nmath.sin('1')", `Here a number is needed, not text. ${CONVERT}`, 2],
  ["x = range(1.5)", "Here a whole number is needed. int(x) makes a whole number of x."],
  ["x = 2(3 + 4)", "What comes before “(” is not a function, but: number. To multiply, write *"],
  ["x = [1, 2]\nx(0)",
    "What comes before “(” is not a function, but: list. An item is taken with square brackets: x[0]", 2],
  ["def f(a, b):\n    pass\nf(1)", "f() takes 2 values but gets 1.", 3],
  ["def f(a):\n    pass\nf(1, 2)", "f() takes 1 value but gets 2.", 3],
  ["class A:\n    def go():\n        pass\nA().go()", SELF, 4],
  ["class A:\n    def __init__(self, x):\n        pass\nA()", "The function takes 1 value but gets 0.", 4],
  ["sorted([1], down=True)", "The function has no parameter of this name."],
  ["x = int('1', 10, 1)", "The function takes fewer values between its brackets."],
  ["x = 'abc'.find(1)", "Here a text is needed: put quotation marks around it."],
  ["x = 1 in 5", "This does not work: number in number."], ["import time\ntime()", NO_FUNCTION, 2],
  ["len()", "The function takes 1 value but gets 0."],
  ["range()", "The function needs more values between its brackets."],
  ["def f(a):\n    pass\nf(b=1)", "The function has no parameter “b”.", 3],
  ["def f(a):\n    pass\nf(1, a=1)", "“a” gets two values in this call.", 3],
  ["for i in 10:\n    pass",
    "Here a list, a text or a range is needed, not: number. range(10) gives 10 numbers."],
  ["len(5)", "This has no length: number."], ["x = 5[0]", "This has no items to take with [ ]: number."],
  ["x = [1]['a']", "The position of an item is a whole number (0, 1, 2 ...), not: text."],
  ["x = 'abc'\nx[0] = 'b'", "The items of this cannot be changed: text. Those of a list can.", 2],
  ["x = set([[]])", "This cannot be a key of a dictionary, nor be in a set: list."],
];

const VALUES = [
  ["x = [1, 2]\nprint(x[2])", "There is no item at this position: the first is 0, the last is len(x) - 1.", 2],
  ["import sys\nx = sys.argv[5]",
    "“sys.argv” is not in the page: give the value to a name at the top of the program.", 2],
  ["[].pop()", "The list is empty."], ["max([])", "The list is empty."],
  ["x = {'a': 1}\nx['b']", "There is no key “b”.", 2],
  ["def half(x):\n    return 1 / x\nhalf(0)", "This line divides by 0.", 2],
  ["x = 5 % 0", "This line divides by 0."],
  ["x = int('1.5')", "int(...) cannot make a whole number of “1.5”."],
  ["x = float('0,5')", "float(...) cannot make a number of this text: a number looks like 0.5"],
  ["a, b = 1, 2, 3", "There are more values than the 2 names on the left of =."],
  ["a, b = [1]", "There is only 1 value for the names on the left of =."],
  ["import math\nmath.sqrt(-1)", "This function of math has no result for this number.", 2],
  ["[1].index(2)", "What you look for is not in the list or the text."],
  ["assert 1 == 2", "What “assert” says is not true."],
  ["def f():\n    f()\nf()", "A function calls itself again and again: let it end with an if.", 2],
  ["x = bytearray(2 ** 30)", "The program needs too much memory: does a list or a text grow without an end?"],
  ["raise ValueError('my own words')", "ValueError: my own words"], ["raise ValueError", "ValueError"],
];

const MISSING = [
  ["import numpy as np", "“numpy” is not in the page: use lists and the module math."],
  ["x = 1\nimport cv2",
    `“cv2” ${NO_PICTURES}`, 2],
  ["from jetbot import Robot", "“jetbot” is not in the page: publish a Twist on cmd_vel to drive the wheels."],
  ["import tf.transformations",
    "“tf” is not in the page: the heading is 2 * math.atan2(orientation.z, orientation.w)."],
  ["import matplotlib.pyplot as plt", "“matplotlib” is not in the page: print(\"name\", value) draws a curve."],
  ["import requests", "“requests” is not in the page: programs here reach their robot alone, and no network."],
  ["import qqqqqqqq", `“qqqqqqqq” is not in the page: check its name, ${RUN_THERE}.`],
];

for (const [program, text, line = 1] of SYNTAX) {
  test(`${JSON.stringify(program)} does not run: ${text}`, () => {
    assert.deepEqual(syntaxProblem(program), { text, line });
  });
}

for (const [program, text, line = 1] of [...COMPILED, ...NAMES, ...TYPES, ...VALUES, ...MISSING]) {
  test(`${JSON.stringify(program)}: ${text}`, () => {
    assert.deepEqual(syntaxProblem(program), null);
    assert.deepEqual(explain(failureOf(program), program), { text, line });
  });
}

const TWIST = "import rospy\nfrom geometry_msgs.msg import Twist, Vector3\n";
const NODE = `${TWIST}rospy.init_node("node")\n`;
const LINEAR = "The message takes all of these values, or none: linear, angular.";
const PUBLISHER = `${NODE}publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)\nmotion = Twist()\n`;

// Programs that use the page's own modules
const NODES = [
  ["x = input()", "“input” is not in the page: give the value to a name at the top of the program.", 1],
  ["open('a.txt')", "“open” is not in the page: programs here have no files; print what you want to keep.", 1],
  ["import os", "“os” is not in the page: programs here start no other programs.", 1],
  ["import rospy\nrospy.Service('a', None, None)",
    "“rospy.Service” is not in the page: the page has topics, but no services and no actions.", 2],
  ["from sensor_msgs.msg import Image", `“sensor_msgs.msg.Image” ${NO_PICTURES}`, 1],
  ["from std_msgs.msg import Flaot32", "“std_msgs.msg” has no “Flaot32”. Do you mean Float32?", 1],
  ["import rospy\nrospy.Publsher", "“rospy” has no “Publsher”. Do you mean Publisher?", 2],
  ["import random\nrandom.randit(1, 2)", "“random” has no “randit”. Do you mean randint?", 2],
  [`${TWIST}Vector3().X`, "“Vector3” has no “X”. Do you mean x?", 3],
  [`${TWIST}motion = Twist\nmotion.linear.x = 1`, "“Twist” has no “linear”. Do you mean Twist()?", 4],
  [`${TWIST}Twist(liner=1)`, "“Twist” has no “liner”. Do you mean linear?", 3],
  [`${TWIST}Vector3(1, 2)`, "The message takes all of these values, or none: x, y, z.", 3],
  ["import rospy\nrospy.sleep(1)", "“rospy.init_node” comes first: rospy.init_node(\"my_program\")", 2],
  [`${TWIST}rospy.Publisher("cmd_vel", Twist, queue_size=1).publish(Twist())`,
    "“rospy.init_node” comes first: rospy.init_node(\"my_program\")", 3],
  [`${PUBLISHER}motion.linear.x = "1"\npublisher.publish(motion)`, "“linear.x” of the message needs a number.", 7],
  [`${PUBLISHER}motion.linear = 1.0\npublisher.publish(motion)`,
    "“number” has no “x”. Write motion.linear.x = 0.1, not motion.linear = 0.1", 7],
  [`${PUBLISHER}from std_msgs.msg import Float32\npublisher.publish(Float32(1))`,
    "The message needs geometry_msgs/Vector3, not std_msgs/Float32.", 7],
  [`${PUBLISHER}motion.linear.x = 0,5\npublisher.publish(motion)`,
    "“linear.x” of the message needs a number. A decimal number has a point, and no comma: 0.5", 6],
  [`${PUBLISHER}publisher.publish(0.5)`, `${LINEAR} First make a message: motion = Twist(), then motion.linear.x = 0.5`,
    6],
  [`${PUBLISHER}publisher.publish(Twist)`, `${LINEAR} Do you mean Twist()?`, 6],
  [`${PUBLISHER}def cb():\n    pass\nrospy.Subscriber("cmd_vel", Twist, cb)\npublisher.publish(motion)\nrospy.sleep(2)`,
    "A callback gets one value, such as a message: def cb(message):", 6],
  [`${NODE}class A:\n    def cb(self):\n        pass\nrospy.Timer(rospy.Duration(1), A().cb)\nrospy.sleep(2)`,
    "A callback gets one value, such as a message: def cb(self, message):", 5],
  [`${NODE}rospy.Publisher("/jetbot_02/cmd_vel", Twist, queue_size=1)`,
    "Nothing in the page hears the topic /jetbot_02/cmd_vel. To drive, the topic is cmd_vel.", 4],
  [`${NODE}p = rospy.Publisher("cmd_val", Twist)\nrospy.sleep(2)\np.get_num_connections()`,
    "Nothing in the page hears the topic /cmd_val. To drive, the topic is cmd_vel.", 6],
  ["import collections\ncollections.Counter('a')",
    "“collections.Counter” is not in the page: count in a dictionary: counts[x] = counts.get(x, 0) + 1.", 2],
  ["from itertools import product", "“itertools.product” is not in the page: put a loop into a loop.", 1],
  ["import re\nre.match('(a)', 'a').groups()", "“match.groups” is not in the page: use group(1).", 2],
  ["import enum", "“enum” is not in the page: write a class with numbers and texts.", 1],
  ["import rospkg", "“rospkg” is not in the page: programs here have no files; print what you want to keep.", 1],
  [`${NODE}rospy.Publisher("cmd_vel")`, "The function takes 3 values but gets 2.", 4],
  [`${NODE}rospy.Publisher("cmd_vel", Vector3)`,
    "The topic cmd_vel takes geometry_msgs/Twist, not geometry_msgs/Vector3.", 4],
  [`${NODE}rospy.Subscriber("scan", Twist, print)\nrospy.sleep(5)`,
    "Nothing in the page publishes the topic /scan.", 5],
];

for (const [program, text, line] of NODES) {
  test(`${JSON.stringify(program)}: ${text}`, async () => {
    assert.deepEqual(explain(await failureInPage(program), program), { text, line });
  });
}

test("what nobody has translated is said as MicroPython says it", () => {
  const failure = { type: "ValueError", message: "in its own words", line: 1 };
  assert.deepEqual(explain(failure, "x = 1"), { text: "ValueError: in its own words", line: 1 });
});

// Each a file of its own: what no file of ours has, nor the random texts of tests/unit/test_python_styles.py
const RIGHT = [
  "", "\n\n", "# no statement\n", "if x:\n    pass\n# left\n    y = 1\n", "from . import (x,)\nfrom ...a import *\n",
  "x = f'{{{x}}} {y:{w}} {{}}' + F'' + rf'{z!r:>3}' + f\"{ {'a': 1}['a'] }\" + rb'a\\''\n",
  "x = 1or 2if 3else 4\n",
  "x = f(lambda a=1, *b: a, *c, **{1: 'a' 'b', **{}})\n",
  "async def f(a, /, b: int = 3, *, c='') -> None:\n    await g()\n",
  "x = 1.e3 + .5 + 0xff + 1_000 + 3j; y, = a[1:, ...],\n", "match = case = type = 1\nprint(match)\n",
  "if True:\n\tx = 1\n\n\tif x:\n\t    y = 2\nz = 3\n", "constructor = toString = 1\nconstructor(toString)\n",
];
test("nothing is wrong with what is rare, but right", () => {
  for (const program of RIGHT) assert.equal(syntaxProblem(program), null, program);
});

test("nothing is wrong with our own tests in Python", () => {
  const folder = new URL("../unit/", import.meta.url);
  for (const name of readdirSync(folder).filter((each) => each.endsWith(".py"))) {
    assert.equal(syntaxProblem(readFileSync(new URL(name, folder), "utf8")), null, name);
  }
});

const LONG = [
  "print(1)\n".repeat(1e4), `x = '''${"a".repeat(1e5)}'''\n`, `x = ${"1 + ".repeat(2e4)}1\n`,
  "(".repeat(1e5), "'".repeat(1e5), `${"1_".repeat(5e4)}x`, // these are wrong
];
test("a program that is long is read at once", () => {
  const begun = performance.now();
  assert.deepEqual(LONG.map((program) => syntaxProblem(program)?.line), [...Array(3), 1, 1, 1]);
  assert.ok(performance.now() - begun < 30000); // not for minutes
});
