"""What a pupil's Python in the page can do: drive its robot until it is stopped, and nothing else.

It takes minutes, so not all runs each time. All of it: ./morbot test FILE --long.
"""

import json
import signal
import threading
import urllib.request
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from .conftest import OTHER_ROBOT, ROBOT, some
from .programs import program
from .test_dead_man import freeze
from .test_engines import ENGINES, engine, in_all  # noqa: F401

DRIVE = """import rospy
from geometry_msgs.msg import Twist
rospy.init_node("safety")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.sleep(0.1)
command = Twist()
command.linear.x = 0.5
publisher.publish(command)
"""
BUSY = {
    "a loop": "while True: pass",
    "a loop that is not broken": "while True:\n    try:\n        while True: pass\n    except BaseException: pass",
    "a loop at last": "try:\n    1 / 0\nfinally:\n    while True: pass",
    "a long calculation": "n = 10\nn ** n ** 8",
    "a long search": "max(range(10 ** 9))",
    "a list that grows": "x = []\nwhile True: x.append(len(x))",
    "prints": "while True: print('hello')",
    "prints of a million characters": "x = 'a' * 1000000\nwhile True: print(x)",
    "curves of thousands of names": "i = 0\nwhile True:\n    i += 1\n    print('name %d' % i, i)",
    "ten thousand variables": "for i in range(10000): globals()['v%d' % i] = [i] * 100\nwhile True: pass",
    "commands": "while True: publisher.publish(command)",
    "a long wait": "import time\ntime.sleep(1e9)",
    "a callback": "def stay(_):\n    while True: pass\nrospy.Timer(rospy.Duration(0.01), stay)\nrospy.spin()",
    "a value's text": "class A:\n    def __str__(self):\n        while True: pass\nprint(A())",
    "a comparison": "class A:\n    def __eq__(self, _):\n        while True: pass\nA() in [1]",
    "a generator": "def f():\n    while True: yield 1\nfor x in f(): pass",
    "a key": "def f(x):\n    while True: pass\nsorted([2, 1], key=f)",
    "recursion": "def f(n):\n    for _ in range(2): n and f(n - 1)\nf(90)",
    "a loop without marks": "_at = _each = lambda *_: []\nwhile not _at(): pass",
    "its end": "def stay():\n    while True: pass\nrospy.on_shutdown(stay)",
}
REACT = 0.1  # s from a click to the stop that the page sends
WATCH = """document.getElementById("end").addEventListener("pointerdown", ({ timeStamp }) => {
    window.clicked = (performance.timeOrigin + timeStamp) / 1000; }, { capture: true })"""
FILE = """const files = new DataTransfer(), file = document.getElementById("file");
files.items.add(new File([arguments[0]], "program.json"));
file.files = files.files;
file.dispatchEvent(new Event("change", { bubbles: true }));"""


def show_text(page, text):
    """Show a text in the page for programs."""
    page.run(FILE, json.dumps({**program(), "python": text}))
    page.wait_for(lambda: text.splitlines()[-1].strip() in page.text("text"), "the text")


@pytest.mark.parametrize("busy", some(BUSY, "a loop that is not broken", "prints", "its end"))
def test_stop_ends_a_text_whatever_it_does_and_the_next_one_runs(blocks, world, busy):
    page = blocks({**program(), "python": DRIVE + BUSY[busy]})

    def stop():
        page.run(WATCH)
        world.run(page, ROBOT)
        with world.stops(ROBOT, what=f"Stop during {busy}"):
            page.click("#end")
        page.wait_for_text("outcome", "Stopped.")
        zero = next(each.time for each in page.sent() if each.time > page.run("return clicked") and each.is_zero)
        assert zero - page.run("return clicked") < REACT
    blocks.undisturbed(stop)
    blocks({**program(), "python": "print('again')"})
    page.click("#run")
    page.wait_for_text("prints", "again")


@pytest.mark.parametrize("busy", some(["a loop", "a long calculation", "prints", "commands", "a long wait"],
                                      "a long calculation"))
def test_pause_stops_a_text_whatever_it_does_and_step_goes_on(blocks, world, busy):
    page = blocks({**program(), "python": DRIVE + BUSY[busy]})
    world.run(page, ROBOT)
    with world.stops(ROBOT, what=f"Pause during {busy}"):
        page.click("#pause")
    page.click("#step")
    page.click("#end")
    page.wait_for_text("outcome", "Stopped.")


def test_a_text_that_computes_stops_its_robot_after_a_second_and_says_so(blocks, world):
    page = blocks({**program(), "python": DRIVE + BUSY["a long search"]})
    world.run(page, ROBOT)
    page.wait_for_text("outcome", "without a wait")
    world.wait_for_stop(ROBOT, "a second")
    page.click("#end")


@pytest.mark.parametrize("text, sentence", [
    ("import sys\nsys.modules['_page'].show(5)", "Python stopped unexpectedly. Run the program again."),
    pytest.param("x = [0] * 10 ** 9", "too much memory", marks=pytest.mark.long),
    pytest.param("def f(): f()\nf()", "calls itself", marks=pytest.mark.long),
])
def test_a_text_that_fails_stops_its_robot_says_why_and_the_next_one_runs(blocks, world, text, sentence):
    page = blocks({**program(), "python": f"{DRIVE}rospy.sleep(0.5)\n{text}"})
    world.run(page, ROBOT)
    page.wait_for_text("outcome", sentence)
    world.wait_for_stop(ROBOT, sentence)
    page.errors()  # what broke off
    blocks({**program(), "python": "print('again')"})
    page.click("#run")
    page.wait_for_text("prints", "again")


HOSTILE = """const tries = {
  fetch: () => fetch("/reached/fetch", { credentials: "include" }),
  async request() {
    const request = new XMLHttpRequest();
    request.open("GET", "/reached/request", false);
    request.send();
  },
  socket: () => new Promise((resolve, reject) => {
    Object.assign(new WebSocket(`ws://${location.host}/reached/socket`), { onopen: resolve, onerror: reject });
  }),
  events: () => new Promise((resolve, reject) => {
    Object.assign(new EventSource("/reached/events"), { onmessage: resolve, onopen: resolve, onerror: reject });
  }),
  script: () => import(`http://127.0.0.1:${location.port}/reached/script.js`),
  data: () => import("data:text/javascript,export default 1"),
  blob: () => import(URL.createObjectURL(new Blob(["export default 1"], { type: "text/javascript" }))),
  scripts: async () => importScripts("/reached/scripts.js"),
  evaluated: async () => eval("1"),
  made: async () => new Function("return 1")(),
};
const done = [];
for (const [name, act] of Object.entries(tries)) {
  const late = new Promise((_, reject) => { setTimeout(reject, 1500); });
  await Promise.race([Promise.resolve().then(act), late]).then(() => done.push(name), () => {});
}
const { instance } = await WebAssembly.instantiate(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]));
postMessage({ done, wasm: String(instance) });"""
START = """window.answer = null;
const worker = new Worker("/python/worker.js", { type: "module" });
worker.onmessage = ({ data }) => { window.answer = data; };
worker.onerror = ({ message }) => { window.answer = { done: ["no start"], message }; };"""


@pytest.fixture
def hostile(world):
    """The address of a server whose python/worker.js is JavaScript that tries to reach all it can, with our policy."""
    policy = urllib.request.urlopen(f"{world.address}python/worker.js").headers["Content-Security-Policy"]

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            reached.append(self.path)
            is_worker = self.path == "/python/worker.js"
            body = HOSTILE if is_worker else "postMessage(1)" if self.path.endswith(".js") else "<title>.</title>"
            self.send_response(200)
            self.send_header("Content-Type", "text/javascript" if self.path.endswith(".js") else "text/html")
            self.send_header("Access-Control-Allow-Origin", "*")
            if is_worker:
                self.send_header("Content-Security-Policy", policy)
            self.end_headers()
            self.wfile.write(body.encode())

        def log_message(self, *_):
            pass
    reached = []
    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://localhost:{server.server_port}/", reached
    server.shutdown()
    server.server_close()


@in_all
def test_javascript_in_a_texts_worker_reaches_nothing_either(engine, hostile):  # noqa: F811
    address, reached = hostile
    page = engine()
    page.load(address)
    page.run(START)
    page.wait_for(lambda: page.run("return window.answer"), "the worker's answer", within=60)
    answer = page.run("return window.answer")
    assert answer["done"] == [] and "Instance" in answer["wasm"], answer
    assert [path for path in reached if "reached" in path] == []
    page.leave()


@pytest.fixture
def texts(engine, world):  # noqa: F811
    """A browser with the page for programs, in which a text drives ROBOT until it is stopped."""
    page = engine()
    page.open(f"{world.address}program", ROBOT)
    page.errors()
    show_text(page, f"{DRIVE}while not rospy.is_shutdown():\n    publisher.publish(command)\n    rospy.sleep(0.1)\n")
    world.run(page, ROBOT)
    yield page
    if page.runs:
        page.leave()
    world.delete_programs()


in_chromium = pytest.mark.parametrize("engine", some(ENGINES, "chromium"), indirect=True)  # --long: in all


@in_chromium
def test_a_frozen_browser_stops_a_texts_robot_which_drives_again_only_after_run(texts, world):
    freeze(texts, world)
    world.stay_stopped(ROBOT, for_seconds=0.5)
    texts.wait_for(lambda: not texts.run("return document.getElementById('run').disabled"), "the program's end")


@in_chromium
def test_a_killed_browser_stops_a_texts_robot(texts, world):
    with world.stops(ROBOT, what="SIGKILL of the browser"):
        texts.signal(signal.SIGKILL)


ENDS = {
    "Stop": (lambda page: page.click("#end"), "Stopped."),
    "STOP": (lambda page: page.click("#stop"), ""),
    "Escape": (lambda page: page.tap("Escape"), "Stopped."),
    "a hidden page": (lambda page: (page.hide(), page.show()), "The page was hidden, so the program was stopped."),
    "another robot": (lambda page: page.choose(OTHER_ROBOT), "Another robot was chosen."),
    "a changed text": (lambda page: page.run("""document.querySelector("#text .cm-line").append("#")"""),
                       "The program was changed. Run it again."),
    "a reload": (lambda page: page.reload(), ""),
}


@in_chromium
@pytest.mark.parametrize("end", some(ENDS, "Escape", "a hidden page", "another robot", "a changed text"))
def test_a_text_ends_as_blocks_do_at(end, texts, world):
    act, sentence = ENDS[end]
    with world.stops(ROBOT, what=end):
        act(texts)
    texts.wait_for_text("outcome", texts.say(sentence) if sentence else "")
    if end == "STOP":
        texts.click("#release")
    world.stay_stopped(OTHER_ROBOT)
