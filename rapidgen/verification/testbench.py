"""Test bench: virtual controller with the driver, clients and a record.

The clients send bytes and share no code with the Python client, so that results hold for any
client. Positions are the controller's axes, rad and m, in wire order.

Rules of the bench:

- Time is simulated. It passes only in `run`, `until` and the `wait_...` methods, and in a RawLink
  that waits. A check between two of them sees one moment.
- The record holds the robot's position with the time of its first sample. It is sampled every 4 ms
  while the robot moves and every 100 ms while it stands. Sampling never executes a task.
- All random choices of the controller come from the setting's seed, so that a case gives the same
  result on each run. Tracing does not change them.
- `assert_...` methods and the functions in `position_checks` raise CheckFailed with the expected
  and the observed value. The runner reports CheckFailed, Deadlock, FatalError and NetworkFault as
  failures of the driver. Any other exception is a fault of the suite.
- `second_controller` boots another controller, which has a clock of its own; its caller closes it.
  `of_group` returns a bench of another motion group on the same controller.
- The motion task drops data that arrives before the robot has settled. The constructor therefore
  waits for that, unless the setting is `early`.
"""

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

from rapidgen._compat import Self
from rapidgen.axes import frames
from rapidgen.config.model import GroupConfig, Joint, RobotConfig
from rapidgen.controller.controller import Deadlock, VirtualController
from rapidgen.controller.tracing import Coverage
from rapidgen.diagnostics import Span
from rapidgen.machine.event_table import Domain
from rapidgen.machine.network.fault_injection import FaultyNetwork
from rapidgen.machine.network.interface import NetworkFault
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.compiler.symbols import CannotCompile
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import ModuleFile, System
from rapidgen.verification.messages import (
    PROTOCOL_VERSION,
    RawComm,
    RawHello,
    RawHelloReply,
    RawProgress,
    RawStatus,
    encode,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import SETTLED, Point, Position, distance, on_path, still
from rapidgen.verification.raw_connection import RawLink, point_frame
from rapidgen.verification.settings import Setting

Lines: TypeAlias = dict[str, dict[int, int]]
"""Execution counts of RAPID lines with a statement, by module file."""

HELLO = RawHello(PROTOCOL_VERSION, (0, 0, 0), 1)
"""HELLO of a client that requests PROGRESS."""

FAILURES = (CheckFailed, Deadlock, FatalError, NetworkFault)
"""Exceptions that mean a fault of the driver; all others are faults of the suite."""

SAMPLE = 4_000_000
"""ns between two samples of the record while the robot moves, by default ..."""
SAMPLE_STANDING = 100_000_000
"""... and while it stands and reports so."""
CEILING = 5.0
"""m/s: below it, the driver checks the TCP speed of a group."""
_PIECES = 60
"""Pieces of a path, to find the fastest TCP speed on it."""
LATE = 195_901
"""Event of the virtual controller: moves took longer than programmed.

The excess itself is measured elsewhere.
"""
CORNER_FAILURE = 50_024
"""Event: a move with a zone ended as a stop point, because the next one came too late."""


class Bench:
    """A virtual controller running the driver, with raw test clients."""

    def __init__(
        self,
        config: RobotConfig,
        system: System,
        setting: Setting | None = None,
        robots: Sequence[GroupConfig] = (),
        controller: VirtualController | None = None,
    ) -> None:
        """Boot.

        `robots`: the controller's robots, if they differ from the configuration's.
        """
        self.config = config
        self._robots = robots or config.groups
        self.system = system
        self.setting = setting if setting is not None else Setting()
        self._others: list[Bench] = []
        self.controller = controller if controller is not None else self._boot()
        tracked = self.setting.coverage and controller is None
        self._coverage = Coverage(self.controller) if tracked else None
        self.group: GroupConfig = config.groups[self.setting.group]
        self.sample = SAMPLE
        """ns between two samples while the robot moves."""
        self.track: list[tuple[float, Position]] = []
        self.commanded: list[tuple[float, list[Point]]] = []
        """Complete downloads, with times."""
        self._next = self.controller.scheduler.after(0, self._sample)
        self.motion_group.changed.add(self._sample)

    def _boot(self) -> VirtualController:
        controller = VirtualController(
            self.system,
            self._robots,
            seed=self.setting.seed,
            schedule="random" if self.setting.random_schedule else "round-robin",
            switch_at_pers=self.setting.switch_at_pers,
            dialect=self.setting.dialect,
            costs=self.setting.costs,
            faults=self.setting.faults,
            # A schedule must not change when it is traced, and tracing works by statement.
            accounting="statement" if self.setting.random_schedule else "block",
            tracing=self.setting.coverage or self.setting.tracing,
        )
        controller.motion.settings = self.setting.motion
        if self.setting.motion.settle > 0:
            # The motion task starts when the robot has settled, and drops data received before.
            controller.run_for(2 * self.setting.motion.settle)
        return controller

    def begin(self, setting: Setting) -> None:
        """Start a new controller as if booted with this setting's seed and network.

        No task of the controller may have run yet.
        """
        network = self.controller.network
        assert isinstance(network, FaultyNetwork)
        self.setting = setting
        self.controller.scheduler.draw_from(setting.seed)
        network.obey(setting.faults.network)

    def replace_module(self, task: str, module: ModuleFile) -> None:
        """Replace a module of the same name while none of its code runs."""
        program = self.controller.rapid_tasks[task].program
        program.unload(module.name)
        program.load([(self.controller.parse_module(module), module)])

    def second_controller(
        self,
        system: System,
        robots: Sequence[GroupConfig] = (),
        setting: Setting | None = None,
    ) -> "Bench":
        """Boot another controller with another system, robots or setting.

        The caller closes it.
        """
        other = Bench(self.config, system, setting or self.setting, robots)
        self._others.append(other)
        return other

    def of_group(self, number: int) -> "Bench":
        """Return the bench of another motion group; it closes with this one."""
        return Bench(
            self.config,
            self.system,
            replace(self.setting, group=number),
            self._robots,
            controller=self.controller,
        )

    @property
    def motion_group(self) -> MotionGroup:
        """Return this group on the controller."""
        return self.controller.motion.group(self.group.name)

    @property
    def mechanical_unit(self) -> str:
        """Return the mechanical unit group of this group's tasks."""
        tasks = {task.name: task for task in self.system.tasks}
        return tasks[self.group.task].mechanical_unit_group

    def lines(self) -> Lines:
        """Return reached RAPID lines of all benches; empty without `coverage`."""
        result = self._coverage.lines() if self._coverage is not None else {}
        for other in self._others:
            add_lines(result, other.lines())
        return result

    def _sample(self) -> None:
        """Record a changed position; sample less often while the robot stands."""
        current = self.position
        if not self.track or current != self.track[-1][1]:
            self.track.append((self.now, current))
        self._next.cancel()
        wait = SAMPLE_STANDING if self.standing else self.sample
        self._next = self.controller.scheduler.after(wait, self._sample)

    def close(self) -> None:
        """Release the controller."""
        self.controller.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # -- time -----------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """Return the simulated seconds."""
        return self.controller.now

    def run(self, seconds: float) -> None:
        """Let time pass."""
        self.controller.run_for(seconds)

    def until(self, condition: Callable[[], bool], seconds: float, what: str) -> None:
        """Let time pass until `condition`; fail after `seconds`."""
        if not self.controller.run_until(condition, timeout=seconds):
            raise CheckFailed(f"{what}: not within {seconds:g} s")

    # -- the robot ------------------------------------------------------------------------------

    @property
    def position(self) -> Position:
        """Return the axes of the first group."""
        return tuple(self.motion_group.positions())

    @property
    def standing(self) -> bool:
        """True if the first group stands."""
        return self.motion_group.is_standing

    def wait_until_moving(self, seconds: float = 5) -> None:
        """Wait for the robot to start moving."""
        self.until(lambda: not self.standing, seconds, "the robot begins to move")

    def wait_until_standing(self, seconds: float = 60) -> None:
        """Wait until the robot has stood for a tenth of a second."""
        since = [self.now]

        def settled() -> bool:
            if not self.standing:
                since[0] = self.now
            return self.now - since[0] >= 0.1

        self.until(settled, seconds, "the robot comes to rest")

    def wait_until_at(self, target: Position, seconds: float = 60) -> None:
        """Wait until the robot is at `target`."""
        self.until(
            lambda: self.standing and distance(self.position, target) < SETTLED,
            seconds,
            "the robot reaches the last point",
        )

    def start_again(self) -> None:
        """Restart as an operator does after a stop.

        Automatic mode, motors on, Start.
        """
        for action in ("reset-e-stop", "auto", "motors-on", "start"):
            self.controller.perform(action)

    def assert_at_rest(self, seconds: float, why: str) -> None:
        """Let time pass; check that the robot does not move."""
        before, start = self.position, len(self.track)
        self.run(seconds)
        still(self.track[start:], before, why)

    def wait_until_at_rest(self, within: float, then: float, why: str) -> None:
        """Wait until the robot rests; check that it stays so for `then` s."""
        self.wait_until_standing(within)
        self.assert_at_rest(then, why)

    def followed(self, path: Sequence[Position], *, since: float, corner: float = 0.05) -> None:
        """Check that the robot followed a prefix of `path` since then (`on_path`)."""
        on_path([sample for sample in self.track if sample[0] >= since], path, corner)

    def arrives(self, points: Sequence[Point], since: float, seconds: float) -> None:
        """Wait until the robot is at the last point; check its path."""
        self.wait_until_at(points[-1][0], seconds)
        self.executed(points, since)

    def executed(self, points: Sequence[Point], since: float) -> None:
        """Check that the robot followed these points since then."""
        self.followed([self.track_at(since), *(p for p, _ in points)], since=since)

    def forget(self) -> None:
        """Discard the record so far, to limit the memory of long campaigns."""
        del self.track[:-1]
        self.commanded.clear()

    # -- the program ----------------------------------------------------------------------------

    def task(self, module: str) -> str:
        """Return the name of this group's task that runs a module."""
        for task in self.system.tasks:
            names = [m.name.casefold() for m in task.modules]
            if task.mechanical_unit_group == self.mechanical_unit and module.casefold() in names:
                return task.name
        raise KeyError(module)

    def rapid_task(self, module: str) -> Task:
        """Return the running task of this group that has a module."""
        return self.controller.rapid_tasks[self.task(module)]

    def compile(self) -> None:
        """Compile all RAPID now, so that copies of this bench need not."""
        for task in self.controller.rapid_tasks.values():
            with suppress(CannotCompile):
                task.program.find_initial_values()
            for module in task.program.modules.values():
                for routine in module.routines.values():
                    # A link error ends its task when it is called, not here.
                    with suppress(FatalError):
                        task.program.function(routine)

    def waits_in(self, module: str, instruction: str) -> bool:
        """True if a module's task is at that instruction now."""
        stack = self.controller.task(self.task(module)).stack
        return bool(stack) and instruction in self._statement(stack[-1].span)

    def _statement(self, span: Span) -> str:
        """Return the line of RAPID at a place."""
        data = next(
            (m.data for t in self.system.tasks for m in t.modules if m.path == span.path), b""
        )
        lines = data.decode("latin-1").splitlines()
        return lines[span.line - 1].strip() if span.line <= len(lines) else ""

    # -- clients --------------------------------------------------------------------------------

    def motion(self) -> RawLink:
        """Open a connection to the motion server."""
        return self._link(self.group.ports.motion)

    def state(self, *, reading: bool = True) -> RawLink:
        """Open a connection to the state server."""
        return self._link(self.group.ports.state, reading=reading)

    def control(self) -> RawLink:
        """Open a connection to the control server, if configured."""
        return self._link(self.group.ports.control)

    def _link(self, port: int, *, reading: bool = True, address: str = "") -> RawLink:
        network = self.controller.network
        self.until(lambda: port in network.listeners, 10, f"the driver listens on port {port}")
        return RawLink(self, port, reading=reading, address=address or self.address)

    @property
    def address(self) -> str:
        """Return a client address that the configuration allows."""
        return next(iter(self.config.allowed_clients), "127.0.0.1")

    def connect_unlisted(self, port: int) -> RawLink:
        """Connect from an address that no configuration allows."""
        return self._link(port, address="203.0.113.77")

    def status(self, link: RawLink, seconds: float = 2) -> RawStatus:
        """Return the next STATUS on a state connection."""
        link.read()
        return link.expect(RawStatus, seconds, "a STATUS arrives")

    def watcher(self) -> RawLink:
        """Open a connection to the state server that requests PROGRESS."""
        link = self.state()
        self.send_hello(link)
        return link

    def send_hello(self, link: RawLink, subscribe: int = 1) -> RawHelloReply:
        """Send HELLO on a state connection and return the reply."""
        link.send(encode(HELLO._replace(subscribe=subscribe), RawComm.REQUEST))
        return link.expect(RawHelloReply, 2, "HELLO is answered")

    def progress(self, link: RawLink, seconds: float = 2) -> RawProgress:
        """Return the next PROGRESS on a connection that requested it."""
        link.read()
        return link.expect(RawProgress, seconds, "a PROGRESS arrives")

    # -- trajectories ---------------------------------------------------------------------------

    def wave(self, count: int, *, duration: float = 0.4, size: float = 0.06) -> list[Point]:
        """Return `count` points from here, back and forth within limits."""
        current = self.position
        steps = [self._step(axis, current, duration, size) for axis in range(len(current))]
        shares = [
            [abs(math.sin(number * (0.35 + 0.11 * axis))) for axis in range(len(current))]
            for number in range(count)
        ]

        def along(scale: float) -> list[Position]:
            return [
                tuple(
                    h + scale * s * share for h, s, share in zip(current, steps, row, strict=True)
                )
                for row in shares
            ]

        path = along(1)
        slowest = max((self.tcp_seconds(a, b) for a, b in pairwise(path)), default=0.0)
        if slowest > 0.9 * duration:
            path = along(0.9 * duration / slowest)
        return [(current, 10.0), *((joints, duration) for joints in path[1:])]

    @property
    def last_event(self) -> int:
        """Return the number of the newest event in the log; 0: none."""
        return max((event.sequence for event in self.controller.log), default=0)

    def start_tolerance(self, joint: Joint) -> float:
        """Return the start tolerance of a joint, rad or m."""
        policy = self.config.trajectory
        linear = joint.kind == "prismatic"
        return policy.start_tolerance_linear if linear else policy.start_tolerance

    def seconds_to(self, target: Position) -> float:
        """Return s to a point: half speed, below the TCP speed limit."""
        current = self.position
        joints = zip(self.group.joints, current, target, strict=True)
        needed = [2 * abs(there - value) / joint.speed for joint, value, there in joints]
        return max(0.5, 1.1 * self.tcp_seconds(current, target), *needed)

    def tcp(self, place: Position) -> tuple[float, ...]:
        """Return the TCP (m) of an axis position."""
        geometry = self.motion_group.kinematics
        assert geometry is not None
        tool = (self.group.tool.frame.position, self.group.tool.frame.orientation)
        return frames.compose(geometry.forward(place), tool)[0]

    def tcp_seconds(self, start: Position, end: Position) -> float:
        """Return s between two points with the TCP at its speed limit.

        0 if the configuration sets no limit below the standard one.
        """
        limit = self.group.tcp_speed_limit
        if limit >= CEILING or self.motion_group.kinematics is None:
            return 0.0
        shares = [n / _PIECES for n in range(_PIECES + 1)]
        path = [
            self.tcp(tuple(a + share * (b - a) for a, b in zip(start, end, strict=True)))
            for share in shares
        ]
        return max(math.dist(one, other) for one, other in pairwise(path)) * _PIECES / limit

    def _step(self, axis: int, current: Position, duration: float, size: float) -> float:
        joint = self.group.joints[axis]
        space_above, space_below = joint.upper - current[axis], current[axis] - joint.lower
        space = max(space_above, space_below)
        step = min(size, 0.2 * duration * joint.speed, 0.5 * space)
        return step if space_above >= space_below else -step

    def download(self, points: Sequence[Point], comm: RawComm = RawComm.TOPIC) -> bytes:
        """Return a trajectory's frames as the ROS-Industrial node sends them."""
        return b"".join(
            point_frame(number, len(points), joints, duration, comm)
            for number, (joints, duration) in enumerate(points)
        )

    @property
    def streams(self) -> bool:
        """True if the driver accepts points while it executes earlier ones."""
        return self.config.profile == "full"

    def way_to(self, place: Position) -> list[Point]:
        """Return a trajectory from the current position."""
        return [(self.position, 1.0), (place, self.seconds_to(place))]

    def start_motion(
        self, link: RawLink, points: Sequence[Point], then: float | None = None
    ) -> None:
        """Send a trajectory, wait for motion, and let it move for `then` s."""
        link.send(self.download(points))
        self.wait_until_moving()
        if then is not None:
            self.run(then)

    def assert_moves_through(self, link: RawLink, points: Sequence[Point]) -> None:
        """Send a trajectory; check that it is executed completely and in time.

        This needs full speed in automatic mode, and no warning may be logged. If no task is sure of
        its turn, a corner may be a stop point (`Setting.corners_in_time`); path and time are the
        same there.
        """
        since, requested = self.now, sum(d for _, d in points[1:])
        last = self.last_event
        link.send(self.download(points))
        self.arrives(points, since, 30 + 3 * requested)
        group = self.motion_group
        if group.override < 1 or group.reduced:
            return
        if self.now - since > 1.1 * requested + 3:
            raise CheckFailed(f"{requested:.2f} s of motion took {self.now - since:.2f} s")
        excused = {LATE} if self.setting.corners_in_time else {LATE, CORNER_FAILURE}
        complaints = [
            event
            for event in self.controller.log.since(last)
            if event.domain is Domain.MOTION and event.code not in excused
        ]
        if complaints:
            raise CheckFailed(f"the controller complains of the motion: {complaints[0]}")

    def track_at(self, when: float) -> Position:
        """Return the robot's position at a time."""
        for time, seen in reversed(self.track):
            if time <= when:
                return seen
        return self.track[0][1] if self.track else self.position

    def assert_healthy(self) -> None:
        """Check that no task has ended with an error."""
        for name, task in self.controller.tasks.items():
            if task.state == "error":
                raise CheckFailed(f"task {name} ended with an error: {task.fault}")

    def log(self) -> tuple[str, ...]:
        """Return event log and program positions, for a failure's report."""
        events = [str(event) for event in self.controller.log]
        places = []
        for name, task in self.controller.tasks.items():
            text = ""
            if task.stack:
                at = task.stack[-1]
                where = f"{at.span.path}:{at.span.line} ({at.routine})"
                text = f" at {where}: {self._statement(at.span)}"
            places.append(f"{name} is {task.state}{text}")
        return (*events[-40:], *places)


def add_lines(to: Lines, more: Lines) -> None:
    """Add execution counts of lines."""
    for path, lines in more.items():
        own = to.setdefault(path, {})
        for line, hits in lines.items():
            own[line] = own.get(line, 0) + hits


def with_module(system: System, path: str, data: bytes) -> System:
    """Return the system with one module file replaced in every task."""
    return replace(
        system,
        tasks=tuple(
            replace(
                task,
                modules=tuple(
                    replace(m, data=data, origin=()) if m.path == path else m for m in task.modules
                ),
            )
            for task in system.tasks
        ),
    )
