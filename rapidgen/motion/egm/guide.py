"""A robot under guidance: references of a partner in, postures out, without I/O and clock.

The same object runs in lock-step with the virtual clock and in the process that serves a partner in
real time, so it contains values only and can be pickled.
"""

from collections import deque
from dataclasses import dataclass
from math import radians
from typing import Final, Literal, TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose, Vector
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.motion.egm.law import CYCLE, Brake, Law, Line, Return, braking_time, slowed
from rapidgen.wire.egm.values import AxisPositions, CartesianPose, SensorMessage

Mode: TypeAlias = Literal["Joint", "Pose"]
JOINT_NAMES: Final = ("J1", "J2", "J3", "J4", "J5", "J6", "J7")
POSE_NAMES: Final = ("x", "y", "z", "rx", "ry", "rz")
_AXES: Final = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6", "eax_a")
"""Of J1 to J7: the seventh is eax_a of an arm with seven axes (manual 3HAC073318, 5.4.3)."""
_ATTEMPTS: Final = 8
"""To slow the TCP down until no axis is too fast."""


class OutOfBounds(Exception):
    """A guided axis would leave its range or deviation, or no posture reaches the pose."""


@dataclass(frozen=True, slots=True)
class GuidedRobot:
    """What guidance needs to know of a robot."""

    map: JointMap
    kinematics: Kinematics | None
    lower: Posture
    upper: Posture
    dead_time: float = 0.016
    """s between an order and the motion."""
    any_cycle: bool = False
    """True if cycles without a message count for the condition time, too."""


@dataclass(frozen=True, slots=True)
class Activation:
    """EGMActJoint or EGMActPose. Lengths are m, angles rad."""

    mode: Mode
    bandwidth: float = 20.0
    """Hz"""
    sample_time: float = CYCLE
    """s between messages."""
    max_deviation: float = radians(1000.0)
    max_speed: float = radians(1.0)
    convergence: tuple[tuple[float, float], ...] = ()
    """Lower and upper limit of each axis, or of x, y, z, rx, ry and rz."""
    tool: Pose = IDENTITY
    object: Pose = IDENTITY
    """In the robot's base."""
    correction: Pose = IDENTITY
    """Frame of corrections, in the robot's base (Pose)."""
    sensor: Pose = IDENTITY
    """Frame of received poses, in the robot's base (Pose)."""


@dataclass(frozen=True, slots=True)
class Run:
    """EGMRunJoint or EGMRunPose."""

    axes: tuple[str, ...]
    """Chosen ones, of JOINT_NAMES or POSE_NAMES."""
    gain: float
    """1/s"""
    hold: bool = True
    """It stays where it ends (EGM_STOP_HOLD), or returns to its start."""
    condition_time: float = 1.0
    ramp_in: float = 0.0
    ramp_out: float = 0.5
    offset: Pose = IDENTITY


class Guide:
    """Guidance from a standstill to the next one.

    Args:
        robot: The robot.
        activation: What EGMAct demands.
        run: What EGMRun demands.
        start: Where the robot stands.
        origin: Where the run began, before a stop of the program: deviations count from there.
    """

    def __init__(
        self,
        robot: GuidedRobot,
        activation: Activation,
        run: Run,
        start: Posture,
        origin: Posture | None = None,
    ) -> None:
        self.robot, self.activation, self.run = robot, activation, run
        self.origin = start if origin is None else origin
        self.ordered: Posture = start
        self.position: Posture = start
        """Where the robot is, behind `ordered` by the dead time."""
        self._rates: Posture = (0.0,) * len(start)
        self._way: Brake | Return | None = None
        self._delay: deque[Posture] = deque([start] * round(robot.dead_time / CYCLE))
        self._converged_for = 0.0
        self.received = False
        """True from the first message with a reference on."""
        self.utilization = 0.0
        """Per cent of the highest speed that the last cycle would have needed."""
        if activation.mode == "Joint":
            names = dict(zip(JOINT_NAMES, _AXES, strict=True))
            chosen = {names[axis] for axis in run.axes}
            self._chosen = tuple(joint.axis in chosen for joint in robot.map.joints)
            origin = start
        else:
            self._chosen = tuple(name in run.axes for name in POSE_NAMES)
            origin = (0.0,) * 6
            self._tcp = self.tcp(start)
        self._law = Law(origin, run.gain, activation.bandwidth, run.ramp_in)
        self._reference: Posture = origin
        self._speeds: Posture = (0.0,) * len(origin)

    @property
    def reference(self) -> Posture | None:
        """Where the partner wants the axes to be; None in mode Pose, and before a message."""
        joint_mode = self.activation.mode == "Joint"
        return self._reference if joint_mode and self.received else None

    # -- references -------------------------------------------------------------------------

    def read(self, message: SensorMessage) -> bool:
        """Take the reference of a message; False: it has none for the active mode."""
        result = self._read_joints if self.activation.mode == "Joint" else self._read_pose
        if not result(message):
            return False
        self.received = True
        return True

    def _read_joints(self, message: SensorMessage) -> bool:
        if message.joints is None and message.joint_speeds is None:
            return False
        reference = list(self._reference)
        speeds = [0.0] * len(reference)
        for values, target in (
            (_slots(message.joints, message.external), reference),
            (_slots(message.joint_speeds, message.external_speeds), speeds),
        ):
            for i, joint in enumerate(self.robot.map.joints):
                value = values.get(joint.axis)
                if value is not None and self._chosen[i]:
                    target[i] = value / self.robot.map.unit_of(i)[1]
        self._reference, self._speeds = tuple(reference), tuple(speeds)
        return True

    def _read_pose(self, message: SensorMessage) -> bool:
        if message.pose is None and message.cartesian_speeds is None:
            return False
        activation = self.activation
        if message.pose is not None:
            x, y, z = message.pose.position
            sent: Pose = ((x / 1000, y / 1000, z / 1000), message.pose.orientation)
            sent = frames.compose(self.run.offset, sent)
            self._reference = self._masked(
                self._coordinates(frames.compose(activation.sensor, sent))
            )
        speeds: Posture = (0.0,) * 6
        if message.cartesian_speeds is not None:
            v = message.cartesian_speeds
            linear: Vector = (v[0] / 1000, v[1] / 1000, v[2] / 1000)
            angular: Vector = (radians(v[3]), radians(v[4]), radians(v[5]))
            turn = frames.within(activation.correction, activation.sensor)[1]
            speeds = self._masked((*frames.rotate(turn, linear), *frames.rotate(turn, angular)))
        self._speeds = speeds
        return True

    def _masked(self, values: Posture) -> Posture:
        return tuple(v if c else 0.0 for v, c in zip(values, self._chosen, strict=True))

    # -- poses ------------------------------------------------------------------------------

    def tcp(self, posture: Posture) -> Pose:
        """Return the TCP in the robot's base. OutOfBounds: a robot without geometry."""
        if self.robot.kinematics is None:
            raise OutOfBounds("the robot has no geometry")
        return frames.compose(self.robot.kinematics.forward(posture), self.activation.tool)

    def _coordinates(self, pose: Pose) -> Posture:
        """Return the way from the start to a pose, in the frame of corrections."""
        back = frames.conjugate(self.activation.correction[1])
        moved = frames.rotate(back, frames.subtract(pose[0], self._tcp[0]))
        axis, angle = frames.to_axis(frames.multiply(pose[1], frames.conjugate(self._tcp[1])))
        return (*moved, *frames.rotate(back, frames.scale(axis, angle)))

    def _pose(self, coordinates: Posture) -> Pose:
        """Return the TCP; inverse of `_coordinates`."""
        turn = self.activation.correction[1]
        x, y, z, rx, ry, rz = coordinates
        place = frames.add(self._tcp[0], frames.rotate(turn, (x, y, z)))
        vector = frames.rotate(turn, (rx, ry, rz))
        angle = frames.norm(vector)
        if angle < 1e-12:
            return place, self._tcp[1]
        rotation = frames.about(frames.scale(vector, 1 / angle), angle)
        return place, frames.multiply(rotation, self._tcp[1])

    def _posture(self, coordinates: Posture) -> Posture:
        kinematics = self.robot.kinematics
        assert kinematics is not None
        flange = frames.compose(self._pose(coordinates), frames.invert(self.activation.tool))
        result = kinematics.follow(flange, self.ordered)
        if result is None:
            raise OutOfBounds("no posture of this configuration reaches the pose")
        return result

    # -- cycles -----------------------------------------------------------------------------

    def cycle(self) -> Posture:
        """Execute a cycle; return where the robot is at its end.

        OutOfBounds: nothing was executed.
        """
        before = self.ordered
        self.utilization = 0.0
        if self._way is not None:
            # In its last cycle before a bound an axis may be too fast to brake.
            self.ordered = self._within(self._way.advance(CYCLE))
        elif self.received:
            self._follow()
        self._rates = tuple((q - p) / CYCLE for q, p in zip(self.ordered, before, strict=True))
        self._delay.append(self.ordered)
        self.position = self._delay.popleft()
        return self.position

    def _follow(self) -> None:
        law = self._law
        positions, speeds = law.propose(self._reference, self._speeds)
        joint_mode = self.activation.mode == "Joint"
        postures = positions if joint_mode else self._posture(positions)
        self.utilization = 100 * self._fastest(postures) / self.activation.max_speed
        for _ in range(_ATTEMPTS):
            fastest = self._fastest(postures)
            if fastest <= self.activation.max_speed * (1 + 1e-9):
                break
            ratio = self.activation.max_speed / fastest
            positions, speeds = slowed(law.positions, positions, speeds, ratio)
            # Half the way of the TCP is not exactly half the way of the axes.
            postures = positions if joint_mode else self._posture(positions)
        else:
            raise OutOfBounds("close to a singularity")
        self._check(postures)
        law.accept(positions, speeds)
        self.ordered = postures

    def _fastest(self, postures: Posture) -> float:
        """Return the highest speed of an axis in a cycle that ends there."""
        pairs = zip(postures, self.ordered, strict=True)
        return max(abs(q - p) for q, p in pairs) / CYCLE

    def _bounds(self, axis: int) -> tuple[float, float]:
        robot, start = self.robot, self.origin[axis]
        deviation = self.activation.max_deviation
        return max(robot.lower[axis], start - deviation), min(robot.upper[axis], start + deviation)

    def _within(self, postures: Posture) -> Posture:
        """Return the posture with each axis kept within its bounds."""
        result = []
        for i, (q, p) in enumerate(zip(postures, self.ordered, strict=True)):
            low, high = self._bounds(i)
            result.append(max(min(low, p), min(q, max(high, p))))
        return tuple(result)

    def _check(self, postures: Posture) -> None:
        for i, (q, p) in enumerate(zip(postures, self.ordered, strict=True)):
            low, high = self._bounds(i)
            # An axis that begins outside of its range may come back.
            if not min(low, p) <= q <= max(high, p):
                joint = self.robot.map.joints[i]
                unit, size = self.robot.map.unit_of(i)
                raise OutOfBounds(
                    f"{joint.axis} would be at {q * size:.2f} {unit}, "
                    f"allowed are {low * size:.2f} to {high * size:.2f}"
                )

    # -- end --------------------------------------------------------------------------------

    def leave(self, *, hold: bool, ramp_out: float) -> None:
        """End as a stop mode demands, within a time in s."""
        if hold:
            self.hold(ramp_out)
        else:
            self.return_to_start(ramp_out)

    def hold(self, ramp_out: float) -> None:
        """Reduce the speed to zero within a time in s (EGM_STOP_HOLD).

        The time is shorter if an axis would leave its bounds. A stop that takes longer is replaced.
        """
        if self._way is None or self._way.left > ramp_out:
            self._way = Brake(self.ordered, self._rates, self._braking_time(ramp_out))

    def return_to_start(self, ramp_out: float) -> None:
        """Brake and go back to the start within a time in s (EGM_STOP_RAMP_DOWN).

        It takes longer if the speed limit requires it.
        """
        if self._way is not None:
            return
        brake = Brake(self.ordered, self._rates, self._braking_time(ramp_out / 4))
        rest = brake.end()
        distance = max(abs(q - s) for q, s in zip(rest, self.origin, strict=True))
        # The line is at most 1.5 times as fast as its mean.
        time = max(ramp_out * 0.75, 1.5 * distance / self.activation.max_speed)
        self._way = Return(brake, Line(rest, self.origin, time))

    def _braking_time(self, time: float) -> float:
        room = []
        for i, q in enumerate(self.ordered):
            low, high = self._bounds(i)
            room.append((q - low, high - q))
        return braking_time(self._rates, room, time)

    @property
    def is_stopping(self) -> bool:
        """True from `hold` or `return_to_start` on."""
        return self._way is not None

    @property
    def is_standing(self) -> bool:
        """True if a stop is done and the robot is where it ends."""
        return self._way is not None and self._way.done and self.position == self.ordered

    # -- convergence ------------------------------------------------------------------------

    @property
    def in_tolerance(self) -> bool:
        """True if all chosen axes are as close to the reference as EGMAct demands."""
        if not self.received:
            return False
        limits = self.activation.convergence
        deviations = (r - p for r, p in zip(self._reference, self._law.positions, strict=True))
        return all(
            not chosen or low <= deviation <= high
            for deviation, (low, high), chosen in zip(deviations, limits, self._chosen, strict=True)
        )

    def count(self, *, fresh: bool) -> bool:
        """Count a cycle towards the condition time; return True if it is over.

        Without `any_cycle` only cycles with a new message count: a GoFa (7.21) with a silent
        partner never ended.
        """
        if not self.in_tolerance:
            self._converged_for = 0.0
        elif fresh or self.robot.any_cycle:
            self._converged_for += CYCLE
        return self._converged_for >= self.run.condition_time - CYCLE / 2


def _slots(
    joints: tuple[float, ...] | None, external: tuple[float, ...] | None
) -> dict[str, float]:
    """Return received values by axis."""
    result = {f"rax_{i}": v for i, v in enumerate(joints or (), start=1)}
    result |= {f"eax_{letter}": v for letter, v in zip("abcdef", external or (), strict=False)}
    return result


def axis_positions(
    robot: GuidedRobot, activation: Activation, posture: Posture, time: float
) -> AxisPositions:
    """Return a posture as a message has it: degrees and mm, the TCP in the work object."""
    joints, external = robot.map.to_rapid(posture)
    pose = None
    if robot.kinematics is not None:
        tcp = frames.compose(robot.kinematics.forward(posture), activation.tool)
        (x, y, z), q = frames.within(activation.object, tcp)
        pose = CartesianPose((x * 1000, y * 1000, z * 1000), q)
    return AxisPositions(joints, tuple(v for v in external if v < ABSENT / 2), pose, time)
