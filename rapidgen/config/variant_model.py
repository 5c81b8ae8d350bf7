"""Configurations of known variants, from robots/variants.json.

Only for an arm with six axes whose dimensions and ranges are in two public sources, and whose
coupling is known; for others the missing figures are reported. Speeds without a source stay open
(RG022).
"""

import re
from math import degrees

from rapidgen._data import data_folder
from rapidgen.config.model import AxisInertia
from rapidgen.config.placeholders import OPEN
from rapidgen.config.variant_library import Variant, variants
from rapidgen.config.vectors import Vector, subtract

PATH = data_folder("robots") / "variants.json"
_INERTIA = ("constant", "elbow", "wrist", "cosine", "sine")
_SIX = tuple(f"rax_{n}" for n in range(1, 7))


def model_name(variant: Variant) -> str:
    """Return the `model:` name of a variant.

    irb6700_155_285 is the IRB 6700-155/2.85 (m by 100).
    """
    head, _, tail = variant.name.partition("/")
    reach = re.match(r"\d+(\.\d+)?", tail)
    if reach:
        size = round(float(reach[0]) * 1000)
        tail = f"{size // 10 if size % 10 == 0 else size}_{tail[reach.end() :]}"
    name = re.sub(r"[^a-z0-9]+", "_", f"{head}_{tail}".casefold().replace(" ", "", 1))
    return name.strip("_")


def names() -> tuple[str, ...]:
    """Return the variants of the library that are models."""
    return tuple(model_name(v) for v in variants() if not v.model and not missing_figures(v))


def named(name: str) -> Variant | None:
    """Return the variant with a model's or type's name, if not shipped."""
    expected = name.casefold().replace(" ", "")
    for variant in variants():
        own = (model_name(variant), variant.name.casefold().replace(" ", ""))
        if not variant.model and expected in own:
            return variant
    return None


def missing_figures(variant: Variant) -> list[str]:
    """Return the figures that a variant lacks for a model."""
    sources = dict(variant.sources)
    result = []
    if tuple(axis.axis for axis in variant.axes) != _SIX:
        result.append("it is no arm with six axes: its rods and passive joints are not known")
    if len(sources.get("chain", "").split(";")) < 2 or "chain" in variant.unsure:
        result.append("a second source of its dimensions")
    if len(sources.get("limits", "").split(";")) < 2:
        result.append("a second source of its ranges")
    if variant.coupling is None:
        result.append("the coupling of axes 2 and 3")
    return result


def label(name: str) -> str:
    """Return the file label of a variant's configuration in findings."""
    return f"model {name}"


def model_text(variant: Variant) -> str:
    """Return a variant's text in the form of the shipped models."""
    lines = [f"description: ABB {variant.name}", "joints:"]
    for axis in variant.axes:
        figures = {"axis": axis.axis}
        figures |= {
            key: OPEN if value is None else f"{value:g}"
            for key, value in (("lower", axis.lower), ("upper", axis.upper), ("speed", axis.speed))
        }
        if axis.acceleration is not None:
            figures["acceleration"] = f"{axis.acceleration:g}"
        if axis.unsure:
            figures["unsure"] = f"[{', '.join(axis.unsure)}]"
        displayed = ", ".join(f"{key}: {value}" for key, value in figures.items())
        lines.append(f"  joint_{axis.axis[-1]}: {{{displayed}}}")
    if variant.inertias:
        lines.append("inertias:")
        lines += [f"  {inertia.axis}: {{{_inertia(inertia)}}}" for inertia in variant.inertias]
    lines.append(f"coupling: {variant.coupling:g}")
    if variant.max_payload:
        lines.append(f"max_payload: {variant.max_payload:g}")
    lines.append("chain:")
    last: Vector = (0.0, 0.0, 0.0)
    for line in variant.skeleton.lines:
        step = f"joint: joint_{line.axis[-1]}, xyz: {_mm(subtract(line.point, last))}, "
        lines.append(f"  - {{{step}axis: {_row(line.direction)}}}")
        last = line.point
    # tool0 of all shipped models: z along axis 6, x down, with every axis at 0.
    lines.append(f"  - {{xyz: {_mm(subtract(variant.skeleton.end, last))}, rpy: [0, 90, 0]}}")
    lines.append("source:")
    lines += [f'  {what}: "{source}"' for what, source in variant.sources]
    if variant.unsure:
        lines.append(f"unsure: [{', '.join(variant.unsure)}]")
    return "\n".join(lines) + "\n"


def _inertia(inertia: AxisInertia) -> str:
    figures = {name: getattr(inertia, name) for name in _INERTIA}
    figures = {"most": degrees(inertia.most)} | figures
    return ", ".join(f"{name}: {value:.6g}" for name, value in figures.items() if value)


def _mm(v: Vector) -> str:
    return _row((v[0] * 1000, v[1] * 1000, v[2] * 1000))


def _row(v: Vector) -> str:
    return f"[{', '.join(f'{round(part, 6) + 0.0:g}' for part in v)}]"
