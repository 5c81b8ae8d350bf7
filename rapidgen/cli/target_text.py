"""Targets as text: joints in deg and mm, poses in mm and quaternions."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import typer

from rapidgen.diagnostics import refusal, suggest

if TYPE_CHECKING:
    from rapidgen.axes.frames import Pose, Quaternion, Vector
    from rapidgen.client.core.group import Group

_TURN = 180 / math.pi
_THOUSAND = 1000.0
_UNIT = 0.01
"""Tolerance of a quaternion's length: users write three digits."""
_NAMED = re.compile(r"\s*([^=\s]+)\s*=\s*(\S+)\s*")


@dataclass(frozen=True, slots=True)
class Units:
    """Units for input and output: deg and mm, or (`si`) rad and m."""

    si: bool = False

    def joint(self, kind: str) -> tuple[str, float, int]:
        """Return the unit of a type of joint, its factor per rad or m, and its decimal places."""
        if kind == "revolute":
            return ("rad", 1.0, 4) if self.si else ("deg", _TURN, 2)
        return ("m", 1.0, 5) if self.si else ("mm", _THOUSAND, 2)

    @property
    def text(self) -> str:
        """Both units, for display."""
        return "rad, m" if self.si else "deg, mm"

    @property
    def length(self) -> tuple[str, float, int]:
        """As `joint`, for positions."""
        return self.joint("prismatic")


def target_first(to: str, *words: str) -> tuple[str, ...]:
    """Return the arguments of a command with its controller first.

    `to` is the value of `--to`; then the arguments do not contain the controller. Raises
    DiagnosticError RG901: no controller, or two.
    """
    if not to and not words[0]:
        message = "no controller is named"
        raise refusal("RG901", None, message, "add --to HOST, or --to sim for the simulator")
    if to and words[-1]:
        message = f"the controller is named twice: {words[0]} and --to {to}"
        raise refusal("RG901", None, message, "leave one out")
    return (to, *words[:-1]) if to else words


def joints_text(units: Units, group: "Group", values: Sequence[float]) -> str:
    """Format joints as `--joints` takes them: all, in the robot's order."""
    return ",".join(
        figure(value, *units.joint(joint.kind)[1:])
        for joint, value in zip(group.joints, values, strict=True)
    )


def named_text(units: Units, group: "Group", values: Sequence[float]) -> str:
    """Format joints with names and units."""
    text = []
    for joint, value in zip(group.joints, values, strict=True):
        unit, factor, digits = units.joint(joint.kind)
        text.append(f"{joint.name} {figure(value, factor, digits)} {unit}")
    return ", ".join(text)


def figure(value: float, factor: float = 1.0, digits: int = 2) -> str:
    """Format a number in a unit; never -0."""
    return f"{round(value * factor, digits) + 0.0:.{digits}f}"


def pose_text(units: Units, pose: "Pose") -> str:
    """Format a pose as `--pose` takes it."""
    place, turn = pose
    factor, digits = units.length[1:]
    return ",".join(
        [*(figure(v, factor, digits) for v in place), *(figure(v, 1.0, 5) for v in turn)]
    )


@dataclass(frozen=True, slots=True)
class Figures:
    """Joint values as typed, in the units of `Units`; all of them have a name, or none."""

    values: tuple[float, ...]
    names: tuple[str, ...] = ()


def read_figures(text: str, option: str = "--joints") -> Figures:
    """Read comma-separated values or NAME=VALUE. Raises typer.BadParameter."""
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
            raise typer.BadParameter(f"'{name}' is given twice", param_hint=option)
    return Figures(tuple(_number(hit[2], option) for hit in hits), names)


def joints_of(
    figures: Figures,
    units: Units,
    group: "Group",
    current: Sequence[float],
    option: str = "--joints",
) -> tuple[float, ...]:
    """Return all joints in the robot's order, the others at their `current` value; rad, m.

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
    """Return all joints of `kinds`, the others at their `current` value; rad, m.

    Raises typer.BadParameter.
    """
    result = dict(zip(kinds, current, strict=True))
    for name, value in zip(figures.names, figures.values, strict=True):
        if name not in kinds:
            help = suggest(name, list(kinds)) or f"the joints are {', '.join(kinds)}"
            raise typer.BadParameter(f"unknown joint '{name}': {help}", param_hint=option)
        result[name] = value / units.joint(kinds[name])[1]
    return tuple(result.values())


def read_pose(
    text: str, units: Units, option: str = "--pose"
) -> tuple["Vector", "Quaternion | None"]:
    """Read X,Y,Z,Q1,Q2,Q3,Q4 or X,Y,Z; return m. Raises typer.BadParameter."""
    values = [_number(part, option) for part in text.split(",")]
    if len(values) not in (3, 7):
        raise typer.BadParameter(
            f"{len(values)} values: give X,Y,Z,Q1,Q2,Q3,Q4, or X,Y,Z to keep the orientation",
            param_hint=option,
        )
    x, y, z = (value / units.length[1] for value in values[:3])
    if len(values) == 3:
        return (x, y, z), None
    length = math.hypot(*values[3:])
    if abs(length - 1) > _UNIT:
        raise typer.BadParameter(
            f"Q1,Q2,Q3,Q4 is not a unit quaternion: its length is {length:.3f}", param_hint=option
        )
    a, b, c, d = (value / length for value in values[3:])
    return (x, y, z), (a, b, c, d)


def plain_number(text: str) -> float:
    """Read a number. Raises ValueError, also for `1_0`, which Python reads as 10."""
    if "_" in text:
        raise ValueError(text)
    return float(text)


def _number(text: str, option: str) -> float:
    try:
        value = plain_number(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise typer.BadParameter(f"'{text.strip()}' is not a number", param_hint=option)
    return value
