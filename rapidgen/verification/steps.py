"""Steps of a case as data, and their interpreter.

A case is a sequence of steps: what a client, an operator or time does, each with what must be
observed then. Where steps depend on the robot or on the configuration, a generator yields them: it
continues when the step has been played, so that it sees the robot as it is then.

The steps of batches are in `stream_steps`, those of programs in `program_steps`. A table of cases
may add steps of its own. The interpreter counts trajectories itself: `Progress` compares the number
of the newest one, too.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import wraps
from typing import Final, Protocol, TypeAlias

from rapidgen.system.model import System
from rapidgen.verification import messages
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, distance
from rapidgen.verification.raw_connection import RawLink, raw_point
from rapidgen.verification.raw_programs import Programmer
from rapidgen.verification.stream import Streamer, way
from rapidgen.verification.testbench import Bench

Part: TypeAlias = slice | Sequence[Point]
NO_POINTS: Final[Sequence[Point]] = ()
_MILLIMETRE = 1e-3
_ACKNOWLEDGED = messages.RawAcknowledged()


class _Way:
    """The present way in a table of steps: `WAY[:20]` are its first 20 points."""

    def __getitem__(self, part: slice) -> slice:
        return part


WAY = _Way()


class Run:
    """State of a case: its connections, the way, the newest trajectory."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.watcher = bench.watcher()
        self.trajectory = bench.progress(self.watcher).trajectory
        """Number of the newest trajectory."""
        self.of_stream = self.trajectory
        """Number of the trajectory that the stream is."""
        self.connect()
        self._control: RawLink | None = None
        self.way: list[Point] = []
        self.since = bench.now
        self.working: Callable[[], None] = _nothing

    def connect(self) -> None:
        """Open a connection to the motion server, for a stream or for programs."""
        self.link = self.bench.motion()
        self.stream = Streamer(self.bench, self.link, number=0)
        self.client = Programmer(self.bench, self.link)

    @property
    def control(self) -> RawLink:
        """Return the connection to the control server; the first use opens it."""
        if self._control is None:
            self._control = self.bench.control()
        return self._control

    def points(self, part: Part) -> Sequence[Point]:
        """Return the points of a part."""
        return self.way[part] if isinstance(part, slice) else part

    def set_way(self, points: Sequence[Point]) -> None:
        """Take a new way, which begins now."""
        self.way, self.since = list(points), self.bench.now

    def pause(self) -> None:
        """Let the time pass after which PROGRESS and STATUS have reported a change."""
        setting = self.bench.setting
        reports = 2 * (self.bench.config.state_period + setting.motion.settle)
        self.bench.run(0.15 + 0.06 * setting.slowness + reports)


def _nothing() -> None:
    pass


class Step(Protocol):
    """One step of a case."""

    def play(self, run: Run) -> None:
        """Do it, and check what it expects."""


def play(bench: Bench, steps: Iterable[Step]) -> None:
    """Play steps on a bench; a failure names its step."""
    run = Run(bench)
    for number, step in enumerate(steps, 1):
        try:
            step.play(run)
        except CheckFailed as failure:
            raise CheckFailed(f"step {number}, {str(step)[:300]}: {failure}") from failure


def steps(*sequence: Step) -> Callable[[Bench], None]:
    """Return the function of a case with these steps."""
    return lambda bench: play(bench, sequence)


def generated(make: Callable[[Bench], Iterator[Step]]) -> Callable[[Bench], None]:
    """Return the function of a case whose steps depend on the bench."""

    @wraps(make)
    def played(bench: Bench) -> None:
        play(bench, make(bench))

    return played


# -- the client --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Way:
    """Take a way there and back of so many points; its first point is here."""

    count: int
    seconds: float = 0.15

    def play(self, run: Run) -> None:
        run.set_way(way(run.bench, self.count, self.seconds))


@dataclass(frozen=True, slots=True)
class Points:
    """Take these points as the way."""

    points: Sequence[Point] = field(repr=False)

    def play(self, run: Run) -> None:
        run.set_way(self.points)


@dataclass(frozen=True, slots=True)
class Stop:
    """Send STOP, which must be confirmed."""

    control: bool = False
    """Over the control port."""

    def play(self, run: Run) -> None:
        link = run.control if self.control else run.link
        if not isinstance(link.stop(1 if self.control else 2), messages.RawAcknowledged):
            raise CheckFailed("it is not confirmed")


@dataclass(frozen=True, slots=True)
class Ask:
    """Send a request over the control port and compare the reply; by default it is done."""

    request: messages.RawContent
    reply: messages.RawContent = _ACKNOWLEDGED

    def play(self, run: Run) -> None:
        reply = run.control.ask(self.request)
        if reply != self.reply:
            raise CheckFailed(f"the reply is {reply}")


@dataclass(frozen=True, slots=True)
class Send:
    """Send a download of these points."""

    points: Sequence[Point] = field(repr=False)

    def play(self, run: Run) -> None:
        run.trajectory += 1
        run.link.send(run.bench.download(self.points))


@dataclass(frozen=True, slots=True)
class Download:
    """Begin a download with points of these numbers; the first one is here."""

    sequences: tuple[int, ...] = (-1,)
    points: Sequence[Point] | None = field(default=None, repr=False)

    def play(self, run: Run) -> None:
        points = self.points or [(run.bench.position, 1.0)] * len(self.sequences)
        run.trajectory += -1 in self.sequences
        for number, point in zip(self.sequences, points, strict=True):
            run.link.send(raw_point(number, *point))


@dataclass(frozen=True, slots=True)
class Alone:
    """Send a point of a download that has not begun; it is rejected for that."""

    sequence: int

    def play(self, run: Run) -> None:
        run.trajectory += 1
        link = run.link
        link.send(raw_point(self.sequence, run.bench.position, 1.0, RawComm.REQUEST))
        reply = messages.decode(link.expect_reply(2, "a point alone is answered"))
        if reply != messages.RawRefused(RawReason.NO_START, 0, 0):
            raise CheckFailed(f"the reply is {reply}")


@dataclass(frozen=True, slots=True)
class MovesOn:
    """Send a download of so many points, or of these, which must be executed."""

    count: int = 4
    points: Sequence[Point] | None = field(default=None, repr=False)

    def play(self, run: Run) -> None:
        run.trajectory += 1
        points = self.points or run.bench.wave(self.count, duration=0.2)
        run.bench.assert_moves_through(run.link, points)


@dataclass(frozen=True, slots=True)
class Reconnect:
    """Close the connection and open another one; the next stream or program has the number 1."""

    then: float = 1.5
    abort: bool = False

    def play(self, run: Run) -> None:
        run.link.close(abort=self.abort, then=self.then)
        run.connect()


@dataclass(frozen=True, slots=True)
class Disconnect:
    """Reset the connection (RST), or close it (FIN)."""

    abort: bool = True

    def play(self, run: Run) -> None:
        run.link.close(abort=self.abort)


@dataclass(frozen=True, slots=True)
class Disconnected:
    """The driver closes the connection."""

    seconds: float = 2

    def play(self, run: Run) -> None:
        run.link.wait_disconnected(self.seconds, "the client is disconnected")


# -- operator, controller and time -------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Operator:
    """The operator does something."""

    action: str

    def play(self, run: Run) -> None:
        run.bench.controller.perform(self.action)


@dataclass(frozen=True, slots=True)
class StartAgain:
    """The operator resets what stopped the robot, and starts the program."""

    def play(self, run: Run) -> None:
        run.bench.start_again()


@dataclass(frozen=True, slots=True)
class SetSignal:
    """The operator or another device sets a signal."""

    name: str
    value: float

    def play(self, run: Run) -> None:
        run.bench.controller.signals[self.name] = self.value


@dataclass(frozen=True, slots=True)
class Fails:
    """An instruction of a task fails once, after so many calls that succeed."""

    module: str
    instruction: str
    error: str = "ERR_OUTOFBND"
    after: int = 0

    def play(self, run: Run) -> None:
        run.working = fails(run.bench, self.module, self.instruction, self.error, after=self.after)


@dataclass(frozen=True, slots=True)
class Works:
    """The instruction works again."""

    def play(self, run: Run) -> None:
        run.working()


@dataclass(frozen=True, slots=True)
class Call:
    """Do something to the controller that no client can do."""

    act: Callable[[], object] = field(repr=False)
    what: str = ""

    def play(self, run: Run) -> None:
        self.act()


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """Play steps on another controller."""

    system: System = field(repr=False)
    make: Callable[[Bench], Iterable[Step]] = field(repr=False)

    def play(self, run: Run) -> None:
        with run.bench.second_controller(self.system) as other:
            play(other, self.make(other))


@dataclass(frozen=True, slots=True)
class Pass:
    """Let time pass."""

    seconds: float

    def play(self, run: Run) -> None:
        run.bench.run(self.seconds)


# -- what is observed --------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Moving:
    """The robot begins to move."""

    within: float = 5

    def play(self, run: Run) -> None:
        run.bench.wait_until_moving(self.within)


@dataclass(frozen=True, slots=True)
class Standing:
    """The robot comes to rest."""

    within: float = 5

    def play(self, run: Run) -> None:
        run.bench.wait_until_standing(self.within)


@dataclass(frozen=True, slots=True)
class Rest:
    """The robot does not move for so many seconds."""

    seconds: float

    def play(self, run: Run) -> None:
        run.bench.assert_at_rest(self.seconds, "the robot must stand")


@dataclass(frozen=True, slots=True)
class At:
    """The robot comes to rest at a point of the way, and was at all before it."""

    index: int = -1
    within: float = 20

    def play(self, run: Run) -> None:
        run.bench.wait_until_at(run.way[self.index][0], self.within)
        last = self.index % len(run.way)
        run.bench.executed(run.way[: last + 1], run.since)


@dataclass(frozen=True, slots=True)
class Executed:
    """The robot was at no other place than on these points; `complete`: it is at the last one."""

    points: int | None = None
    """Number of points from the beginning; by default all."""
    complete: bool = False

    def play(self, run: Run) -> None:
        points = run.way[: self.points]
        run.bench.executed(points, run.since)
        if self.complete and distance(run.bench.position, points[-1][0]) > _MILLIMETRE:
            raise CheckFailed("points that were accepted are not executed")


@dataclass(frozen=True, slots=True)
class NotAt:
    """The robot has stopped before this point of the way."""

    index: int

    def play(self, run: Run) -> None:
        if distance(run.bench.position, run.way[self.index][0]) < _MILLIMETRE / 10:
            raise CheckFailed("the robot has gone on to the last point")


@dataclass(frozen=True, slots=True)
class Took:
    """The way has lasted so long, s."""

    least: float
    most: float

    def play(self, run: Run) -> None:
        seconds = run.bench.now - run.since
        if not self.least <= seconds <= self.most:
            raise CheckFailed(f"it took {seconds:.2f} s")


@dataclass(frozen=True, slots=True)
class Stayed:
    """The robot has stood at a point of the way."""

    index: int

    def play(self, run: Run) -> None:
        place = run.way[self.index][0]
        if not any(t > run.since and distance(p, place) < 1e-4 for t, p in run.bench.track):
            raise CheckFailed("the robot was not where it had to stay")


@dataclass(frozen=True, slots=True)
class Progress:
    """PROGRESS of the newest trajectory.

    `counts`: points received, planned and reached, as far as given.
    """

    state: RawTrajectoryState
    reason: RawReason | tuple[RawReason, ...] = RawReason.NONE
    counts: tuple[int, ...] = ()
    fault: tuple[int, int] | None = None
    """Faulty point and joint."""

    def play(self, run: Run) -> None:
        run.pause()
        seen = run.bench.progress(run.watcher)
        reasons = self.reason if isinstance(self.reason, tuple) else (self.reason,)
        if (
            (seen.trajectory, seen.state) != (run.trajectory, self.state)
            or seen.reason not in reasons
            or seen[2 : 2 + len(self.counts)] != self.counts
            or self.fault not in (None, (seen.point, seen.joint))
        ):
            raise CheckFailed(f"trajectory {run.trajectory}, PROGRESS says {seen}")


@dataclass(frozen=True, slots=True)
class Status:
    """STATUS: the reason of an error, 0 without one; the robot stands."""

    reason: RawReason = RawReason.NONE

    def play(self, run: Run) -> None:
        seen = run.bench.status(run.watcher)
        error = int(self.reason is not RawReason.NONE)
        if (seen.in_motion, seen.in_error, seen.error_code % 100) != (0, error, self.reason):
            raise CheckFailed(f"STATUS says {seen}")


@dataclass(frozen=True, slots=True)
class Logged:
    """The event log contains the text of a reason."""

    reason: RawReason

    def play(self, run: Run) -> None:
        run.bench.run(0.05)
        text = messages.text_of(self.reason)
        if not any(text in " ".join(event.texts) for event in run.bench.controller.log):
            raise CheckFailed(f"the event log does not say: {text}")


@dataclass(frozen=True, slots=True)
class NotLogged:
    """No event with this number since the way began."""

    code: int

    def play(self, run: Run) -> None:
        if any(e.code == self.code and e.time > run.since for e in run.bench.controller.log):
            raise CheckFailed(f"the event log contains {self.code}")


@dataclass(frozen=True, slots=True)
class SignalIs:
    """A signal of the controller has a value."""

    name: str
    value: float

    def play(self, run: Run) -> None:
        value = run.bench.controller.signals[self.name]
        if value != self.value:
            raise CheckFailed(f"it is {value}")


@dataclass(frozen=True, slots=True)
class Healthy:
    """No task of the driver has ended."""

    def play(self, run: Run) -> None:
        run.bench.assert_healthy()
