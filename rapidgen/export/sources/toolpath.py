"""Toolpaths as data in SI units, and the frame and orientation that a user gives to them.

A source has positions in its own unit and frame, and often no orientation. Nothing of this is
guessed: the unit, the frame (`origin`) and the axis of the tool with the rotation about it are
options, and a source that needs one which is not given is rejected.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot, isfinite
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from rapidgen._reading import TooLarge, read_foreign
from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Quaternion, Vector
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error, refusal

LENGTHS = {"m": 1.0, "mm": 0.001, "in": 0.0254}
"""Length units in m."""
_LARGEST = 256_000_000
"""Bytes of a source."""
_WIDEST = 10.0
"""m: no robot's workspace is wider, with a track of usual length."""
_SHOWN = 20
_UNIT = 1e-3
"""Tolerance of a quaternion's length."""


@dataclass(frozen=True, slots=True)
class WordAction:
    """What a G-code word such as M3 or S means in this cell.

    `signal` sets `target` to `value`, or to the number of the word without a value; `call` calls
    the routine `target`; `ignore` does nothing.
    """

    kind: Literal["signal", "call", "ignore"]
    target: str = ""
    value: float | None = None


@dataclass(frozen=True, slots=True)
class SourceOptions:
    """What the user says about a source.

    `length` in m per unit and `angle` in rad per unit, None if not given; `origin` is the frame of
    the source in the work object; `tool_axis` is the direction of the tool's z axis in that frame
    and `turn` the rotation (rad) about it. Speeds are m/s.
    """

    length: float | None = None
    angle: float | None = None
    origin: Pose = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
    tool_axis: Vector | None = None
    turn: float | None = None
    columns: tuple[str, ...] = ()
    """Names of the columns of a table without a header."""
    speed: float = 0.1
    rapid: float = 0.25
    """Speed of G0."""
    words: Mapping[str, WordAction] = field(default_factory=lambda: MappingProxyType({}))
    offsets: Mapping[str, Vector] = field(default_factory=lambda: MappingProxyType({}))
    """Work offsets G54 to G59, m."""


@dataclass(frozen=True, slots=True)
class PathStep:
    """One step: a move to joints or a pose (m), a signal, a wait or a call."""

    kind: Literal["joints", "line", "arc", "set", "call", "wait"]
    span: Span
    joints: tuple[float, ...] = ()
    pose: Pose | None = None
    via: Pose | None = None
    speed: float = 0.1
    name: str = ""
    """Signal or routine."""
    value: float = 0.0
    stops: bool = False


@dataclass(frozen=True, slots=True)
class Toolpath:
    """Steps in order; `names` are those of joints, if the source has them."""

    steps: tuple[PathStep, ...]
    names: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()
    """Words ignored by order of the user, as they occurred."""


@dataclass(frozen=True, slots=True)
class JointPath:
    """Joints with times: rows of rad or m, times in s, and the line of each row."""

    times: tuple[float, ...]
    positions: tuple[tuple[float, ...], ...]
    names: tuple[str, ...]
    path: str
    lines: tuple[int, ...]


def read_text(path: Path) -> str:
    """Return the text of a source. Raises DiagnosticError RG760."""
    try:
        return read_foreign(path, _LARGEST).decode("utf-8-sig")
    except TooLarge:
        raise refusal(
            "RG760", None, f"{path} is larger than {_LARGEST:,} bytes", "split it"
        ) from None
    except OSError as fault:
        reason = (fault.strerror or str(fault)).lower()
        raise refusal(
            "RG760", None, f"cannot read {path}: {reason}", "give the path of a file"
        ) from fault
    except UnicodeDecodeError as fault:
        line = fault.object.count(b"\n", 0, fault.start) + 1
        raise refusal(
            "RG760", Span(str(path), line, 1), f"{path} is not text in UTF-8", "save it as UTF-8"
        ) from fault


def bad_source(path: str, line: int, message: str, help: str = "", column: int = 1) -> Diagnostic:
    """Return a fault of a source at its place."""
    return error("RG760", Span(path, line, column) if line else None, message, help)


def reject(findings: Sequence[Diagnostic]) -> None:
    """Raise DiagnosticError with the first findings, if there are any."""
    if findings:
        shown = list(findings[:_SHOWN])
        if len(findings) > _SHOWN:
            more = f"{len(findings) - _SHOWN} more faults of this source"
            shown.append(error("RG760", None, more))
        raise DiagnosticError(shown)


def need_length(options: SourceOptions, path: str, line: int = 1) -> float:
    """Return m per unit. Raises DiagnosticError RG761 without it."""
    if options.length is None:
        raise refusal(
            "RG761",
            Span(path, line, 1),
            "the unit of lengths is not given",
            "--units mm, m or in",
        )
    return options.length


def tool_orientation(axis: Vector, turn: float) -> Quaternion:
    """Return the orientation of a tool whose z axis has a direction.

    Its x axis is that of the frame, turned as little as necessary (the y axis if z is along x),
    then rotated by `turn` rad about z. Raises ZeroDivisionError for a zero vector.
    """
    size = hypot(*axis)
    z = axis[0] / size, axis[1] / size, axis[2] / size
    reference: Vector = (1.0, 0.0, 0.0) if abs(z[0]) < 0.9 else (0.0, 1.0, 0.0)
    along = sum(a * b for a, b in zip(reference, z, strict=True))
    x = tuple(a - along * b for a, b in zip(reference, z, strict=True))
    length = hypot(*x)
    x = (x[0] / length, x[1] / length, x[2] / length)
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    rows = tuple((x[i], y[i], z[i]) for i in range(3))
    q = frames.from_matrix((rows[0], rows[1], rows[2]))
    return frames.multiply(q, frames.about((0.0, 0.0, 1.0), turn))


def fixed_orientation(options: SourceOptions, path: str, line: int = 1) -> Quaternion:
    """Return the orientation of all positions of a source.

    Raises DiagnosticError RG761 without tool axis or rotation.
    """
    if options.tool_axis is None or options.turn is None:
        missing = "tool's axis" if options.tool_axis is None else "rotation about the tool's axis"
        raise refusal(
            "RG761",
            Span(path, line, 1),
            f"the source has positions only, and the {missing} is not given",
            "--tool-axis 0,0,-1 --turn 0: tool along -z of the source, x axes aligned",
        )
    return tool_orientation(options.tool_axis, options.turn)


def unit_quaternion(values: Sequence[float]) -> Quaternion:
    """Return a unit quaternion. Raises ValueError for another length."""
    size = hypot(*values)
    if abs(size - 1) > _UNIT:
        raise ValueError(f"the quaternion has the length {size:.4g}")
    w, x, y, z = values
    return frames.normalise((w, x, y, z))


def checked_steps(steps: Sequence[PathStep], path: str) -> list[Diagnostic]:
    """Return faults of a whole toolpath: empty, not finite, or too wide for any robot."""
    if not steps:
        return [error("RG760", Span(path, 1, 1), f"{path} has no points", "add at least one")]
    findings = []
    places = [step for step in steps if step.pose is not None]
    for step in steps:
        values = [*step.joints, step.value, step.speed]
        values += [v for pose in (step.pose, step.via) if pose for part in pose for v in part]
        if not all(map(isfinite, values)):
            findings.append(error("RG760", step.span, "a value is not a finite number"))
    if findings or not places:
        return findings
    low = [min(step.pose[0][i] for step in places if step.pose) for i in range(3)]
    high = [max(step.pose[0][i] for step in places if step.pose) for i in range(3)]
    width = hypot(*(b - a for a, b in zip(low, high, strict=True)))
    if width > _WIDEST:
        farthest = max(places, key=lambda step: hypot(*step.pose[0]) if step.pose else 0.0)
        findings.append(
            error(
                "RG761",
                farthest.span,
                f"the toolpath is {width:.4g} m wide: wrong unit",
                "check --units, or split the toolpath",
            )
        )
    return findings
