"""A virtual controller with the driver on it, raw clients, and a record of what the robot did.

The clients speak bytes and know nothing of the modules, so that what they prove holds for any
client. Positions are the controller's axes, rad and m, in wire order.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from rapidgen.config.model import MotionGroup, RobotConfig
from rapidgen.protocol import Frame, FrameSplitter, WireError, decode, encode, messages, spec
from rapidgen.proving.model import Broken, Series
from rapidgen.system.model import System
from rapidgen.virtual.controller import Deadlock, VirtualController
from rapidgen.virtual.dialect import Dialect
from rapidgen.virtual.errors import FatalError
from rapidgen.virtual.faults import FaultPlan
from rapidgen.virtual.network.interface import Endpoint, NetworkFault
from rapidgen.virtual.tracing import Coverage

Position: TypeAlias = tuple[float, ...]
Point: TypeAlias = tuple[Position, float]
"""Joints and the seconds from the point before."""
Lines: TypeAlias = dict[str, dict[int, int]]
"""How often each line of RAPID with a statement was reached, by module file."""

FAILURES = (Broken, Deadlock, FatalError, WireError)
"""What a driver's fault looks like from here; anything else is a fault of ours."""

SAMPLE = 4_000_000
"""ns between two samples of the record while the robot moves ..."""
SAMPLE_STANDING = 100_000_000
"""... and while it stands and says so."""
PLOTTED = 200
"""Samples of one series in a plot, about."""
SETTLED = 1e-4
"""rad or m: as far as a standing robot may be from a point that it has reached."""


@dataclass(frozen=True, slots=True)
class Setting:
    """How the controller under the driver behaves, and which of its groups is driven."""

    seed: int = 0
    group: int = 0
    random_schedule: bool = False
    switch_at_pers: bool = False
    dialect: Dialect = field(default_factory=Dialect)
    faults: FaultPlan = field(default_factory=FaultPlan)
    coverage: bool = False


class Link:
    """One client connection, as bytes and frames. Frames are taken, with their time, as they come.

    `reading` False: a client that never reads.
    """

    def __init__(self, bench: "Bench", port: int, *, reading: bool = True) -> None:
        self._bench = bench
        self._network = bench.controller.network
        self._splitter = FrameSplitter()
        self.frames: list[tuple[float, Frame]] = []
        self.sent = 0
        self.lost = False
        self._taken = 0
        self._said: FrameSplitter | None = FrameSplitter()
        self._trajectory: list[Point] = []
        self.endpoint: Endpoint = self._network.connect("127.0.0.1", port)
        if reading:
            self.endpoint.changed.add(self._receive)
        bench.until(lambda: self.endpoint.connected, 5, f"port {port} accepts a connection")

    def send(self, data: bytes) -> None:
        """Write all of `data`, letting time pass while the controller has no room."""
        while data and not self.lost:
            try:
                taken = self._network.send(self.endpoint, data)
            except NetworkFault:
                self.lost = True
                return
            self.sent += taken
            self._listen(data[:taken])
            data = data[taken:]
            if data:
                self._bench.run(0.01)

    def _listen(self, data: bytes) -> None:
        """Keep what a well-formed download asks for, for the plots."""
        if self._said is None:
            return
        self._said.feed(data)
        try:
            while (frame := self._said.next()) is not None:
                content = decode(frame)
                if isinstance(content, messages.TrajectoryPoint):
                    self._keep(content)
        except WireError:
            self._said = None

    def _keep(self, point: messages.TrajectoryPoint) -> None:
        if point.sequence == spec.Sequence.START_DOWNLOAD:
            self._trajectory = []
        joints = tuple(point.joints[: len(self._bench.group.joints)])
        self._trajectory.append((joints, point.duration))
        if point.sequence == spec.Sequence.END:
            self._bench.commanded.append((self._bench.now, self._trajectory))
            self._trajectory = []

    def read(self) -> list[Frame]:
        """Frames that have arrived since the last call."""
        found = [frame for _, frame in self.frames[self._taken :]]
        self._taken = len(self.frames)
        return found

    @property
    def unread(self) -> int:
        """Index into `frames` of the first one that was not read yet."""
        return self._taken

    def _receive(self) -> None:
        while not self.lost:
            try:
                data = self._network.receive(self.endpoint, 65_536)
            except NetworkFault:
                self.lost = True
                return
            if data is None:
                return
            if not data:
                self.lost = True
                return
            self._splitter.feed(data)
            while (frame := self._splitter.next()) is not None:
                self.frames.append((self._bench.now, frame))

    def expect_reply(self, seconds: float, what: str) -> Frame:
        """The next frame that was not read yet, within `seconds`."""
        self._bench.until(lambda: len(self.frames) > self._taken, seconds, what)
        self._taken += 1
        return self.frames[self._taken - 1][1]

    def close(self, *, abort: bool = False) -> None:
        """End the connection (FIN), or reset it (RST)."""
        self._network.close(self.endpoint, abort=abort)
        self.lost = True


class Bench:
    """A booted driver, ready to be asked for things."""

    def __init__(self, config: RobotConfig, system: System, setting: Setting | None = None) -> None:
        self.config = config
        self.system = system
        self.setting = setting if setting is not None else Setting()
        self._beside: list[Bench] = []
        self.controller = self._boot()
        self._coverage = Coverage(self.controller) if self.setting.coverage else None
        self.group: MotionGroup = config.groups[self.setting.group]
        self.track: list[tuple[float, Position]] = []
        self.commanded: list[tuple[float, list[Point]]] = []
        """Downloads that were sent to their end, and when."""
        self._next = self.controller.kernel.after(0, self._sample)
        self.controller.motion.group(self.group.name).changed.add(self._sample)

    def _boot(self) -> VirtualController:
        controller = VirtualController(
            self.system,
            self.config.groups,
            seed=self.setting.seed,
            schedule="random" if self.setting.random_schedule else "round-robin",
            switch_at_pers=self.setting.switch_at_pers,
            dialect=self.setting.dialect,
            faults=self.setting.faults,
            # A schedule must be the same when it is traced, which is done by statement.
            accounting="statement" if self.setting.random_schedule else "block",
            tracing=self.setting.coverage,
        )
        return controller

    def beside(self, system: System) -> "Bench":
        """Another controller with another system, under the same setting; close it."""
        other = Bench(self.config, system, self.setting)
        self._beside.append(other)
        return other

    def lines(self) -> Lines:
        """Lines of RAPID that were reached here and beside; empty without `coverage`."""
        found = self._coverage.lines() if self._coverage is not None else {}
        for other in self._beside:
            add_lines(found, other.lines())
        return found

    def _sample(self) -> None:
        """Keep the position when it has changed; look less often while the robot stands."""
        here = self.position
        if not self.track or here != self.track[-1][1]:
            self.track.append((self.now, here))
        self._next.cancel()
        wait = SAMPLE_STANDING if self.standing else SAMPLE
        self._next = self.controller.kernel.after(wait, self._sample)

    def close(self) -> None:
        """Give the controller back."""
        self.controller.close()

    # -- time -----------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """Simulated seconds."""
        return self.controller.now

    def run(self, seconds: float) -> None:
        """Let time pass."""
        self.controller.run_for(seconds)

    def until(self, condition: Callable[[], bool], seconds: float, what: str) -> None:
        """Let time pass until `condition`; Broken when it did not come within `seconds`."""
        if not self.controller.run_until(condition, timeout=seconds):
            raise Broken(f"{what}: not within {seconds:g} s")

    # -- the robot ------------------------------------------------------------------------------

    @property
    def position(self) -> Position:
        """Where the axes of the first group are."""
        return tuple(self.controller.motion.group(self.group.name).positions())

    @property
    def standing(self) -> bool:
        """Whether the first group stands."""
        return self.controller.motion.group(self.group.name).is_standing

    def wait_until_moving(self, seconds: float = 5) -> None:
        """Wait for the robot to begin to move."""
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
        """Wait until the robot stands at `target`."""
        self.until(
            lambda: self.standing and distance(self.position, target) < SETTLED,
            seconds,
            "the robot reaches the last point",
        )

    def stays(self, seconds: float, why: str) -> None:
        """Let time pass; Broken when the robot moved meanwhile."""
        before, start = self.position, len(self.track)
        self.run(seconds)
        for when, seen in self.track[start:]:
            if distance(seen, before) > SETTLED:
                raise Broken(f"the robot moved at {when:.3f} s: {why}")

    def followed(self, path: Sequence[Position], *, since: float, corner: float = 0.05) -> None:
        """Broken unless every sample since `since` lies on a prefix of `path`, in order.

        `corner` (rad, m) is how far a zone may cut a corner.
        """
        at = 0
        for when, seen in self.track:
            if when < since:
                continue
            while at < len(path) - 2 and off(seen, path[at], path[at + 1]) > SETTLED:
                if off(seen, path[at + 1], path[at + 2]) > off(seen, path[at], path[at + 1]):
                    break
                at += 1
            near = min(
                off(seen, path[i], path[i + 1]) for i in range(at, min(at + 2, len(path) - 1))
            )
            if near > corner:
                raise Broken(
                    f"at {when:.3f} s the robot was {near:.4f} rad off what was asked "
                    f"(near point {at + 1})"
                )

    # -- clients --------------------------------------------------------------------------------

    def motion(self) -> Link:
        """A new connection to the motion server."""
        return self._link(self.group.ports.motion)

    def state(self, *, reading: bool = True) -> Link:
        """A new connection to the state server."""
        return self._link(self.group.ports.state, reading=reading)

    def _link(self, port: int, *, reading: bool = True) -> Link:
        network = self.controller.network
        self.until(lambda: port in network.listeners, 10, f"the driver listens on port {port}")
        return Link(self, port, reading=reading)

    def status(self, link: Link, seconds: float = 2) -> messages.Status:
        """The next STATUS on a state connection."""
        link.read()

        def arrived() -> messages.Status | None:
            for _, frame in link.frames[link.unread :]:
                content = decode(frame)
                if isinstance(content, messages.Status):
                    return content
            return None

        self.until(lambda: arrived() is not None, seconds, "a STATUS arrives")
        status = arrived()
        assert status is not None
        return status

    # -- trajectories ---------------------------------------------------------------------------

    def wave(self, count: int, *, duration: float = 0.4, size: float = 0.06) -> list[Point]:
        """`count` points from where the robot stands, back and forth within limits and speeds."""
        here = self.position
        steps = [self._step(axis, here, duration, size) for axis in range(len(here))]
        points: list[Point] = [(here, 10.0)]
        for number in range(1, count):
            shares = [abs(math.sin(number * (0.35 + 0.11 * axis))) for axis in range(len(here))]
            joints = tuple(h + s * share for h, s, share in zip(here, steps, shares, strict=True))
            points.append((joints, duration))
        return points

    def _step(self, axis: int, here: Position, duration: float, size: float) -> float:
        joint = self.group.joints[axis]
        room_up, room_down = joint.upper - here[axis], here[axis] - joint.lower
        room = max(room_up, room_down)
        step = min(size, 0.2 * duration * joint.speed, 0.5 * room)
        return step if room_up >= room_down else -step

    def download(self, points: Sequence[Point], comm: spec.Comm = spec.Comm.TOPIC) -> bytes:
        """The frames of a trajectory as the ROS-Industrial node sends them."""
        return b"".join(
            point_frame(number, len(points), joints, duration, comm)
            for number, (joints, duration) in enumerate(points)
        )

    def moves_through(self, link: Link, points: Sequence[Point]) -> None:
        """Send a trajectory and see it executed whole and in order."""
        since = self.now
        link.send(self.download(points))
        self.wait_until_at(points[-1][0], 30 + 3 * sum(d for _, d in points[1:]))
        self.followed([self.track_at(since), *(p for p, _ in points)], since=since)

    def track_at(self, when: float) -> Position:
        """Where the robot was at a time."""
        for time, seen in reversed(self.track):
            if time <= when:
                return seen
        return self.track[0][1] if self.track else self.position

    def series(self) -> tuple[Series, ...]:
        """Executed and commanded joints, for a plot; none when nothing moved.

        A download is drawn from the moment in which the robot began to move for it.
        """
        if len(self.track) < 2:
            return ()
        thinner = max(1, len(self.track) // PLOTTED)
        track = [*self.track[::thinner], self.track[-1]]
        found = [Series("executed", tuple(t for t, _ in track), tuple(p for _, p in track))]
        for number, (sent, points) in enumerate(self.commanded):
            over = self.commanded[number + 1][0] if number + 1 < len(self.commanded) else self.now
            begun = [t for t, _ in self.track if sent < t <= over]
            if not begun:
                continue
            times, at = [], begun[0]
            for index, (_, duration) in enumerate(points):
                at += duration if index else 0.0
                times.append(at)
            shown = max(1, len(points) // PLOTTED)
            rows = tuple(joints for joints, _ in points[::shown])
            found.append(Series("commanded", tuple(times[::shown]), rows))
        return tuple(found)

    def healthy(self) -> None:
        """Broken when a task has ended with an error: nothing that happens may do that."""
        for name, task in self.controller.tasks.items():
            if task.state == "error":
                raise Broken(f"task {name} ended with an error: {task.fault}")

    def log(self) -> tuple[str, ...]:
        """Event log and program positions with their statements, for a failure's report."""
        events = [str(event) for event in self.controller.log]
        texts = {m.path: m.data for task in self.system.tasks for m in task.modules}
        places = []
        for name, task in self.controller.tasks.items():
            text = ""
            if task.stack:
                at = task.stack[-1]
                lines = texts.get(at.span.path, b"").decode("latin-1").splitlines()
                statement = lines[at.span.line - 1].strip() if at.span.line <= len(lines) else ""
                text = f" at {at.span.path}:{at.span.line} ({at.routine}): {statement}"
            places.append(f"{name} is {task.state}{text}")
        return (*events[-40:], *places)


def point_frame(
    number: int, count: int, joints: Position, duration: float, comm: spec.Comm = spec.Comm.TOPIC
) -> bytes:
    """Point `number` (from 0) of `count`, numbered as the ROS-Industrial node does."""
    if number == 0:
        sequence = int(spec.Sequence.START_DOWNLOAD)
    elif number == count - 1:
        sequence = int(spec.Sequence.END)
    else:
        sequence = number
    return raw_point(sequence, joints, duration, comm)


def raw_point(
    sequence: int, joints: Sequence[float], duration: float, comm: spec.Comm = spec.Comm.TOPIC
) -> bytes:
    """A point with any sequence number."""
    padded = (*joints, *[0.0] * (spec.MAX_JOINTS - len(joints)))
    return encode(messages.TrajectoryPoint(sequence, padded, 0.0, duration), comm)


STOP = raw_point(int(spec.Sequence.STOP), (), 0.0, spec.Comm.REQUEST)


def distance(one: Position, other: Position) -> float:
    """Largest difference of an axis."""
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def off(seen: Position, start: Position, end: Position) -> float:
    """Distance of a position from the straight way between two (largest axis)."""
    along = [e - s for s, e in zip(start, end, strict=True)]
    length = sum(a * a for a in along)
    share = 0.0
    if length:
        share = sum((p - s) * a for p, s, a in zip(seen, start, along, strict=True)) / length
        share = min(1.0, max(0.0, share))
    return distance(seen, tuple(s + share * a for s, a in zip(start, along, strict=True)))


def add_lines(to: Lines, more: Lines) -> None:
    """Add up how often lines were reached."""
    for path, lines in more.items():
        own = to.setdefault(path, {})
        for line, hits in lines.items():
            own[line] = own.get(line, 0) + hits


def with_module(system: System, path: str, data: bytes) -> System:
    """The system with the text of one module file replaced, in every task that loads it."""
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
