// What pupils' Python may do on the page: it reaches nothing but its robot, and what it keeps and sends is bounded.

/* eslint max-len: 0 -- a program is a line of its table */

import assert from "node:assert/strict";
import { test } from "node:test";

import { runText } from "./page_worker.js";

// Each tries to reach what is not a program's, and must fail.
const MODULES = `import sys
modules = sys.modules
get = modules["_start"]._import
`;
const FORBIDDEN = ["js.postMessage({})", "js.globalThis", "jsffi.JsProxy", "jsffi.to_js({})", "uctypes.addressof(bytearray(1))",
  "uctypes.bytearray_at(0, 4)", "os.listdir('/')", "os.remove('/lib/_run.py')", "vfs.mount",
  "_javascript.show.constructor"];
const moduleOf = (use) => use.split(".")[0];
const ESCAPES = {
  ...Object.fromEntries(FORBIDDEN.map((use) => [`import ${use}`, `import ${moduleOf(use)}\n${use}`])),
  ...Object.fromEntries(FORBIDDEN.map((use) => [`hidden ${use}`, `${MODULES}${moduleOf(use)} = get("${moduleOf(use)}")\n${use}`])),
  ...Object.fromEntries(["_page", "micropython", "builtins"].map((name) => [name, `import ${name}`])),
  "another __name__": "__name__ = 'x'\nimport js\njs.postMessage({})",
  "__import__ with no names": "__import__('js', {}).postMessage({})",
  "exec with other names": "exec('import js; js.postMessage({})', {})",
  "eval with other names": "eval('__import__(\"js\").globalThis', {})",
  "compile": "exec(compile('import uctypes; uctypes.bytearray_at(0, 4)', 'x', 'exec'), {'__name__': '_run'})",
  "the hidden import, tarfile's uctypes": `${MODULES}get("tarfile").uctypes.addressof`,
  "the hidden import, another module": `${MODULES}get("io").open("/lib/evil.py", "w")`,
  "the hidden import, __main__": `${MODULES}get("__main__").suspended`,
  "a page function's constructor": `${MODULES}modules["_page"].show.constructor("postMessage({})")()`,
  "a page function's attributes": `${MODULES}modules["_page"].show.x = 1`,
  "a page function's call": `${MODULES}modules["_page"].show.call(None, "x")`,
  "a page function's prototype": `${MODULES}modules["_page"].at.__class__(0)\nmodules["_page"].at.__proto__`,
  "a page function's keywords": `${MODULES}modules["_page"].show(text="x")`,
  "new of a page function": `${MODULES}modules["_page"].show.new()`,
  "items of a page function": `${MODULES}modules["_page"].show["constructor"]`,
  "a function for a text": `${MODULES}modules["_page"].show(lambda *_: "x")`,
  "an object for a text": `${MODULES}\nclass A:\n    def slice(self, *_): return self\nmodules["_page"].show(A())`,
  "a text for a number": `${MODULES}modules["_page"].turn("1e9")`,
  "another command": `${MODULES}modules["_page"].drive({"robot": "/other"}, 1)`,
  "traceback's frames": "try:\n    1/0\nexcept Exception as e:\n    e.__traceback__.tb_frame.f_globals",
  "a function's globals": "import rospy\nrospy.Publisher.publish.__globals__['drive'].constructor",
  "a method's globals": "import rospy\nrospy.Rate.__init__.__globals__['_clock'].tasks.js",
  "a class's subclasses": "object.__subclasses__()",
  "a function's code": "f = lambda: 0\nf.__code__ = None",
  "builtins of the program": "__builtins__['open']",
  "a file": "open('/lib/_run.py')",
  "a file of io": "import io\nio.open('/lib/_run.py', 'a').write('x')",
  "a device": "import io\nio.open('/dev/tty', 'w').write('x')",
  "standard input": "import sys\nif sys.stdin.read(1): print('REACHED')",
  "input()": "input()",
};
test("nothing that a program tries reaches anything but its robot", async () => {
  for (let left = Object.entries(ESCAPES); left.length;) {
    const tries = left.map(([name, text]) => `
print(${JSON.stringify(name)})
try:
    exec(${JSON.stringify(text)}, dict(globals()))
    print("REACHED")
except BaseException: pass`);
    const { prints } = await runText(tries.join(""), { slow: true });
    assert.deepEqual(prints, left.slice(0, prints.length).map(([name]) => name));
    assert.ok(prints.length > 0);
    left = left.slice(prints.length); // a try may end the program
  }
});

test("the thread of a program has nothing with which it could reach beyond itself", async () => {
  assert.deepEqual((await runText("print(1)")).reach, []);
});

test("a worker that speaks unasked is ended, and its program with it", async () => {
  let ended = false;
  const { Worker } = globalThis;
  globalThis.Worker = class {
    postMessage({ wasm }) {
      for (const print of wasm ? ["ready"] : ["asked", "unasked"]) this.onmessage({ data: { events: [{ print }] } });
    }

    terminate() {
      ended = true;
    }
  };
  const { prints, error } = await runText("print(1)", { enough: ({ answers }) => answers > 5 });
  globalThis.Worker = Worker;
  assert.deepEqual([prints, error, ended], [["asked"], "Python stopped unexpectedly. Run the program again.", true]);
});

const TOO_MUCH_MEMORY = "The program needs too much memory: does a list or a text grow without an end?";
const TOO_DEEP = "A function calls itself again and again: let it end with an if.";
const FAILURES = {
  "a text that grows": ["x = 'a'\nwhile True: x += x", TOO_MUCH_MEMORY],
  "a function that calls itself": ["def f(): return f()\nf()", TOO_DEEP],
  "a message without an end": ["raise Exception('x' * 1000000)", /^Exception: x{100,10000}$/],
  "a message that fails": ["class E(Exception):\n    def __str__(self): raise ValueError\nraise E", "E"],
  "a print that fails": ["class A:\n    def __str__(self): raise ValueError('why')\nprint(A())", "ValueError: why"],
};
for (const [name, [text, expected]] of Object.entries(FAILURES)) {
  test(`${name} says so`, async () => {
    const { error } = await runText(text);
    if (expected instanceof RegExp) assert.match(error, expected);
    else assert.equal(error, expected);
  });
}

const FLOODS = {
  "prints": "while True: print('hello')",
  "prints of a million characters": "x = 'a' * 1000000\nwhile True: print(x)",
  "prints of a line that has no end": "while True: print('a' * 999, end='')",
  "curves of thousands of names": "i = 0\nwhile True:\n    i += 1\n    print('name' * 9999 + str(i), i)",
  "writes of a line that has no end": "import sys\nwhile True: sys.stdout.write('a' * 999)",
  "tracebacks": "import sys\nwhile True: sys.print_exception(ValueError('x' * 1000))",
  "commands": "from rospy.topics import drive\nwhile True: drive(0.1, 0)",
  "nothing": "while True: pass",
  "nothing, whatever is raised": "while True:\n    try:\n        while True: pass\n    except BaseException: pass",
  "nothing, in a key": "def f(x):\n    while True: pass\nsorted([1, 2], key=f)",
  "nothing, when it ends": "import rospy\nrospy.init_node('a')\ndef f():\n    while True: pass\nrospy.on_shutdown(f)",
};
for (const [name, text] of Object.entries(FLOODS)) {
  test(`of a flood of ${name}, the page gets a little at a time, again and again`, async () => {
    const { answers, count, longest, error } = await runText(text, { enough: (found) => found.answers > 5 });
    assert.equal(error, "");
    assert.ok(answers > 5);
    assert.ok(count <= 55 * answers, `${count} events in ${answers} turns`);
    assert.ok(longest <= 10000, `${longest} characters`);
  });
}

const SEEN = [ // lines, and the variables that they have made
  ["kinds = [(1,), {'k': [1.5]}, set(), {True}, '', ('x', None)]", { kinds: "[(1,), {'k': [1.5]}, set(), {True}, '', ('x', None)]" }],
  ["a = []; a.append(a); b = {}; b['['] = b", { a: /^\[{7}\.\.\.\]{7}$/, b: /^\{'\[': \{/ }],
  ["million = [7] * 1000000; long = 'x' * 1000000", { million: /^\[7, 7, .*/, long: /^'x{99}/ }],
  ["many = 3 ** 50000; few = 3 ** 50; less = -many", { many: "...", few: String(3n ** 50n), less: "..." }],
  ["deep = [[[0] * 100] * 100] * 100", { deep: /^\[\[\[0, 0, / }],
  ["class A:\n    def __repr__(self):\n        while True: pass\n    __str__ = __repr__\nendless = [A()]", { endless: "[...]" }],
  ["class B(int):\n    def __repr__(self): raise SystemExit\nfails = {1: B(3)}; number = B(4)", { fails: "{1: ...}", number: undefined }],
  ["import time\nclass C:\n    def __repr__(self):\n        time.sleep(1)\nwaits = (C(), 1)", { waits: "(..., 1)" }],
  ["class D:\n    ends = True\n    def __hash__(self):\n        while not D.ends: pass\n        return 1\n"
    + "    __eq__ = lambda self, _: self.__hash__()\nkey = {D(): 1}\nD.ends = False", { key: "{...: 1}" }],
  ["globals()[5] = globals()[''] = globals()[None] = 1; last = 2", { last: "2" }],
];
test("values of all kinds are shown as variables, without a call of the program's", async () => {
  const lines = SEEN.map(([text]) => text).join("\n");
  const { prints, error, variables } = await runText(`${lines}\ntime.sleep(1)\nprint('after')`);
  assert.deepEqual([prints, error], [["after"], ""]);
  for (const [name, value] of SEEN.flatMap(([, expected]) => Object.entries(expected))) {
    if (value instanceof RegExp) assert.match(variables.get(name), value);
    else assert.equal(variables.get(name), value, name);
    assert.ok((variables.get(name) ?? "").length <= 100);
  }
});

const FUNCTIONS = { // what is seen while time.sleep(1) runs
  "parameters, and what got a value": ["def f(x, y=a, *z):\n    b = c = 2; d, e = 3, 4\n    time.sleep(1)\nf(5)",
    { a: "1", x: "5", y: "1", z: "()", b: "2", c: "2", d: "3", e: "4" }],
  "a loop's variable, and the last value": ["def f():\n    n = 0\n    for i in [7]:\n        n = i + 1\n        time.sleep(1)\nf()",
    { a: "1", n: "8", i: "7" }],
  "nothing that may have no value": ["def f(x):\n    if x: b = 1\n    else: c = 2\n    for i in []: pass\n    time.sleep(1)\nf(0)", { a: "1", x: "0" }],
  "nothing that has none any more": ["def f(x, y):\n    del x\n    try: 1 / 0\n    except Exception as y: pass\n    z = 1\n    time.sleep(1)\nf(1, 2)",
    { a: "1", z: "1" }],
  "its own before the program's": ["def f(a, _b, line, _line):\n    time.sleep(1)\nf(2, 3, 4, 5)", { a: "2", line: "4" }],
  "nothing of a function that has ended": ["def f(x):\n    y = x\nf(1)\ntime.sleep(1)", { a: "1" }],
  "nothing of another one": ["def g(x):\n    time.sleep(1)\ndef f(y):\n    g(2)\nf(1)", { a: "1", x: "2" }],
  "nothing of a method's object": ["class A:\n    b = 2\n    def f(self, x):\n        time.sleep(1)\nA().f(3)", { a: "1", x: "3" }],
};
test("of a function, the page shows the variables that have a value where it waits", async () => {
  const lines = Object.values(FUNCTIONS).map(([text]) => text).join("\n");
  const { seen, error } = await runText(`import time\na = 1\n${lines}`, { slow: true });
  assert.equal(error, "");
  for (const [index, [name, [, expected]]] of Object.entries(FUNCTIONS).entries()) assert.deepEqual(seen[index], expected, name);
});

// While MicroPython's own code holds what nothing else does, a step finds much garbage; then memory is used again.
const GARBAGE = `
MUCH, ROUNDS = 100000, 5
def step():
    x = [[0, 1, 2, 3], [4, 5, 6, 7], {}]
    return 1
class A:
    def __init__(self, n, *more):
        self.n = n
        self.more = [more]
def f(much):
    for n in range(9):
        step()
        yield str(n)
`;
const HELD = { // expressions, and their values
  "what an object is made with": ["[(a.n, a.more) for a in [A(7, 1, len([0] * MUCH)) for _ in range(9)]]", "[(7, [(1, MUCH)])] * 9"],
  "what is sorted": ["sorted([3, 2, len([0] * MUCH), 1], key=lambda n: n * step())", "[1, 2, 3, MUCH]"],
  "a list": ["list(f(len([0] * MUCH)))", "'0 1 2 3 4 5 6 7 8'.split()"],
  "a dictionary": ["dict(enumerate(f(len([0] * MUCH))))", "{n: str(n) for n in range(9)}"],
  "the parts of a text": ["' '.join(f(len([0] * MUCH)))", "'0 1 2 3 4 5 6 7 8'"],
};
test("what MicroPython's own code holds survives the garbage of a step", async () => {
  const lines = Object.values(HELD).map(([made, value]) => `print([n for n in range(ROUNDS) if ${made} != ${value}])`);
  const { prints, error } = await runText(`${GARBAGE}${lines.join("\n")}`, { slow: true });
  assert.equal(error, "");
  Object.keys(HELD).forEach((name, index) => assert.equal(prints[index], "[]", name));
});

test("of many variables, a hundred are shown", async () => {
  const { variables, error } = await runText("globals().update({'v%d' % i: i for i in range(500)})");
  assert.deepEqual([variables.size, error], [100, ""]);
});

test("a program waits at any depth that Python has, and has its variables again when it is back", async () => {
  const text = "import time\nx = 1\ndef f(n, wait):\n    if n: f(n - 1, wait)\n    elif wait: time.sleep(0.1)\n";
  const deepest = "try:\n    for depth in range(1000): f(depth, False)\nexcept RuntimeError: pass\nf(depth - 20, True)\nx = 2\n";
  const { variables, error } = await runText(text + deepest, { slow: false });
  assert.deepEqual([variables.get("x"), error], ["2", ""]);
  assert.ok(Number(variables.get("depth")) > 50);
});

test("a program may catch an error after each wait, as often as it wants", async () => {
  const text = "import time\ndef f(n):\n    if n: f(n - 1)\n    time.sleep(0.1)\n    raise ValueError\n";
  const { prints, error } = await runText(`${text}for i in range(200):\n    try: f(5)\n    except ValueError: pass\nprint(i)`);
  assert.deepEqual([prints, error], [["199"], ""]);
});

const ODD = { // lines, and what they print
  "import from __future__": ["'''x'''\nfrom __future__ import division\nprint(1 / 2)", "0.5"],
  "a line separator in a text and in a comment": ["print(len('a\u2028b')) # \u2028print(1)", "3"],
  "a null character in a text": ["print('a\0b')", "a"],
  "half a character": ["print('\ud800' == '\\ud800')", "True"],
  "20,000 summands": [`print(${"1 + ".repeat(20000)}1)`, "20001"],
  "a thousand brackets": [`print(${"(".repeat(1000)}1${")".repeat(1000)})`, "1"],
  "a hundred levels": [Array.from({ length: 99 }, (_, depth) => `${" ".repeat(depth)}if 1:\n`).join("") + `${" ".repeat(99)}print(1)`, "1"],
  "a walrus": ["while (x := 1) and (y := 2): break\nprint(x + y)", "3"],
  "a decorator": ["def twice(f): return lambda: 2 * f()\n@twice\ndef g(): return 2\nprint(g())", "4"],
  "brackets in texts and comments": ["if ')' and (1 # ) or (\n  ): print(')') # )", ")"],
  "several values in a head": ["for x in 1, 2: pass\nfor x, in [(3,)]: pass\nprint(x)", "3"],
  "marks of its own": ["#@ _at(9)\nx = 1 #@\nprint(x)", "1"],
  "texts of several lines in a head": ["if '''a\n)b''': print(1)", "1"],
  "a long wait, and a long number for a curve": ["import time\ntime.sleep(10 ** 12)\nprint('n', 10 ** 12)", "n 1000000000000"],
};
test("odd programs do what they do in a terminal", async () => {
  const { prints, error, curves } = await runText(Object.values(ODD).map(([text]) => text).join("\n"));
  assert.equal(error, "");
  Object.entries(ODD).forEach(([name, [, expected]], index) => assert.equal(prints[index], expected, name));
  assert.deepEqual(curves, [["n", 1e12]]);
});

for (const text of ["if 1) or (print('REACHED'): pass", "for x in [1])), print('REACHED'), ((3: pass", "print('REACHED') \\", "x = (",
  "while 1) or (1:\n    print('REACHED')", "print('REACHED'", "\0print('REACHED')"]) {
  test(`${JSON.stringify(text)} is not run`, async () => {
    const { prints, error } = await runText(text);
    assert.deepEqual(prints, []);
    assert.ok(error);
  });
}

for (const [text, line] of [["while true:\n    x = 1\n    pass", 1], ["x = 0\nwhile [1][x]:\n    x += 1\n    y = x", 2],
  ["while True:\n    pass\n    x = 1 / 0", 3], ["while 1:\n    while true:\n        pass\n    x = 1", 2]]) {
  test(`of ${JSON.stringify(text)} line ${line} is marked`, async () => assert.equal((await runText(text)).line, line));
}

test("a text drives its robot by that one's absolute names, too", async () => {
  const { motions, prints, error } = await runText(`
import rospy
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
rospy.init_node("node")
publisher = rospy.Publisher("/jetbot_01/cmd_vel", Twist, queue_size=1)
rospy.wait_for_message("/jetbot_01/odom", Odometry)
publisher.publish(Twist(linear=Vector3(x=0.5)))
print(rospy.get_name(), rospy.get_namespace(), publisher.name, rospy.resolve_name("cmd_vel"))`, { robot: "/jetbot_01" });
  assert.equal(error, "");
  assert.deepEqual([motions, prints], [[[0.5, 0]], ["/jetbot_01/node /jetbot_01/ /jetbot_01/cmd_vel /jetbot_01/cmd_vel"]]);
});

test("a text that reads the keyboard is told what to use instead", async () => {
  const { error, line } = await runText("import sys\nsys.stdin.readline()");
  assert.deepEqual([error, line],
    ["“sys.stdin” is not in the page: give the value to a name at the top of the program.", 2]);
});
