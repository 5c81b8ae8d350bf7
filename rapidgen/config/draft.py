"""Mutable draft of a group; YAML and URDF fill it, `build.py` checks it.

Figures are in the units of the controller: deg, mm, deg/s, mm/s (and /s²).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from rapidgen.config.model import ChainLink
from rapidgen.config.yaml_tree import MappingNode, place_of
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

Path = tuple[str | int, ...]


@dataclass(slots=True)
class JointDraft:
    """One joint, possibly incomplete."""

    name: str
    axis: str = ""
    unit: str = ""
    lower: float | None = None
    upper: float | None = None
    speed: float | None = None
    acceleration: float | None = None
    sign: int = 1
    offset: float = 0.0
    source: str = ""
    unsure: tuple[str, ...] = ()
    described: tuple[float, float] | None = None
    """Range in the URDF."""
    acceleration_time: float | None = None
    """s from standstill to full speed, instead of the acceleration."""
    brake_deceleration: float = 0.0
    stop_deceleration: float = 0.0
    """0: not known."""


@dataclass(slots=True)
class GroupDraft:
    """One group, possibly incomplete."""

    name: str
    model: str = ""
    joints: list[JointDraft] = field(default_factory=list)
    chain: list[ChainLink] = field(default_factory=list)
    positioners: dict[str, list[ChainLink]] = field(default_factory=dict)
    coupling: float | None = None
    max_payload: float = 0.0
    """kg; 0: not known."""
    known: dict[tuple[str, str], float] = field(default_factory=dict)
    """Figures of the shipped model by (axis, "lower", "upper", "speed" or "acceleration")."""
    external_units: tuple[str, ...] = ()
    urdf_chain: list[ChainLink] = field(default_factory=list)
    """Chain of the URDF, if one is read."""
    names: tuple[str, ...] = ()
    """Names of the description and its file."""
    held_axes: tuple[float, ...] = ()
    """Positions of the axes without a joint (rad), in their order."""
    arm: str = ""
    """The variant recognised by its axes in space."""
    ignored: tuple[str, ...] = ()
    """Actuated joints of the URDF that are part of the arm and drive no axis."""


class DraftFindings:
    """Collects findings with places; skips parts already found faulty."""

    def __init__(self, root: MappingNode, removed: Iterable[Path]) -> None:
        self.root = root
        self.found: list[Diagnostic] = []
        self._removed = set(removed)

    def is_faulty(self, path: Path) -> bool:
        """True when `path`, a part around it or its own value has been reported."""
        return any(path[: len(known)] == known for known in self._removed)

    def mute(self, path: Path) -> None:
        """Skip later findings under `path`: their cause has been reported."""
        self._removed.add(path)

    def span(self, path: Path, *, key: bool = False) -> Span:
        """Return the place of the value (or key) at `path`, or of its parent."""
        at_key, at_value = place_of(self.root, path)
        return at_key if key else at_value

    def add(
        self,
        code: str,
        severity: Severity,
        message: str,
        path: Path,
        label: str = "",
        help: str = "",
        *,
        key: bool = False,
        notes: tuple[str, ...] = (),
    ) -> None:
        """Add a finding at a path of the configuration."""
        if not self.is_faulty(path):
            span = self.span(path, key=key)
            self.found.append(
                error(code, span, message, help, label=label, notes=notes, severity=severity)
            )

    def error(
        self,
        code: str,
        message: str,
        path: Path,
        label: str = "",
        help: str = "",
        *,
        key: bool = False,
    ) -> None:
        """Add an error at a path of the configuration."""
        self.add(code, Severity.ERROR, message, path, label, help, key=key)

    @property
    def failed(self) -> bool:
        """True when an error was found."""
        return any(d.severity is Severity.ERROR for d in self.found)


@dataclass(frozen=True, slots=True)
class DescriptionChoices:
    """Answers of the user in addition to the description."""

    joints: Mapping[str, str] = field(default_factory=dict)
    ignore: tuple[str, ...] = ()
    tips: tuple[str, ...] = ()
    held_axes: tuple[str, ...] = ()
    coupling: float | None = None
    speed: float | None = None
    """deg/s and mm/s for axes without a speed"""
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """deg or mm by joint; "" is for turning axes without a range"""
    controller: str = ""
    robotware: str = ""
    """If either is empty, the values of the robot's type."""
