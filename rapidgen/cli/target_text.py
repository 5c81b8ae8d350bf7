"""Where a robot is to go, as people write and read it: joints in deg and mm, poses in mm."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import typer

from rapidgen.diagnostics import suggest

if TYPE_CHECKING:
    from rapidgen.axes.frames import Pose, Quaternion, Vector
    from rapidgen.client.core.group import Group

_TURN = 180 / math.pi
_THOUSAND = 1000.0
_UNIT = 0.01
"""By which a quaternion's length may differ from 1: people write three digits."""
_NAMED = re.compile(r"\s*([^=\s]+)\s*=\s*(\S+)\s*")


@dataclass(frozen=True, slots=True)
class Units:
    """What figures are shown and read in: deg and mm, or (`si`) rad and m."""

    si: bool = False

    def joint(self, kind: str) -> tuple[str, float, int]:
        """Of a joint of a kind: unit, how many of it are one rad or m, digits shown."""
        if kind == "revolute":
            return ("rad", 1.0, 4) if self.si else ("deg", _TURN, 2)
        return ("m", 1.0, 5) if self.si else ("mm", _THOUSAND, 2)

    @property
    def said(self) -> str:
        """Both units."""
        return "rad, m" if self.si else "deg, mm"

    @property
    def length(self) -> tuple[str, float, int]:
        """As `joint`, of a place."""
        return self.joint("prismatic")


def joints_text(units: Units, group: "Group", values: Sequence[float]) -> str:
    """Joints as `--joints` takes them: all, in the robot's order, between commas."""
    return ",".join(
        figure(value, *units.joint(joint.kind)[1:])
        for joint, value in zip(group.joints, values, strict=True)
    )


def named_text(units: Units, group: "Group", values: Sequence[float]) -> str:
    """Joints with names and units, for people."""
    text = []
    for joint, value in zip(group.joints, values, strict=True):
        unit, factor, digits = units.joint(joint.kind)
        text.append(f"{joint.name} {figure(value, factor, digits)} {unit}")
    return ", ".join(text)


def figure(value: float, factor: float = 1.0, digits: int = 2) -> str:
    """A number in a unit; never -0."""
    return f"{round(value * factor, digits) + 0.0:.{digits}f}"


def pose_text(units: Units, pose: "Pose") -> str:
    """A pose as `--pose` takes it."""
    place, turn = pose
    factor, digits = units.length[1:]
    return ",".join(
        [*(figure(v, factor, digits) for v in place), *(figure(v, 1.0, 5) for v in turn)]
    )


@dataclass(frozen=True, slots=True)
class Figures:
    """Joints as they were typed, before a robot is asked: values in the order given, in the units
    of `Units`, with a name each or none at all."""

    values: tuple[float, ...]
    names: tuple[str, ...] = ()


def read_figures(text: str, option: str = "--joints") -> Figures:
    """Values between commas, or NAME=VALUE. Raises typer.BadParameter."""
    parts = text.split(",")
    hits = [hit for part in parts if (hit := _NAMED.fullmatch(part))]
    if not hits:
        return Figures(tuple(_number(part, option) for part in parts))
    for part in parts:
        if not _NAMED.fullmatch(part):
            raise typer.BadParameter(f"'{part.strip()}' is not NAME=VALUE", param_hint=option)
    names = tuple(hit[1] for hit in hits)
    for name in names:
        if names.count(name) > 1:
            raise typer.BadParameter(f"'{name}' is there twice", param_hint=option)
    return Figures(tuple(_number(hit[2], option) for hit in hits), names)


def joints_of(
    figures: Figures,
    units: Units,
    group: "Group",
    current: Sequence[float],
    option: str = "--joints",
) -> tuple[float, ...]:
    """All joints in the robot's order, those without a value where they are (`current`); rad, m.

    Raises typer.BadParameter.
    """
    if figures.names:
        kinds = {joint.name: joint.kind for joint in group.joints}
        return named_of(figures, units, kinds, current, option)
    if len(figures.values) != len(group.names):
        raise typer.BadParameter(
            f"{len(figures.values)} values for {len(group.names)} joints: give all of them "
            f"({','.join(group.names)}), or some as NAME=VALUE",
            param_hint=option,
        )
    return tuple(
        value / units.joint(joint.kind)[1]
        for value, joint in zip(figures.values, group.joints, strict=True)
    )


def named_of(
    figures: Figures, units: Units, kinds: Mapping[str, str], current: Sequence[float], option: str
) -> tuple[float, ...]:
    """All of `kinds`, those without a value where they are (`current`); rad, m.

    Raises typer.BadParameter.
    """
    result = dict(zip(kinds, current, strict=True))
    for name, value in zip(figures.names, figures.values, strict=True):
        if name not in kinds:
            help = suggest(name, list(kinds)) or f"its joints are: {', '.join(kinds)}"
            raise typer.BadParameter(f"there is no joint '{name}': {help}", param_hint=option)
        result[name] = value / units.joint(kinds[name])[1]
    return tuple(result.values())


def read_pose(
    text: str, units: Units, option: str = "--pose"
) -> tuple["Vector", "Quaternion | None"]:
    """X,Y,Z,Q1,Q2,Q3,Q4, or X,Y,Z without a turn; m. Raises typer.BadParameter."""
    values = [_number(part, option) for part in text.split(",")]
    if len(values) not in (3, 7):
        raise typer.BadParameter(
            f"{len(values)} values: X,Y,Z,Q1,Q2,Q3,Q4, or X,Y,Z alone, turned as it is",
            param_hint=option,
        )
    x, y, z = (value / units.length[1] for value in values[:3])
    if len(values) == 3:
        return (x, y, z), None
    length = math.hypot(*values[3:])
    if abs(length - 1) > _UNIT:
        raise typer.BadParameter(
            f"Q1,Q2,Q3,Q4 is no unit quaternion: its length is {length:.3f}", param_hint=option
        )
    a, b, c, d = (value / length for value in values[3:])
    return (x, y, z), (a, b, c, d)


def plain_number(text: str) -> float:
    """A number as people write one: `1_0`, ten to Python, is more likely a 1.0. Raises
    ValueError."""
    if "_" in text:
        raise ValueError(text)
    return float(text)


def _number(text: str, option: str) -> float:
    try:
        value = plain_number(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise typer.BadParameter(f"'{text.strip()}' is no number", param_hint=option)
    return value
