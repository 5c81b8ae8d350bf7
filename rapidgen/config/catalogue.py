"""One-line descriptions of the shipped models."""

from dataclasses import asdict, dataclass
from itertools import pairwise
from math import dist

from rapidgen._json import Members
from rapidgen.config.accelerations import ERROR_BAND
from rapidgen.config.geometry import distance
from rapidgen.config.load import load_config
from rapidgen.config.registry import find_shipped, shipped_names
from rapidgen.config.variant_library import Variant, variants
from rapidgen.config.variant_model import missing_figures, model_name
from rapidgen.config.yaml_tree import MappingNode, ScalarNode, decode, parse, read_bytes
from rapidgen.diagnostics import refusal, suggest


@dataclass(frozen=True, slots=True)
class ShippedModel:
    """One shipped model; `groups` are (name, number of joints)."""

    name: str
    description: str
    controller: str
    generations: tuple[int, ...]
    groups: tuple[tuple[str, int], ...]
    unsure: bool

    def as_json(self) -> Members:
        """Return plain data."""
        return {**asdict(self), "groups": {name: joints for name, joints in self.groups}}


def shipped_models() -> tuple[ShippedModel, ...]:
    """Return all shipped models, by name."""
    return tuple(_model(name) for name in shipped_names())


def _model(name: str) -> ShippedModel:
    config = load_config(name)
    return ShippedModel(
        name,
        model_description(name),
        config.controller,
        config.generations,
        tuple((group.name, len(group.joints)) for group in config.groups),
        any(d.code == "RG016" for d in config.diagnostics),
    )


def model_description(name: str) -> str:
    """Return a shipped model's own description."""
    path = find_shipped(name)
    root, _ = parse(decode(read_bytes(path, str(path)), str(path)), str(path))
    assert isinstance(root, MappingNode)
    entry = root.entries.get("description")
    return str(entry[1].value) if entry and isinstance(entry[1], ScalarNode) else ""


def variant_named(name: str) -> tuple[Variant, ...]:
    """Return the variants of a shipped model or of a type.

    Raises DiagnosticError (RG009).
    """
    expected = name.casefold().replace(" ", "")
    every = variants()
    result = [v for v in every if expected in (v.model, v.name.casefold().replace(" ", ""))]
    result = result or [v for v in every if expected == model_name(v)]
    result = result or [
        v for v in every if expected and expected in v.name.casefold().replace(" ", "")
    ]
    if result:
        return tuple(result)
    known = [*shipped_names(), *(v.name for v in every)]
    raise refusal(
        "RG009",
        None,
        f"no arm is known as '{name}'",
        (f"{meant}; " if (meant := suggest(name, known)) else "")
        + "`rapidgen robots --all` lists them",
    )


def variant_text(variant: Variant) -> str:
    """Describe axes, reach, coupling and sources of a variant."""
    model = variant.model or ("" if missing_figures(variant) else model_name(variant))
    lines = [variant.name + (f" (model {model})" if model else "")]
    for axis, line in zip(variant.axes, variant.skeleton.lines, strict=True):
        unit = "mm" if line.slides else "deg"
        span = "?" if axis.lower is None else f"{axis.lower:g}..{axis.upper:g} {unit}"
        speed = "? " if axis.speed is None else f"{axis.speed:g} {unit}/s"
        at = ", ".join(f"{v * 1000:g}" for v in line.point)
        marker = f"   unsure: {', '.join(axis.unsure)}" if axis.unsure else ""
        lines.append(f"  {axis.axis:<6} {span:<20} {speed:<12} at {at} mm{marker}")
    lines.append(f"  reach  {reach(variant) * 1000:.0f} mm from axis 1 to the last wrist axis")
    end = ", ".join(f"{v * 1000:g}" for v in variant.skeleton.end)
    lines.append(f"  flange at {end} mm with every axis at 0")
    payload = f"{variant.max_payload:g} kg" if variant.max_payload else "not known"
    lines.append(f"  payload {payload}")
    coupling = "not known" if variant.coupling is None else f"{variant.coupling:g}"
    lines.append(f"  coupling {coupling}")
    if "accelerations" in dict(variant.sources):
        lines.append("  accelerations measured")
    else:
        lines.append(f"  accelerations estimated from its size: {ERROR_BAND}")
    lines += [f"  {what}: {source}" for what, source in variant.sources]
    if variant.unsure:
        lines.append(f"  without a second source: {', '.join(variant.unsure)}")
    if not model:
        lines.append(f"  to be a model it lacks {'; '.join(missing_figures(variant))}")
    lines += [f"  differs: {text}" for text in variant.disagreements]
    return "\n".join(lines)


def reach(variant: Variant) -> float:
    """Return the distance (m) of the wrist from axis 1, arm stretched out."""
    lines = variant.skeleton.lines
    first, across = lines[0], [line.point for line in lines[1:]]
    # ABB measures to the wrist centre: axis 5, or the last of four axes.
    place = 4 if len(lines) == 6 else len(lines) - 2 if len(lines) > 6 else len(lines) - 1
    radial = distance(lines[1], first)
    return radial + sum(dist(a, b) for a, b in pairwise(across[:place]))
