"""What the page's scripts do that needs no browser: each file of tests/js, run by Node's own test runner."""

import os
import shutil
import subprocess

import pytest

from conftest import ROOT

FILES = sorted(ROOT.glob("tests/js/*.test.js"))
OLDEST = 18


def node_version():
    """Return the major version of Node, 0 without one."""
    if not shutil.which("node"):
        return 0
    return int(subprocess.check_output(["node", "-p", "process.versions.node.split('.')[0]"]))


@pytest.mark.skipif(node_version() < OLDEST, reason=f"Node {OLDEST} or later is not installed: sudo apt install nodejs")
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_the_page(file):
    environment = {name: value for name, value in os.environ.items() if name != "NODE_OPTIONS"}
    done = subprocess.run(["node", "--test", file], cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True)
    assert done.returncode == 0, done.stdout
    assert "\n# pass 0\n" not in done.stdout, "no test ran"
