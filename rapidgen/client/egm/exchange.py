"""The partner's side of a session, without clock and sockets: one answer to each frame."""

from bisect import bisect_right
from dataclasses import dataclass

from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.client.egm.envelope import Envelope, Joints, Reference
from rapidgen.wire.egm.codec import decode_robot, encode_sensor
from rapidgen.wire.egm.values import RobotMessage, SensorMessage

CYCLE = 0.004
"""s between two frames, nominally."""


@dataclass(frozen=True, slots=True)
class Target:
    """Where the robot shall be; `at` is the time on the caller's clock, s."""

    joints: Joints
    at: float


@dataclass(frozen=True, slots=True)
class Path:
    """A trajectory that begins at once: times in s from its start, and positions."""

    times: tuple[float, ...]
    positions: tuple[Joints, ...]


@dataclass(frozen=True, slots=True)
class Stop:
    """Slow down and stay."""


@dataclass(frozen=True, slots=True)
class EgmState:
    """State of a session, from the last frame. Positions are rad and m in URDF order."""

    time: float
    """s on the clock of the computer, when the frame was answered."""
    joints: Joints
    """As measured."""
    planned: Joints
    """As the controller orders them."""
    reference: Joints
    """As the answer had them."""
    guided: bool
    """True while the controller executes answers."""
    motors_on: bool
    program_runs: bool
    converged: bool
    stopped: bool
    """True after a stop, until guidance begins anew: targets are not executed."""
    utilization: float
    """Per cent."""
    sequence: int
    missed: int
    """Frames of the session without an answer: a newer one was there already."""
    age: float | None
    """s between the newest target and the answer; None: no target."""
    remaining: float = 0.0
    """s of a trajectory that is followed."""


@dataclass(slots=True)
class PartnerExchange:
    """Answers frames of a controller."""

    map: JointMap
    envelope: Envelope
    timeout: float
    """s without a target after which the robot stops."""
    sequence: int = 0
    reference: Reference | None = None
    stopped: bool = False
    target: Target | None = None
    missed: int = 0
    _path: Path | None = None
    _path_time: float = 0.0
    _last: int = -1
    _last_time: float = 0.0
    _message: RobotMessage | None = None
    _joints: Joints = ()
    _now: float = 0.0
    _age: float | None = None

    def execute(self, order: Target | Path | Stop) -> None:
        """Take an order of the caller; the newest target counts."""
        if isinstance(order, Stop):
            self.stopped = True
        elif isinstance(order, Path):
            self._path, self._path_time = order, 0.0
        else:
            self.target, self._path = order, None

    def answer(self, frame: bytes, now: float) -> bytes:
        """Return the answer to a frame. EgmMessageError: it is no frame."""
        message = decode_robot(frame)
        joints = self._urdf(message.measured.joints, message.measured.external)
        guided = message.state == "running"
        if message.sequence <= self._last or not guided:
            # A new session, or none: what was sent before does not count any more.
            self._begin(joints)
        else:
            self.missed += message.sequence - self._last - 1
        self._last, cycle = message.sequence, self._cycle(message)
        reference = self.reference
        if reference is None:
            reference = self.reference = Reference(self.envelope, joints)
        age = None if self.target is None else now - self.target.at
        if guided:
            self._advance(reference, cycle, age)
        self._message, self._joints, self._now, self._age = message, joints, now, age
        return self._encode(reference)

    def state(self) -> EgmState:
        """Return the state after the last answer; apart from it, so that answers are early."""
        message, reference = self._message, self.reference
        assert message is not None
        assert reference is not None
        return EgmState(
            time=self._now,
            joints=self._joints,
            planned=self._urdf(message.planned.joints, message.planned.external),
            reference=reference.positions,
            guided=message.state == "running",
            motors_on=message.motors_on,
            program_runs=message.program_runs,
            converged=message.converged,
            stopped=self.stopped,
            utilization=message.utilization or 0.0,
            sequence=message.sequence,
            missed=self.missed,
            age=self._age,
            remaining=0.0 if self._path is None else self._path.times[-1] - self._path_time,
        )

    def _begin(self, joints: Joints) -> None:
        self.reference = Reference(self.envelope, joints)
        self.target, self.stopped, self.missed = None, False, 0
        self._path, self._last = None, -1

    def _cycle(self, message: RobotMessage) -> float:
        """Return the time since the frame before, s; a new session has the nominal one."""
        time, before = message.milliseconds / 1000, self._last_time
        self._last_time = time
        return time - before if 0 < time - before <= 0.1 else CYCLE

    def _advance(self, reference: Reference, cycle: float, age: float | None) -> None:
        path = self._path
        if self.stopped:
            reference.brake(cycle)
        elif path is not None:
            self._path_time = min(self._path_time + cycle, path.times[-1])
            reference.follow(_at(path, self._path_time), cycle)
            if self._path_time >= path.times[-1] and reference.positions == path.positions[-1]:
                self._path = None
        elif age is not None and age > self.timeout:
            self.stopped = True
            reference.brake(cycle)
        elif self.target is not None:
            reference.follow(self.target.joints, cycle)

    def _urdf(self, joints: tuple[float, ...], external: tuple[float, ...]) -> Joints:
        robax = (*joints, *(0.0,) * (6 - len(joints)))
        extax = (*external, *(ABSENT,) * (6 - len(external)))
        return self.map.to_urdf(self.map.from_rapid(robax, extax, (0.0,) * len(self.map.joints)))

    def _encode(self, reference: Reference) -> bytes:
        joints, external = self.map.to_rapid(self.map.to_controller(reference.positions))
        rates = self.map.rates_to_controller(reference.speeds)
        speeds, external_speeds = self.map.to_rapid(rates)
        present = tuple(v for v in external if v < ABSENT / 2)
        self.sequence += 1
        return encode_sensor(
            SensorMessage(
                sequence=self.sequence,
                joints=joints,
                external=present or None,
                joint_speeds=speeds,
                external_speeds=external_speeds[: len(present)] or None,
            )
        )


def _at(path: Path, time: float) -> Joints:
    """Return the position of a path at a time, on lines between its points."""
    after = min(bisect_right(path.times, time), len(path.times) - 1)
    first, last = path.times[after - 1], path.times[after]
    part = (time - first) / (last - first)
    pairs = zip(path.positions[after - 1], path.positions[after], strict=True)
    return tuple(q + (end - q) * min(1.0, part) for q, end in pairs)
