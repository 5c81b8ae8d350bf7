"""A session as its user sees it; the loop is in `process.py`."""

import contextlib
import os
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING

from rapidgen._compat import Self
from rapidgen._extras import named
from rapidgen.axes.mapping import JointMap
from rapidgen.client.egm.envelope import Envelope, Joints
from rapidgen.client.errors import ConnectionFailed, NotReady, RobotTimeout, TargetRejected
from rapidgen.config import load_config
from rapidgen.config.model import GroupConfig, RobotConfig

with named():
    from rapidgen.client.egm.exchange import EgmState, PartnerExchange, Path, Stop, Target

if TYPE_CHECKING:
    from rapidgen.client.trajectory import Trajectory

DEFAULT_PORT = 6510


def listen(
    config: str | RobotConfig,
    *,
    port: int = DEFAULT_PORT,
    host: str = "127.0.0.1",
    group: str = "",
    fraction: float = 0.25,
    step: float = 0.1,
    timeout: float = 0.1,
) -> "EgmSession":
    """Wait for frames of a controller and answer them.

    Nothing moves before the first `send` or `follow`: until then answers repeat the position of the
    robot.

    Args:
        config: Configuration, its file, or a shipped name.
        port: UDP port to which the controller sends: RemotePortNumber of its UdpUc device.
        host: Address of this computer in the network of the robot; loopback is the simulator's.
        group: Motion group; empty: the only one.
        fraction: Of the speeds and accelerations of the configuration (0 to 1) that are sent.
        step: Largest difference between two targets, rad and m.
        timeout: s without a new target after which the robot stops.

    Raises:
        DiagnosticError: No such configuration or group.
        ConnectionFailed: The port cannot be opened.
    """
    robot = config if isinstance(config, RobotConfig) else load_config(config)
    return EgmSession(
        _group(robot, group), Envelope.of(_group(robot, group), fraction, step), host, port, timeout
    )


def _group(config: RobotConfig, name: str) -> GroupConfig:
    names = [group.name for group in config.groups]
    if not name and len(names) == 1:
        return config.groups[0]
    for group in config.groups:
        if group.name == name:
            return group
    raise NotReady.because("RG681", f"no motion group {name!r}", f"groups: {', '.join(names)}")


class EgmSession:
    """The partner of one robot. Joints are rad and m in URDF order.

    All methods may be called from any thread.
    """

    def __init__(
        self, group: GroupConfig, envelope: Envelope, host: str, port: int, timeout: float
    ) -> None:
        self.envelope = envelope
        self._last: Joints | None = None
        self._state: EgmState | None = None
        self._changed = threading.Condition()
        self._closed = False
        opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            opened.bind((host, port))
        except OSError as fault:
            opened.close()
            raise ConnectionFailed.because(
                "RG681",
                f"cannot listen on {host}:{port}: {fault.strerror}",
                "end the program that uses the port, or give an address of this computer",
            ) from fault
        self.port: int = opened.getsockname()[1]
        exchange = PartnerExchange(JointMap.of(group), envelope, timeout)
        ours, theirs = socket.socketpair()
        with theirs, opened:
            numbers = (theirs.fileno(), opened.fileno())
            self._process = subprocess.Popen(
                [sys.executable, "-m", "rapidgen.client.egm.process", *map(str, numbers)],
                pass_fds=numbers,
                stdin=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )
        self._pipe = Connection(ours.detach())
        self._pipe.send(exchange)
        self._thread = threading.Thread(target=self._read, name="EGM states", daemon=True)
        self._thread.start()

    def _read(self) -> None:
        """Receive states until the process ends."""
        try:
            while True:
                state = self._pipe.recv()
                with self._changed:
                    self._state = state
                    if not state.guided or state.stopped:
                        self._last = None
                    self._changed.notify_all()
        except (EOFError, OSError):
            with self._changed:
                self._closed = True
                self._changed.notify_all()

    # -- states -----------------------------------------------------------------------------

    @property
    def state(self) -> EgmState | None:
        """Return the last state; None: no frame came yet."""
        return self._state

    def wait_until_guided(self, timeout: float = 10.0) -> EgmState:
        """Wait until the controller executes answers. Raises RobotTimeout, NotReady."""
        return self._wait(lambda state: state.guided, timeout, "the controller does not guide")

    def next_state(self, timeout: float = 1.0) -> EgmState:
        """Wait for the next state. Raises RobotTimeout, NotReady."""
        before = self._state
        return self._wait(lambda state: state is not before, timeout, "no frame has come")

    def _wait(self, ready: Callable[[EgmState], bool], timeout: float, missing: str) -> EgmState:
        due = time.monotonic() + timeout
        with self._changed:
            while True:
                if self._closed:
                    raise NotReady.because("RG681", "the EGM session is closed", "listen again")
                if self._state is not None and ready(self._state):
                    return self._state
                left = due - time.monotonic()
                if left <= 0:
                    raise RobotTimeout.because(
                        "RG681",
                        f"{missing} within {timeout:g} s",
                        "start the program with EGMRunJoint, and check address and port of the "
                        "UdpUc device",
                    )
                self._changed.wait(left)

    # -- targets ----------------------------------------------------------------------------

    def send(self, joints: Sequence[float]) -> None:
        """Send a target: (k,) positions.

        Raises TargetRejected: it is beyond the envelope, or the robot is not guided.
        """
        with self._changed:
            state = self._guided()
            values = self.envelope.check(joints, self._last or state.reference)
            self._last = values
            self._post(Target(values, time.monotonic()))

    def follow(self, trajectory: "Trajectory", timeout: float | None = None) -> None:
        """Follow a trajectory from now on, and wait for its end.

        Raises:
            TargetRejected: It does not begin where the robot is, or is faster than the envelope.
            RobotTimeout: It did not end within `timeout` s; None: its time and 5 s.
        """
        times = tuple(float(t) for t in trajectory.times)
        names = self.envelope.names
        if trajectory.names and sorted(trajectory.names) != sorted(names):
            raise _rejected(f"the trajectory has other joints than {', '.join(names)}")
        order = [(trajectory.names or names).index(name) for name in names]
        if trajectory.positions.shape[1] != len(names):
            raise _rejected(f"{trajectory.positions.shape[1]} columns for {len(names)} joints")
        positions = tuple(tuple(float(row[i]) for i in order) for row in trajectory.positions)
        with self._changed:
            self._check_path(times, positions, self._guided().reference)
            self._last = None
            self._post(Path(times, positions))
        end = positions[-1]
        self._wait(
            lambda state: state.reference == end or state.stopped or not state.guided,
            times[-1] + 5.0 if timeout is None else timeout,
            "the trajectory did not end",
        )
        if self._state is None or self._state.reference != end:
            raise _rejected("the trajectory was interrupted by a stop")

    def _check_path(
        self, times: tuple[float, ...], positions: tuple[Joints, ...], start: Joints
    ) -> None:
        if len(times) < 2 or times[0] != 0.0:
            raise _rejected("a trajectory has two points or more, and begins at 0 s")
        self.envelope.check(positions[0], start)
        envelope = self.envelope
        for row in positions:
            envelope.check(row, row)
        for i in range(1, len(times)):
            time_ = times[i] - times[i - 1]
            if not time_ > 0:
                raise _rejected(f"point {i} is not later than the one before")
            for j, (a, b) in enumerate(zip(positions[i - 1], positions[i], strict=True)):
                if abs(b - a) / time_ > envelope.speed[j] * (1 + 1e-6):
                    rate, top = abs(b - a) / time_, envelope.speed[j]
                    raise _rejected(
                        f"{envelope.names[j]} has {rate:.3f} at point {i}, allowed is {top:.3f}"
                    )

    def stop(self) -> None:
        """Slow down and stay; a new EGMRun of the program ends that."""
        with self._changed:
            self._last = None
            self._post(Stop())

    def _guided(self) -> EgmState:
        state = self._state
        if self._closed or state is None or not state.guided:
            raise _rejected("the controller does not guide the robot")
        if state.stopped:
            raise _rejected("the robot was stopped; a new EGMRun is needed")
        return state

    def _post(self, order: Target | Path | Stop) -> None:
        try:
            self._pipe.send(order)
        except OSError as fault:
            raise _rejected("the process of the session has ended") from fault

    # -- end --------------------------------------------------------------------------------

    def close(self) -> None:
        """Stop answering; the controller then ends the run by its time-out."""
        if not self._closed:
            # It may have ended already.
            with contextlib.suppress(OSError):
                self._pipe.send(None)
        self._process.wait()
        self._thread.join()
        self._pipe.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _rejected(text: str) -> TargetRejected:
    return TargetRejected.because(
        "RG680", f"target not sent: {text}", "`session.state` shows what the robot does"
    )
