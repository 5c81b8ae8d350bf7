"""Library of ABB's arm variants: axes, ranges, speeds, coupling.

`robots/variants.json` holds it, in mm and degrees, with every controller axis at 0. The shipped
models have the figures of their own files (checked by a test); the others list their sources there.
"""

import json
import re
from dataclasses import dataclass
from functools import cache
from math import radians

from rapidgen._data import data_folder
from rapidgen._json import Json, Members, items, members, number, text
from rapidgen.config.draft import GroupDraft
from rapidgen.config.geometry import ArmAxes, Difference, Line, Matrix, compare, skeleton
from rapidgen.config.model import AxisInertia
from rapidgen.config.vectors import unit

SAME_PLACE = 0.003
"""m by which two public sources of one variant may differ (rounded dimensions)."""
SAME_TURN = 0.009
"""rad, half a degree."""
_FAMILY = re.compile(r"(?:[ic]rb|gofa|yumi)[_ -]?(\d{2,5})(?!\d)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class KnownAxis:
    """One axis of a variant: range and speed in deg or mm; None: no source."""

    axis: str
    lower: float | None
    upper: float | None
    speed: float | None
    unsure: tuple[str, ...] = ()
    acceleration: float | None = None


@dataclass(frozen=True, slots=True)
class Variant:
    """One arm; `model` is its shipped model with its group."""

    name: str
    model: str
    group: str
    coupling: float | None
    max_payload: float
    """kg; 0: not known."""
    axes: tuple[KnownAxis, ...]
    skeleton: ArmAxes
    sources: tuple[tuple[str, str], ...]
    unsure: tuple[str, ...]
    disagreements: tuple[str, ...]
    """Figures that differ between its sources; the narrower or lower one is used."""
    inertias: tuple[AxisInertia, ...]

    @property
    def family(self) -> str:
        """Return the number of the type: 1600 of an IRB 1600-6/1.2."""
        return family(self.name)

    def axis(self, name: str) -> KnownAxis | None:
        """Return an axis by name."""
        return next((axis for axis in self.axes if axis.axis == name), None)


def family(*names: str) -> str:
    """Return the number of an ABB type in a name (model, robot, file)."""
    for name in names:
        hit = _FAMILY.search(name)
        if hit:
            return hit[1]
    return ""


@cache
def variants() -> tuple[Variant, ...]:
    """Return all variants, those of shipped models first."""
    path = data_folder("robots") / "variants.json"
    return tuple(_variant(entry) for entry in items(json.loads(path.read_text(encoding="utf-8"))))


def of_model(model: str, group: str) -> Variant | None:
    """Return the variant of a shipped model's group."""
    own = [v for v in variants() if v.model == model]
    return next((v for v in own if v.group == group), own[0] if len(own) == 1 else None)


@dataclass(frozen=True, slots=True)
class Match:
    """A variant with the axes of the arm."""

    variant: Variant
    difference: Difference


def closeness(variant: Variant, *names: str) -> tuple[int, bool]:
    """Return a measure of how well names match a variant.

    It counts the matching figures, and prefers a shipped variant.
    """
    own = {figure.replace(".", "").strip("0") for figure in re.findall(r"[\d.]+", variant.name)}
    message = {figure.replace(".", "").strip("0") for name in names for figure in _figures(name)}
    return len((own & message) - {""}), bool(variant.model)


def _figures(name: str) -> list[str]:
    return re.findall(r"\d+(?:\.\d+)?", name)


def recognise(arm: ArmAxes, *names: str) -> Match | None:
    """Return the variant of an arm, by its axes in space.

    Among equal ones the named one wins.
    """
    hits = []
    for variant in variants():
        result = compare(arm, variant.skeleton)
        if result and result.distance <= SAME_PLACE and result.angle <= SAME_TURN:
            rank = (len(result.turned), *(-int(part) for part in closeness(variant, *names)))
            hits.append((rank, round(result.distance, 4), Match(variant, result)))
    return min(hits, key=lambda hit: hit[:2])[2] if hits else None


def _variant(entry: Json) -> Variant:
    data = members(entry)
    axes = [members(axis) for axis in items(data["axes"])]
    coupling = data["coupling"]
    return Variant(
        name=text(data["name"]),
        model=text(data.get("model", "")),
        group=text(data.get("group", "")),
        coupling=None if coupling is None else number(coupling),
        max_payload=_figure(data, "max_payload") or 0.0,
        axes=tuple(
            KnownAxis(
                text(axis["axis"]),
                _figure(axis, "lower"),
                _figure(axis, "upper"),
                _figure(axis, "speed"),
                tuple(text(part) for part in items(axis.get("unsure", []))),
                _figure(axis, "acceleration"),
            )
            for axis in axes
        ),
        skeleton=ArmAxes(
            tuple(
                Line(
                    text(axis["axis"]),
                    _vector(axis["at"], 0.001),
                    unit(_vector(axis["along"])),
                    bool(axis.get("slides")),
                )
                for axis in axes
            ),
            _vector(data["end"], 0.001),
            _matrix(data["facing"]) if "facing" in data else None,
        ),
        sources=tuple((key, text(value)) for key, value in members(data["sources"]).items()),
        unsure=tuple(text(part) for part in items(data.get("unsure", []))),
        disagreements=tuple(text(part) for part in items(data.get("disagreements", []))),
        inertias=tuple(_inertia(members(axis)) for axis in items(data.get("inertias", []))),
    )


def _inertia(data: Members) -> AxisInertia:
    names = "constant", "elbow", "wrist", "cosine", "sine"
    parts = {name: _figure(data, name) or 0.0 for name in names}
    return AxisInertia(text(data["axis"]), radians(number(data["most"])), **parts)


def _figure(data: Members, name: str) -> float | None:
    value = data.get(name)
    return None if value is None else number(value)


def _vector(value: Json, factor: float = 1.0) -> tuple[float, float, float]:
    x, y, z = (number(part) * factor for part in items(value))
    return (x, y, z)


def _matrix(value: Json) -> Matrix:
    x, y, z = (_vector(row) for row in items(value))
    return (x, y, z)


def entry(name: str, draft: GroupDraft, sources: dict[str, str], unsure: list[str]) -> Members:
    """Return the library entry of a group's arm."""
    arm = skeleton(draft)
    joints = {joint.axis: joint for joint in draft.joints}
    axes: list[Json] = []
    for line in arm.lines:
        joint = joints[line.axis]
        made: Members = {
            "axis": line.axis,
            "at": [round(v * 1000, 3) for v in line.point],
            "along": [round(v, 6) + 0.0 for v in line.direction],
            "lower": joint.lower,
            "upper": joint.upper,
            "speed": joint.speed,
        }
        if line.slides:
            made["slides"] = True
        if joint.unsure:
            made["unsure"] = list(joint.unsure)
        axes.append(made)
    return {
        "name": name,
        "model": draft.model,
        "group": draft.name,
        "coupling": draft.coupling,
        "max_payload": draft.max_payload or None,
        "axes": axes,
        "end": [round(v * 1000, 3) for v in arm.end],
        "facing": [[round(v, 6) + 0.0 for v in row] for row in arm.facing or ()],
        "sources": dict(sources),
        "unsure": list(unsure),
    }
