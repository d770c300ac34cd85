"""What a pupil's Python in the page can do: drive its robot until it is stopped, and nothing else."""

import threading
import urllib.request
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from .conftest import ROBOT
from .programs import program

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
    "a loop that is not broken": "while True:\n    try:\n        while True: pass\n    except BaseException: pass",
    "a long calculation": "n = 10\nn ** n ** 8",
    "prints": "while True: print('hello')",
    "its end": "def stay():\n    while True: pass\nrospy.on_shutdown(stay)",
}
REACT = 0.1  # s from a click to the stop that the page sends
WATCH = """document.getElementById("end").addEventListener("pointerdown", ({ timeStamp }) => {
    window.clicked = (performance.timeOrigin + timeStamp) / 1000; }, { capture: true })"""


def test_stop_ends_a_text_whatever_it_does(blocks, world):
    for busy, text in BUSY.items():
        page = blocks({**program(), "python": DRIVE + text})

        def stop(page=page, busy=busy):
            page.run(WATCH)
            world.run(page, ROBOT)
            with world.stops(ROBOT, what=f"Stop during {busy}"):
                page.click("#end")
            page.wait_for_text("outcome", "Stopped.")
            zero = next(each.time for each in page.sent() if each.time > page.run("return clicked") and each.is_zero)
            assert zero - page.run("return clicked") < REACT, busy
        blocks.undisturbed(stop)


def test_stop_while_python_is_still_loaded_lets_the_text_never_begin(blocks, world):
    page = blocks({**program(), "python": DRIVE + BUSY["prints"]})
    page.run("for (const name of ['run', 'end']) document.getElementById(name).click()")
    world.stay_stopped(ROBOT, for_seconds=0.5)
    assert page.text("outcome") == "Stopped."


def test_a_text_that_computes_stops_its_robot_at_pause_and_else_after_a_second(blocks, world):
    page = blocks({**program(), "python": DRIVE + BUSY["a long calculation"]})
    world.run(page, ROBOT)
    with world.stops(ROBOT, what="Pause"):
        page.click("#pause")
    page.click("#step")
    page.click("#end")
    page.wait_for_text("outcome", "Stopped.")
    world.run(page, ROBOT)
    page.wait_for_text("outcome", "without a wait")
    world.wait_for_stop(ROBOT, "a second")
    page.click("#end")


def test_a_text_that_breaks_python_stops_its_robot_says_so_and_the_next_one_runs(blocks, world):
    page = blocks({**program(), "python": f"{DRIVE}rospy.sleep(0.5)\nimport sys\nsys.modules['_page'].show(5)"})
    world.run(page, ROBOT)
    page.wait_for_text("outcome", "Python stopped unexpectedly. Run the program again.")
    world.wait_for_stop(ROBOT, "the end of Python")
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


def reaches_nothing(page, address, reached):
    """Fail if the hostile worker reaches anything in this browser."""
    page.load(address)
    page.run(START)
    page.wait_for(lambda: page.run("return window.answer"), "the worker's answer", within=60)
    answer = page.run("return window.answer")
    assert answer["done"] == [] and "Instance" in answer["wasm"], answer
    assert [path for path in reached if "reached" in path] == []
    page.leave()


def test_javascript_in_a_texts_worker_reaches_nothing_either(browsers, hostile):
    reaches_nothing(browsers(1), *hostile)
