"""Plausible loads, frames and axes, and figures in the wrong unit.

The configuration, the cell file and the running program share these rules. Bounds are in SI units.
Without a source they are our own: wide enough for every robot of ABB, narrow enough for a figure in
m, rad or g.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from ipaddress import IPv4Address
from typing import Literal, TypeAlias

from rapidgen.config.draft import JointDraft
from rapidgen.config.model import ChainLink, GroupConfig

Part = Literal["mass", "centre", "inertia"]
Vector: TypeAlias = tuple[float, float, float]

_OVERLOAD = 5.0
"""Multiple of the payload that no robot holds: g instead of kg, or another robot's tool."""
LARGEST_PAYLOAD = 1000.0
"""kg, more than the 800 of the IRB 8700, if the payload is not known."""
_LONGEST_REACH = 4.2
"""m, that of the IRB 8700, if the reach is not known."""
_SMALL = 0.001
"""m: no tool, centre of gravity or work object is that near; it is in m instead of mm."""
_SMALL_MASS = 0.01
"""kg, up to which a load is a dummy, as that of tool0."""
_MEASURED = 1.05
"""Ratio by which measured moments of inertia may miss the triangle inequality."""
_ROUND = 1e-6
"""kg m²: moments are written with six decimals."""
_ANGLE = 1e-3
"""rad: usual rounding of an angle."""
_STROKE = 10.0
"""mm, shorter than any linear axis: it is in m instead of mm."""
_SLOWEST_TURN, _FASTEST_TURN = 1.0, 5000.0
"""deg/s; the fastest known is axis 4 of the IRB 910SC, 2400."""
_SLOWEST_LINEAR, _FASTEST_LINEAR = 10.0, 20_000.0
"""mm/s"""
_SOONEST, _LATEST = 0.01, 2.5
"""s from standstill to full speed."""
_FAR_TOOL, _FAR_OBJECT = 3.0, 10.0
"""Times the reach."""


@dataclass(frozen=True, slots=True)
class Arm:
    """Payload and reach of an arm; 0: not known."""

    name: str = ""
    payload: float = 0.0
    """kg"""
    reach: float = 0.0
    """m, including the travel of the axes that carry it"""

    @property
    def longest(self) -> float:
        """Return its reach, or that of the largest robot (m)."""
        return self.reach or _LONGEST_REACH


@dataclass(frozen=True, slots=True)
class Doubt:
    """An impossible (`impossible`) or implausible figure."""

    part: Part
    impossible: bool
    message: str
    help: str


def arm_of(group: GroupConfig) -> Arm:
    """Return the arm of a group."""
    ways = sum(j.upper - j.lower for j in group.joints if j.kind == "prismatic")
    reach = length_of(group.chain)
    return Arm(group.model or group.name, group.max_payload, reach + ways if reach else 0.0)


def length_of(chain: Iterable[ChainLink]) -> float:
    """Return the length (m) of a chain after its first joint."""
    inside, length = False, 0.0
    for step in chain:
        length += math.hypot(*step.xyz) if inside else 0.0
        inside = inside or bool(step.joint)
    return length


def load_doubts(mass: float, centre: Vector, inertia: Vector, arm: Arm) -> Iterator[Doubt]:
    """Yield doubts about a load: kg, m and kg m²."""
    yield from mass_doubts(mass, arm)
    yield from _centre_doubts(mass, centre, arm)
    yield from _inertia_doubts(mass, inertia, arm)


def mass_doubts(mass: float, arm: Arm) -> Iterator[Doubt]:
    """Yield doubts about a mass in kg."""
    if mass < 0:
        yield Doubt("mass", True, f"a load of {mass:g} kg", "a mass is more than 0")
    elif arm.payload and mass > arm.payload:
        heavy = mass > _OVERLOAD * arm.payload
        yield Doubt(
            "mass",
            heavy,
            f"{mass:g} kg is more than the {arm.payload:g} kg payload of {arm.name}",
            f"the unit is kg: {mass:g} g are {mass / 1000:g}"
            if heavy
            else "give `max_payload:` if the data sheet of your robot says more",
        )
    elif not arm.payload and (doubt := payload_doubt(mass)):
        yield Doubt(
            "mass",
            mass > _OVERLOAD * LARGEST_PAYLOAD,
            *doubt,
        )


def payload_doubt(payload: float) -> tuple[str, str] | None:
    """Return reason and fix if no robot carries a payload (kg)."""
    if payload <= LARGEST_PAYLOAD:
        return None
    reason = f"{payload:g} kg is more than any robot of ABB carries"
    return reason, f"the unit is kg: {payload:g} g are {payload / 1000:g}"


def _centre_doubts(mass: float, centre: Vector, arm: Arm) -> Iterator[Doubt]:
    away = math.hypot(*centre)
    if away > arm.longest:
        yield Doubt(
            "centre",
            True,
            f"a centre of gravity {_mm(away)} away; the arm reaches {_mm(arm.longest)}",
            "the unit is mm",
        )
    elif away > arm.longest / 2:
        yield Doubt(
            "centre",
            False,
            f"a centre of gravity {_mm(away)} away is more than half the arm's reach",
            "the unit is mm, from the flange",
        )
    elif 0 < away < _SMALL and mass > _SMALL_MASS:
        yield Doubt(
            "centre",
            False,
            f"a centre of gravity {_mm(away)} away is as good as in the flange",
            f"the unit is mm: {away * 1000:g} m are {away * 1e6:g}",
        )


def _inertia_doubts(mass: float, inertia: Vector, arm: Arm) -> Iterator[Doubt]:
    least, middle, most = sorted(inertia)
    displayed = ", ".join(f"{moment:g}" for moment in inertia)
    if least < 0:
        yield Doubt(
            "inertia",
            True,
            f"a moment of inertia of {least:g} kg m²",
            "moments of inertia are 0 or more; [0, 0, 0] is a point mass",
        )
        return
    if most and mass <= 0:
        yield Doubt("inertia", True, f"[{displayed}] kg m² without a mass", "give the `mass:` too")
        return
    if most > (least + middle) * _MEASURED + _ROUND:
        yield Doubt(
            "inertia",
            True,
            f"[{displayed}] kg m²: "
            "no body has a moment of inertia larger than the sum of the others",
            "give all three, about the centre of gravity; [0, 0, 0] is a point mass",
        )
    radius = math.sqrt(most / mass) if most else 0.0
    if radius > arm.longest / 2:
        yield Doubt(
            "inertia",
            radius > arm.longest,
            f"{most:g} kg m² of {mass:g} kg is a body with a radius of {_mm(radius)}",
            f"the unit is kg m²: {most:g} kg mm² are {most / 1e6:g}",
        )


def frame_doubt(position: Vector, arm: Arm, *, tool: bool) -> tuple[bool, str, str] | None:
    """Return whether a frame is impossible or implausible, why, and a fix.

    `tool`: of a tool, or of a work object that is held, from the flange; else in the world.
    """
    away = math.hypot(*position)
    if 0 < away < _SMALL:
        displayed = ", ".join(f"{v * 1000:g}" for v in position)
        metres = ", ".join(f"{v * 1e6:g}" for v in position)
        reason = f"[{displayed}] is a shift of {_mm(away)}"
        return False, reason, f"the unit is mm: [{displayed}] m are [{metres}]"
    if tool and away > arm.longest:
        reason = f"a frame {_mm(away)} from the flange; the arm reaches {_mm(arm.longest)}"
        return away > _FAR_TOOL * arm.longest, reason, "the unit is mm"
    if not tool and away > _FAR_OBJECT * arm.longest:
        reason = f"a frame {_mm(away)} away; the arm reaches {_mm(arm.longest)}"
        return False, reason, "the unit is mm"
    return None


def is_radians(angle: float) -> bool:
    """True if an angle in deg is a multiple of 45 degrees in rad.

    Examples: 1.5708, 0.785.
    """
    eighths = angle / (math.pi / 4)
    near = round(eighths)
    return 0 < abs(near) <= 8 and abs(angle - near * math.pi / 4) < _ANGLE


def _are_radians(lower: float, upper: float) -> bool:
    """True if limits in deg are within a turn in rad: less than any axis needs."""
    return -math.tau <= lower < upper <= math.tau


def is_host(text: str) -> bool:
    """True if it is a host address, as a controller writes it."""
    try:
        address = IPv4Address(text)
    except ValueError:
        return False
    return not (address.is_unspecified or address.is_multicast or address.is_reserved)


def axis_doubts(draft: JointDraft) -> Iterator[tuple[str, str, str]]:
    """Yield key, reason and fix for axis figures in the wrong unit."""
    unit = "mm" if draft.unit == "mm" else "deg"
    speed, lower, upper = draft.speed, draft.lower, draft.upper
    if unit == "deg" and is_radians(draft.offset):
        degrees = math.degrees(draft.offset)
        yield "offset", f"an offset of {draft.offset:g} deg", f"{degrees:.4g} deg, if it is in rad"
    if unit == "mm" and lower is not None and upper is not None and 0 < upper - lower < _STROKE:
        reason = f"a linear axis with a way of {upper - lower:g} mm"
        yield "upper", reason, "limits of a linear axis are in mm"
    if unit == "deg" and lower is not None and upper is not None and _are_radians(lower, upper):
        reason = f"a turning axis with a way of {upper - lower:.4g} deg"
        limits = f"{math.degrees(lower):.4g} to {math.degrees(upper):.4g}"
        yield "upper", reason, f"the unit is deg: {lower:g} to {upper:g} rad are {limits}"
    if speed is None:
        return
    fastest = _FASTEST_LINEAR if unit == "mm" else _FASTEST_TURN
    slowest = _SLOWEST_LINEAR if unit == "mm" else _SLOWEST_TURN
    if not slowest <= speed <= fastest:
        yield "speed", f"{speed:g} {unit}/s is no speed of an axis", f"the unit is {unit}/s"
    for key, value, what in (
        ("acceleration", draft.acceleration, "are reached"),
        ("brake_deceleration", draft.brake_deceleration, "are braked"),
        ("stop_deceleration", draft.stop_deceleration, "are braked"),
    ):
        if value and not _SOONEST <= speed / value <= _LATEST:
            reason = f"{value:g} {unit}/s²: {speed:g} {unit}/s {what} in {speed / value:.3g} s"
            yield key, reason, f"the unit is {unit}/s²"


def inertia_doubt(most: float, speed: float) -> str:
    """Return why the largest acceleration (deg/s²) of an axis is none; empty if it is one."""
    if not speed or _SOONEST <= speed / most <= _LATEST:
        return ""
    return f"{most:g} deg/s²: {speed:g} deg/s are reached in {speed / most:.3g} s"


def _mm(length: float) -> str:
    length *= 1000
    return f"{length:.4g} mm" if length < 1000 else f"{length:.0f} mm"
