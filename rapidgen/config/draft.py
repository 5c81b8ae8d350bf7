"""A group while it is put together: YAML and URDF both fill it, `build.py` judges it.

Figures are in the units of the controller: deg, mm, deg/s, mm/s (and /s²).
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

from rapidgen.config.model import ChainLink
from rapidgen.config.yaml_tree import MappingNode, place_of
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

Path = tuple[str | int, ...]


@dataclass(slots=True)
class JointDraft:
    """One joint, as far as it is known."""

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
    """The range that the URDF has."""


@dataclass(slots=True)
class GroupDraft:
    """One group, as far as it is known."""

    name: str
    model: str = ""
    joints: list[JointDraft] = field(default_factory=list)
    chain: list[ChainLink] = field(default_factory=list)
    positioners: dict[str, list[ChainLink]] = field(default_factory=dict)
    coupling: float | None = None
    max_payload: float = 0.0
    """kg; 0: not known."""
    known: dict[tuple[str, str], float] = field(default_factory=dict)
    """Figures of the shipped model by (axis, "lower" or "upper" or "speed")."""
    external_units: tuple[str, ...] = ()
    urdf_chain: list[ChainLink] = field(default_factory=list)
    """The chain of the URDF, where one is read."""
    names: tuple[str, ...] = ()
    """What the description and its file are called."""
    held_axes: tuple[float, ...] = ()
    """Where the axes without a joint stand (rad), in their order."""
    arm: str = ""
    """The variant that it was recognised as, by its axes in space."""
    ignored: tuple[str, ...] = ()
    """Joints of the URDF that move by themselves, are part of the arm and drive no axis."""


class DraftFindings:
    """Collects findings with places; what lies in a part already found faulty is not repeated."""

    def __init__(self, root: MappingNode, removed: Iterable[Path]) -> None:
        self.root = root
        self.found: list[Diagnostic] = []
        self._removed = set(removed)

    def is_faulty(self, path: Path) -> bool:
        """True when `path`, a part around it or its own value has been reported."""
        return any(path[: len(known)] == known for known in self._removed)

    def mute(self, path: Path) -> None:
        """Nothing more about what lies under `path`: its cause has been reported."""
        self._removed.add(path)

    def span(self, path: Path, *, key: bool = False) -> Span:
        """Place of the value (or key) at `path` or of the nearest part that exists."""
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
        """One finding at a path of the configuration."""
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
        """One error at a path of the configuration."""
        self.add(code, Severity.ERROR, message, path, label, help, key=key)

    @property
    def failed(self) -> bool:
        """True when an error was found."""
        return any(d.severity is Severity.ERROR for d in self.found)
