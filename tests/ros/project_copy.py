"""A fresh copy of the project, and an environment that knows no workspace, as in a new terminal."""

import os
import shutil
import subprocess
from pathlib import Path
from typing import Dict, Tuple

ROOT = Path(__file__).parents[2]
NOT_COPIED = ("build", "devel", "install", ".git", "node_modules", "tests", "teleop_twist_keyboard", "my_scenario")
WORKSPACE = ("ROS", "CMAKE", "PYTHON", "PKG_CONFIG", "LD_LIBRARY", "JETBOT")  # variables that a sourced one sets


def copy_project(home: Path, *without: str) -> Path:
    """Return the folder of a copy in this home, without the packages of these names."""
    project = home / "MorBot"
    shutil.copytree(ROOT, project, symlinks=True, ignore=shutil.ignore_patterns(*NOT_COPIED, *without))
    return project


def copy_built_project(home: Path) -> Path:
    """Return the folder of a copy in this home, built if this project is; its build knows the copy's paths."""
    project = copy_project(home)
    workspace = project / "morbot_ws"
    if not (ROOT / "morbot_ws/devel/morbot.stamp").exists():
        return project
    for name in "build", "devel":
        ignored = shutil.ignore_patterns("lint", "*.pyc", "test_results", "bench_results*", ".*_cache")
        shutil.copytree(ROOT / "morbot_ws" / name, workspace / name, symlinks=True, ignore=ignored)
        for file in filter(Path.is_file, (workspace / name).rglob("*")):
            content, times = file.read_bytes(), file.stat()
            if bytes(ROOT) in content:
                file.write_bytes(content.replace(bytes(ROOT), bytes(project)))
                os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))  # else make would work
    stamp = '. "$0/setup/workspace.sh"; workspace=$0/morbot_ws; files >"$workspace/devel/morbot.stamp"'
    subprocess.run(["sh", "-c", stamp, project], check=True)
    return project


def clean_environment(home: Path) -> Dict[str, str]:
    """Return this process's variables, without those of a workspace, for a user with this home."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith(WORKSPACE)}
    return {**clean, "HOME": str(home)}


def morbot(project: Path, *arguments: str) -> Tuple[int, str]:
    """Run a copy's ./morbot as in a new terminal, and return its exit code and all that it printed."""
    return finish([project / "morbot", *arguments], clean_environment(project.parent))


def finish(command: list, environment: Dict[str, str]) -> Tuple[int, str]:
    """Run a command to its end, and return its exit code and all that it printed."""
    process = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             encoding="utf-8")
    return process.returncode, process.stdout
