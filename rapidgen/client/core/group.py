"""One motion group of the client: names, joint map, limits and policy."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from rapidgen.axes.mapping import JointMap
from rapidgen.client.core.frames import Frames, GroupFrames
from rapidgen.client.errors import IncompatibleDriver, NotSupported
from rapidgen.config.model import (
    EgmSettings,
    ExposedSignal,
    GroupConfig,
    Joint,
    RobotConfig,
    TrajectoryPolicy,
    UserDatum,
    UserRoutine,
)
from rapidgen.diagnostics import Diagnostic, error, suggest
from rapidgen.wire.simple_message.mapping import mapping_hash
from rapidgen.wire.simple_message.messages import HelloReply

Array = npt.NDArray[np.float64]

PLAIN_CAPACITY = 100
"""Capacity of abb_driver (MAX_TRAJ_LENGTH), which drops further points."""
_AXES = (*(f"rax_{i}" for i in range(1, 7)), *(f"eax_{letter}" for letter in "abcdef"))


@dataclass(frozen=True)
class Group:
    """Joints in wire order with all data that the checks need."""

    name: str
    map: JointMap
    policy: TrajectoryPolicy
    has_limits: bool = True
    """False if neither the configuration nor the driver gave the limits."""
    signals: tuple[ExposedSignal, ...] = ()
    """Signals that the configuration exposes, in the order of their numbers."""
    routines: tuple[UserRoutine, ...] = ()
    """Procedures that a program may call, in the order of their numbers."""
    data: tuple[UserDatum, ...] = ()
    """PERS that clients may reach, in the order of their numbers."""
    egm: EgmSettings | None = None
    """Externally guided motion; None: none, or unknown."""
    geometry: GroupFrames | None = None
    """Frames of poses; None if unknown."""

    @classmethod
    def of(cls, config: RobotConfig, group: GroupConfig) -> "Group":
        """The group of a configuration."""
        return cls(
            group.name,
            JointMap.of(group),
            config.trajectory,
            signals=tuple(config.signals),
            routines=group.routines,
            data=group.data,
            egm=group.egm,
            geometry=GroupFrames.of(group),
        )

    @classmethod
    def from_hello(cls, hello: HelloReply) -> "Group":
        """Build a group from the answers of a rapidgen driver.

        Joints are called joint_1, joint_2, ...
        """
        joints = tuple(
            Joint(
                name=f"joint_{i + 1}",
                axis=_AXES[i],
                kind="prismatic" if hello.prismatic >> i & 1 else "revolute",
                lower=hello.lower[i],
                upper=hello.upper[i],
                speed=hello.speed[i],
                acceleration=math.inf,
            )
            for i in range(hello.joint_count)
        )
        policy = TrajectoryPolicy(
            capacity=hello.capacity,
            start_tolerance=hello.start_tolerance,
            start_tolerance_linear=hello.start_tolerance_linear,
            min_segment=hello.min_segment,
        )
        return cls("", JointMap(joints), policy)

    @classmethod
    def unknown(cls, names: Sequence[str]) -> "Group":
        """Build a group of unnamed controller axes without known limits."""
        joints = tuple(
            Joint(name, _AXES[i], "revolute", -math.inf, math.inf, math.inf, math.inf)
            for i, name in enumerate(names)
        )
        return cls("", JointMap(joints), TrajectoryPolicy(capacity=PLAIN_CAPACITY), False)

    @property
    def poses(self) -> Frames:
        """The robot's geometry. Raises NotSupported where it is not known."""
        frames = self.geometry.frames() if self.geometry is not None else None
        if frames is None:
            raise NotSupported.because(
                "RG671",
                "the poses of this robot are not known",
                "connect with a configuration that has the robot's chain, its tool and its work "
                "object",
            )
        return frames

    @property
    def names(self) -> tuple[str, ...]:
        """URDF joint names in wire order."""
        return self.map.names

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The joints in wire order; limits are those of the controller axes."""
        return self.map.joints

    @cached_property
    def mapping(self) -> str:
        """The hash that HELLO compares."""
        rows = ((j.name, j.axis, j.kind, j.sign, j.offset) for j in self.joints)
        return mapping_hash(rows, self.map.coupling)

    @cached_property
    def start_tolerance(self) -> Array:
        """Per joint, rad or m."""
        policy = self.policy
        return np.array(
            [
                policy.start_tolerance if j.kind == "revolute" else policy.start_tolerance_linear
                for j in self.joints
            ]
        )

    @cached_property
    def speed(self) -> Array:
        """Axis speeds, rad/s or m/s."""
        return np.array([joint.speed for joint in self.joints])

    @cached_property
    def acceleration(self) -> Array:
        """Axis accelerations, rad/s2 or m/s2."""
        return np.array([joint.acceleration for joint in self.joints])

    @cached_property
    def _affine(self) -> tuple[Array, Array]:
        """The joint map as a matrix and an offset, read off the map itself."""
        count = len(self.joints)
        columns = [self.map.rates_to_controller(row) for row in np.eye(count).tolist()]
        offset = self.map.to_controller([0.0] * count)
        return np.array(columns, dtype=np.float64), np.array(offset, dtype=np.float64)

    def to_wire(self, positions: Array) -> Array:
        """Controller axis values (n, k) of URDF joint values (n, k)."""
        matrix, offset = self._affine
        wire: Array = positions @ matrix + offset
        return wire

    def from_wire(self, values: Sequence[float]) -> tuple[float, ...]:
        """URDF joint values of the ten axis values of a message."""
        return self.map.to_urdf(values[: len(self.joints)])

    def rates_from_wire(self, values: Sequence[float]) -> tuple[float, ...]:
        """URDF joint velocities of the ten axis velocities of a message."""
        return self.map.rates_to_urdf(values[: len(self.joints)])

    def name_faults(self, names: Sequence[str], columns: int) -> list[Diagnostic]:
        """Return RG611 for columns that are not the robot's joints.

        Without `names` their number has to fit.
        """
        own = self.names
        help = f"the robot's joints are: {', '.join(own)}"
        if not names:
            if columns == len(own):
                return []
            return [error("RG611", None, f"{columns} joints, the robot has {len(own)}", help)]
        result = [
            error("RG611", None, f"the robot has no joint '{name}'", suggest(name, own) or help)
            for name in names
            if name not in own
        ]
        missing = [name for name in own if name not in names]
        if missing:
            help = f"a column for each of the robot's joints: {', '.join(own)}"
            result.append(error("RG611", None, f"joints are missing: {', '.join(missing)}", help))
        return result

    def with_controller_limits(self, hello: HelloReply) -> "Group":
        """Return a copy with the controller's limits where they are narrower."""
        joints = tuple(
            replace(
                joint,
                lower=max(joint.lower, hello.lower[i]),
                upper=min(joint.upper, hello.upper[i]),
            )
            for i, joint in enumerate(self.joints)
        )
        return replace(self, map=replace(self.map, joints=joints))

    def require(self, hello: HelloReply) -> None:
        """Raise IncompatibleDriver if the driver was made for other joints."""
        if hello.mapping != self.mapping or hello.joint_count != len(self.joints):
            raise IncompatibleDriver.because(
                "RG606",
                f"the driver on the controller has another joint map than '{self.name}'",
                "build and deploy this configuration, or connect with the one that is there",
                f"the driver has {hello.joint_count} joints, map {hello.mapping}, "
                f"BUILD_ID {hello.build_id}",
                f"the configuration has {len(self.joints)} joints, map {self.mapping}",
            )
