"""The partner's side of a session, without clock and sockets: one answer to each frame.

The controller does not say whether it guides joints or the TCP, so a session is made for one of
them. Guidance of joints answers with the robot's position until there is a target. Guidance of the
TCP answers without a pose until then: the frame in which the controller expects poses
(`SensorFrame`) is known to its program only, and a position that is repeated in another frame would
be a motion.
"""

from bisect import bisect_right
from dataclasses import dataclass, field, replace
from math import degrees
from typing import Literal, TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.client.egm.envelope import Envelope, Joints
from rapidgen.client.egm.reference import PoseReference, Reference, Twist, rotated
from rapidgen.client.pose import Pose
from rapidgen.wire.egm.codec import decode_robot, encode_sensor
from rapidgen.wire.egm.values import (
    AxisPositions,
    CartesianPose,
    EgmMessageError,
    RapidData,
    RobotMessage,
    SensorMessage,
)

Guidance: TypeAlias = Literal["joints", "pose"]
CYCLE = 0.004
"""s between two frames, nominally."""
SILENCE = 0.5
"""s without a frame after which guidance has ended: a controller does not announce that."""


@dataclass(frozen=True, slots=True)
class Target:
    """Where the robot shall be, and how fast it shall move on from there.

    Without joints and pose it shall take over the speeds. `at`: s on the caller's clock. `lasts`: s
    after `at` for which it is in force; then the robot slows down, stays, and waits for the next
    one. None: until the session's time-out, after which no target is executed any more.
    """

    at: float
    joints: Joints | None = None
    pose: Pose | None = None
    speeds: Joints | None = None
    lasts: float | None = None


@dataclass(frozen=True, slots=True)
class Path:
    """A trajectory that begins at once: times in s from its start, and positions.

    With velocities it is a cubic spline, else lines between the points. It is followed from the
    time `since` on, from the present reference if the first point is later. A last velocity is
    slowed down after the end.
    """

    times: tuple[float, ...]
    positions: tuple[Joints, ...]
    velocities: tuple[Joints, ...] | None = None
    since: float = 0.0

    @property
    def ends_moving(self) -> bool:
        """True if its last velocity is not zero."""
        return self.velocities is not None and any(self.velocities[-1])


@dataclass(frozen=True, slots=True)
class Stop:
    """Slow down and stay."""


Order: TypeAlias = Target | Path | Stop | RapidData
"""RAPID data are part of every answer from then on."""


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
    """As the answer had them; guidance of the TCP repeats the measured ones."""
    guided: bool
    """True while the controller executes answers; False again at the end, see `ended`."""
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
    controller_time: float = 0.0
    """s on the clock of the controller."""
    pose: Pose | None = None
    """TCP in the work object of EGMAct, as measured; None: the controller does not send it."""
    reference_pose: Pose | None = None
    """As the answer had it; None: it had no pose."""
    data: RapidData | None = None
    """Of the RAPID program (`\\DOtoSensor`, `\\DataToSensor`)."""
    release: tuple[int, int] = (0, 0)
    """Earliest RobotWare that sends the fields of the frame."""
    answer_time: float = 0.0
    """s from the arrival of the frame to the answer, in this computer."""
    ended: str = ""
    """Why guidance has ended; empty: it has not begun, or lasts."""


@dataclass(slots=True)
class PartnerExchange:
    """Answers frames of a controller."""

    map: JointMap
    envelope: Envelope
    timeout: float
    """s without a target after which the robot stops."""
    guidance: Guidance = "joints"
    sequence: int = 0
    reference: Reference | None = None
    pose_reference: PoseReference | None = None
    stopped: bool = False
    target: Target | None = None
    data: RapidData | None = None
    missed: int = 0
    ended: str = ""
    """Why guidance has ended; empty: it has not begun, or lasts."""
    _path: Path | None = None
    _path_time: float = 0.0
    _last: int = -1
    _last_time: float = 0.0
    _message: RobotMessage | None = None
    _joints: Joints = ()
    _now: float = 0.0
    _age: float | None = None
    _sent_pose: Pose | None = field(default=None)

    def execute(self, order: Order) -> None:
        """Take an order of the caller; the newest target counts."""
        match order:
            case Stop():
                self.stopped = True
            case Path():
                # Its end needs no further target: the robot stays there.
                self._path, self._path_time, self.target = self._begun(order), order.since, None
            case RapidData():
                self.data = order
            case Target():
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
        if guided:
            self.ended = ""
        elif self.is_guided:
            self.ended = "the controller has ended the run"
        self._last, cycle = message.sequence, self._cycle(message)
        age = None if self.target is None else now - self.target.at
        if guided:
            self._advance(message, joints, cycle, age)
        self._message, self._joints, self._now, self._age = message, joints, now, age
        return self._encode(joints)

    @property
    def is_guided(self) -> bool:
        """True while the controller executes answers, as far as the frames show it."""
        message = self._message
        return message is not None and message.state == "running" and not self.ended

    def miss_frames(self) -> None:
        """End guidance: no frame has come for `SILENCE`. A later one of the same run resumes it."""
        self.ended = f"no frame for {SILENCE:g} s"

    def state(self, answer_time: float = 0.0) -> EgmState:
        """Return the state after the last answer; apart from it, so that answers are early."""
        message, reference = self._message, self.reference
        assert message is not None
        return EgmState(
            time=self._now,
            joints=self._joints,
            planned=self._urdf(message.planned.joints, message.planned.external),
            reference=self._joints if reference is None else reference.positions,
            guided=self.is_guided,
            motors_on=message.motors_on,
            program_runs=message.program_runs,
            converged=message.converged,
            stopped=self.stopped,
            utilization=message.utilization or 0.0,
            sequence=message.sequence,
            missed=self.missed,
            age=self._age,
            remaining=0.0 if self._path is None else self._path.times[-1] - self._path_time,
            controller_time=message.milliseconds / 1000,
            pose=_pose(message.measured),
            reference_pose=self._sent_pose,
            data=message.data,
            release=_release(message),
            answer_time=answer_time,
            ended=self.ended,
        )

    def _begin(self, joints: Joints) -> None:
        self.reference = Reference(self.envelope, joints) if self.guidance == "joints" else None
        self.pose_reference = None
        self.target, self.stopped, self.missed = None, False, 0
        self._path, self._last = None, -1

    def _cycle(self, message: RobotMessage) -> float:
        """Return the time since the frame before, s; a new session has the nominal one."""
        time, before = message.milliseconds / 1000, self._last_time
        self._last_time = time
        return time - before if 0 < time - before <= 0.1 else CYCLE

    # -- references -------------------------------------------------------------------------

    def _advance(
        self, message: RobotMessage, joints: Joints, cycle: float, age: float | None
    ) -> None:
        target = self.target
        if target is not None and age is not None and self._path is None:
            if target.lasts is None and age > self.timeout:
                self.stopped = True
            elif target.lasts is not None and age > target.lasts:
                target = self.target = None
        if self.guidance == "joints":
            if self.reference is None:
                self.reference = Reference(self.envelope, joints)
            self._advance_joints(self.reference, target, cycle, age or 0.0)
            return
        pose = self.pose_reference
        if pose is None and target is not None and not self.stopped:
            start = _pose(message.planned) or _pose(message.measured)
            if start is None:
                raise EgmMessageError("the controller sends no pose")
            pose = self.pose_reference = PoseReference(self.envelope.tcp, start)
        if pose is not None:
            self._advance_pose(pose, target, cycle, age or 0.0)

    def _advance_joints(
        self, reference: Reference, target: Target | None, cycle: float, age: float
    ) -> None:
        path = self._path
        if self.stopped:
            reference.brake(cycle)
        elif path is not None:
            self._path_time = min(self._path_time + cycle, path.times[-1])
            if self._path_time >= path.times[-1] and path.ends_moving:
                self._path = None
                reference.brake(cycle)
                return
            reference.follow(*_at(path, self._path_time, cycle))
            has_arrived = reference.positions == path.positions[-1] and reference.is_standing
            if self._path_time >= path.times[-1] and has_arrived:
                self._path = None
        elif target is None:
            reference.brake(cycle)
        elif target.joints is not None:
            rates = target.speeds
            moved = target.joints
            if rates is not None:
                moved = tuple(q + v * age for q, v in zip(moved, rates, strict=True))
            reference.follow(moved, cycle, rates)
        elif target.speeds is not None:
            reference.drive(target.speeds, cycle)

    def _begun(self, path: Path) -> Path:
        """Return a path from the present reference, if its first point is later."""
        reference = self.reference
        if reference is None or path.times[0] <= path.since:
            return path
        speeds = reference.speeds
        return replace(
            path,
            times=(path.since, *path.times),
            positions=(reference.positions, *path.positions),
            velocities=path.velocities and (speeds, *path.velocities),
        )

    def _advance_pose(
        self, reference: PoseReference, target: Target | None, cycle: float, age: float
    ) -> None:
        if self.stopped or target is None:
            reference.brake(cycle)
        elif target.pose is not None:
            pose = target.pose
            if target.speeds is not None:
                pose = _moved(pose, target.speeds, age)
            reference.follow(pose, cycle, target.speeds)
        elif target.speeds is not None:
            reference.drive(target.speeds, cycle)

    def _urdf(self, joints: tuple[float, ...], external: tuple[float, ...]) -> Joints:
        robax = (*joints, *(0.0,) * (6 - len(joints)))
        extax = (*external, *(ABSENT,) * (6 - len(external)))
        return self.map.to_urdf(self.map.from_rapid(robax, extax, (0.0,) * len(self.map.joints)))

    # -- answers ----------------------------------------------------------------------------

    def _encode(self, measured: Joints) -> bytes:
        self.sequence += 1
        self._sent_pose = None
        if self.guidance == "pose":
            return encode_sensor(self._pose_message())
        reference = self.reference
        positions = measured if reference is None else reference.positions
        joints, external = self.map.to_rapid(self.map.to_controller(positions))
        none = (0.0,) * len(measured)
        rates = self.map.rates_to_controller(none if reference is None else reference.speeds)
        speeds, external_speeds = self.map.to_rapid(rates)
        present = tuple(v for v in external if v < ABSENT / 2)
        return encode_sensor(
            SensorMessage(
                sequence=self.sequence,
                joints=joints,
                external=present or None,
                joint_speeds=speeds,
                external_speeds=external_speeds[: len(present)] or None,
                data=self.data,
            )
        )

    def _pose_message(self) -> SensorMessage:
        reference = self.pose_reference
        if reference is None:
            return SensorMessage(sequence=self.sequence, data=self.data)
        self._sent_pose = Pose(*reference.pose)
        (x, y, z), orientation = reference.pose
        linear, angular = reference.speeds[:3], reference.speeds[3:]
        return SensorMessage(
            sequence=self.sequence,
            pose=CartesianPose((x * 1000, y * 1000, z * 1000), orientation),
            cartesian_speeds=(*(v * 1000 for v in linear), *map(degrees, angular)),
            data=self.data,
        )


def _pose(positions: AxisPositions) -> Pose | None:
    """Return a pose of a message in m."""
    if positions.pose is None:
        return None
    x, y, z = positions.pose.position
    return Pose((x / 1000, y / 1000, z / 1000), positions.pose.orientation)


def _release(message: RobotMessage) -> tuple[int, int]:
    if message.data is not None:
        return 7, 7
    if message.move_index is not None or message.collision is not None:
        return 7, 6
    if message.utilization is not None:
        return 6, 10
    return (6, 7) if message.measured.time is not None else (0, 0)


def _moved(pose: Pose, speeds: Twist, time: float) -> Pose:
    """Return a pose that has moved on for a time in s."""
    vx, vy, vz, wx, wy, wz = (v * time for v in speeds)
    return Pose(frames.add(pose[0], (vx, vy, vz)), rotated(pose[1], (wx, wy, wz)))


def _at(path: Path, time: float, cycle: float) -> tuple[Joints, float, Joints | None]:
    """Return the arguments of `Reference.follow` at a time of a path; at its end it stands."""
    if time >= path.times[-1] or len(path.times) == 1:
        return path.positions[-1], cycle, None
    positions, velocities = sample(path, time)
    return positions, cycle, velocities


def sample(path: Path, time: float) -> tuple[Joints, Joints]:
    """Return positions and velocities of a path of two points or more."""
    after = max(1, min(bisect_right(path.times, time), len(path.times) - 1))
    first, last = path.times[after - 1], path.times[after]
    span = last - first
    part = max(0.0, min(1.0, (time - first) / span))
    pairs = list(zip(path.positions[after - 1], path.positions[after], strict=True))
    if path.velocities is None:
        positions = tuple(q + (end - q) * part for q, end in pairs)
        return positions, tuple((end - q) / span for q, end in pairs)
    rates = list(zip(path.velocities[after - 1], path.velocities[after], strict=True))
    # Cubic Hermite polynomials of each joint.
    s, s2, s3 = part, part * part, part * part * part
    values = [
        (
            (2 * s3 - 3 * s2 + 1) * p
            + (3 * s2 - 2 * s3) * q
            + ((s3 - 2 * s2 + s) * v + (s3 - s2) * w) * span,
            (6 * s2 - 6 * s) * (p - q) / span + (3 * s2 - 4 * s + 1) * v + (3 * s2 - 2 * s) * w,
        )
        for (p, q), (v, w) in zip(pairs, rates, strict=True)
    ]
    return tuple(value for value, _ in values), tuple(rate for _, rate in values)
