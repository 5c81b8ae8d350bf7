"""ROS 1 master, nodes of a catkin workspace, and a controller for them.

Each is a process of its own and stays on loopback. ROS itself comes from the system's packages:
opening a workspace appends their folder to this environment's.
"""

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidgen.system.cfg import write_cfg
from rapidgen.system.cfg_writer import eio_cfg, sys_cfg
from rapidgen.system.model import System

SYSTEM_PACKAGES = "/usr/lib/python3/dist-packages"
HOST = "127.0.0.77"
"""A local address whose standard ports are free."""


class Process:
    """A program, and its printed lines with the time of each.

    With `kill_at` it is killed when it prints that; later lines are not read.
    """

    def __init__(
        self, command: list[str], env: dict[str, str] | None = None, kill_at: str = ""
    ) -> None:
        self._kill_at = kill_at
        self._process = subprocess.Popen(
            command,
            env={**os.environ, **(env or {})},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        )
        self.lines: list[tuple[float, str]] = []
        self._news = threading.Condition()
        self._ended = False
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            with self._news:
                self.lines.append((time.monotonic(), line.rstrip()))
                self._news.notify_all()
            if self._kill_at and self._kill_at in line:
                self._process.kill()
                self._process.wait()
                break
        with self._news:
            self._ended = True
            self._news.notify_all()

    def line_with(self, text: str, seconds: float = 20.0) -> str:
        """Wait for the first line with that text and return it."""
        result: list[str] = []

        def target() -> bool:
            result[:] = [line for _, line in self.lines if text in line][:1]
            return bool(result) or self._ended

        with self._news:
            self._news.wait_for(target, seconds)
        assert result, f"never printed {text!r}: {[line for _, line in self.lines][-20:]}"
        return result[0]

    def lines_containing(self, *texts: str, since: float = 0.0) -> list[str]:
        """Return lines with one of those texts."""
        return [line for at, line in self.lines if at >= since and any(t in line for t in texts)]

    def send(self, number: int) -> None:
        """Send a signal."""
        self._process.send_signal(number)

    def end(self, number: int = signal.SIGTERM, seconds: float = 10.0) -> int | None:
        """Send a signal and wait; return None if it had to be killed."""
        if self._process.poll() is None:
            self.send(number)
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            return None

    @property
    def pid(self) -> int:
        """Return the process id."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """True while it runs."""
        return self._process.poll() is None


class Simulated:
    """`rapidgen sim` on the standard ports of HOST, and its control socket."""

    def __init__(self, target: str, *options: str) -> None:
        program = str(Path(sys.executable).with_name("rapidgen"))
        self._command = [program, "sim", target, "--host", HOST, *options]
        self._start()

    def _start(self) -> None:
        self.process = Process(self._command, {"NO_COLOR": "1"})
        ready = self.process.line_with("ready {", 60)
        addresses = json.loads(ready.removeprefix("ready "))
        self._token = addresses["token"]
        self._socket = socket.create_connection(("127.0.0.1", addresses["control"]), timeout=20)
        self._lines = self._socket.makefile("rb")
        self._lock = threading.Lock()

    def ask(self, do: str, **what: object) -> object:
        """Send one request to the control socket."""
        with self._lock:
            request = {"do": do, "token": self._token, **what}
            self._socket.sendall(json.dumps(request).encode() + b"\n")
            answer = json.loads(self._lines.readline())
        assert answer["ok"], answer
        return answer["result"]

    def positions(self, group: str = "rob1") -> list[float]:
        """Return the axes, rad and m, in wire order."""
        return self.ask("status")["groups"][group]["positions"]

    def standing(self, group: str = "rob1") -> bool:
        """True if no axis moves."""
        return bool(self.ask("status")["groups"][group]["standing"])

    @contextmanager
    def sampled(self, group: str = "rob1") -> Iterator[list[tuple[float, list[float]]]]:
        """Record (time, positions), about 50 a second, while the block runs."""
        samples: list[tuple[float, list[float]]] = []
        end = threading.Event()

        def sample() -> None:
            while not end.wait(0.02):
                samples.append((time.monotonic(), self.positions(group)))

        thread = threading.Thread(target=sample, daemon=True)
        thread.start()
        try:
            yield samples
        finally:
            end.set()
            thread.join()

    def restart(self) -> None:
        """Restart: another boot of the same controller."""
        self.close()
        self._start()

    def close(self) -> None:
        """End it."""
        self._socket.close()
        self.process.end()


def write_backup(system: System, folder: Path) -> Path:
    """Write a system as a folder that `rapidgen sim` boots.

    It has SYSPAR and HOME of a backup.
    """
    (folder / "SYSPAR").mkdir(parents=True)
    (folder / "HOME").mkdir()
    (folder / "SYSPAR" / "SYS.cfg").write_text(write_cfg(sys_cfg(system)))
    (folder / "SYSPAR" / "EIO.cfg").write_text(write_cfg(eio_cfg(system)))
    for task in system.tasks:
        for module in task.modules:
            (folder / "HOME" / Path(module.path).name).write_bytes(module.data)
    return folder


class Workspace:
    """A built catkin workspace and a ROS master for it. Close it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self._devel = self.folder / "devel"
        if not (self._devel / "lib").is_dir():
            raise SystemExit(f"{folder} is no built catkin workspace: it has no devel/lib")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        packages = str(self._devel / "lib/python3/dist-packages")
        self._env = {
            "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
            "ROS_IP": "127.0.0.1",
            "ROS_PACKAGE_PATH": str(self.folder / "src"),
            "CMAKE_PREFIX_PATH": str(self._devel),
            "LD_LIBRARY_PATH": str(self._devel / "lib"),
            "PYTHONPATH": packages,
            "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
            "ROS_HOME": str(self.folder / "home"),
        }
        os.environ.update({k: v for k, v in self._env.items() if k.startswith("ROS_")})
        sys.path += [p for p in (packages, SYSTEM_PACKAGES) if p not in sys.path]
        self._master = Process(["/usr/bin/rosmaster", "--core", "-p", str(port)], self._env)
        until(lambda: _listens(port), 20, "no ROS master")
        import rospy

        rospy.init_node("bench", disable_signals=True)

    def node(self, package: str, program: str, *arguments: str, kill_at: str = "") -> Process:
        """Start a node, optionally with `kill_at`.

        With `kill_at` the node logs each point until it is killed.
        """
        path = self._devel / "lib" / package / program
        env = dict(self._env)
        if kill_at:
            talkative = self.folder / "home" / "debug.config"
            talkative.parent.mkdir(exist_ok=True)
            talkative.write_text("log4j.logger.ros=DEBUG\n")
            env["ROSCONSOLE_CONFIG_FILE"] = str(talkative)
        return Process([str(path), *arguments], env, kill_at)

    def launch(self, package: str, file: str, *arguments: str) -> Process:
        """Start a launch file with the system's roslaunch."""
        return Process(["/usr/bin/roslaunch", package, file, *arguments], self._env)

    def parameters(self, **values: object) -> None:
        """Set parameters on the master."""
        import rospy

        for name, value in values.items():
            rospy.set_param(name.replace("__", "/"), value)

    def close(self) -> None:
        """End the master."""
        import rospy

        rospy.signal_shutdown("done")
        self._master.end()


def _listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def until(target: Callable[[], object], seconds: float, else_: str) -> None:
    """Wait until a condition holds.

    Raises AssertionError after the time limit.
    """
    end = time.monotonic() + seconds
    while not target():
        assert time.monotonic() < end, else_
        time.sleep(0.02)
