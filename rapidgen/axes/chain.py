"""A kinematic chain with its fixed parts as poses, and its end pose."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose, Vector
from rapidgen.config.model import ChainLink, GroupConfig

Posture: TypeAlias = tuple[float, ...]
"""Controller axis values in wire order, rad and m."""


@dataclass(frozen=True)
class Step:
    """One step of the chain with its fixed part as a pose."""

    fixed: Pose
    axis: Vector
    joint: int
    """Index in wire order, -1 without a joint."""
    prismatic: bool
    follows: tuple[tuple[int, float], ...]


def steps_of(group: GroupConfig, chain: Sequence[ChainLink]) -> tuple[Step, ...]:
    """Return the chain of a group's joints."""
    names = [joint.name for joint in group.joints]
    kinds = {joint.name: joint.kind for joint in group.joints}

    def step(link: ChainLink) -> Step:
        return Step(
            fixed=(link.xyz, frames.from_rpy(*link.rpy)),
            axis=link.axis,
            joint=names.index(link.joint) if link.joint else -1,
            prismatic=bool(link.joint) and kinds[link.joint] == "prismatic",
            follows=tuple((names.index(name), k) for name, k in link.follows),
        )

    return tuple(map(step, chain))


def along(steps: tuple[Step, ...], values: Posture) -> Pose:
    """Return the end pose of a chain for URDF joint values."""
    place, q = IDENTITY
    for step in steps:
        origin, turned = step.fixed
        if any(origin):
            place = frames.add(place, frames.rotate(q, origin) if q != frames.UNIT else origin)
        if turned != frames.UNIT:
            q = frames.multiply(q, turned)
        if step.joint >= 0:
            amount = values[step.joint]
        elif step.follows:
            amount = sum(values[i] * k for i, k in step.follows)
        else:
            continue
        if step.prismatic:
            slid = frames.scale(step.axis, amount)
            place = frames.add(place, frames.rotate(q, slid) if q != frames.UNIT else slid)
        else:
            q = frames.multiply(q, frames.about(step.axis, amount))
    return place, q
