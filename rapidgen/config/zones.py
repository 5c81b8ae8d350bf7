"""Zones of a cell file: volumes that robots keep inside of, or out of."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from rapidgen.config.draft import DraftFindings
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.rules import Rule
from rapidgen.config.schema import StrictModel, Vector


@dataclass(frozen=True)
class ZoneBoxKeys(StrictModel):
    """A box from corner to corner, along the axes of the world."""

    low: Annotated[Vector, Rule("Corner with the lowest x, y, z in mm.")]
    high: Annotated[Vector, Rule("Corner with the highest x, y, z in mm.")]


@dataclass(frozen=True)
class ZoneCylinderKeys(StrictModel):
    """A vertical cylinder."""

    base: Annotated[Vector, Rule("Centre of its lower end in mm.")]
    radius: Annotated[float, Rule("mm", gt=0)]
    height: Annotated[float, Rule("mm", gt=0)]


@dataclass(frozen=True)
class ZoneSphereKeys(StrictModel):
    """A sphere."""

    centre: Annotated[Vector, Rule("mm")]
    radius: Annotated[float, Rule("mm", gt=0)]


@dataclass(frozen=True)
class ZoneKeys(StrictModel):
    """A zone that robots keep inside of, or out of: a box, a cylinder or a sphere."""

    keep: Annotated[Literal["inside", "out"], Rule("What a robot has to do.")]
    box: Annotated[ZoneBoxKeys | None, Rule("Its box.")] = None
    cylinder: Annotated[ZoneCylinderKeys | None, Rule("Its vertical cylinder.")] = None
    sphere: Annotated[ZoneSphereKeys | None, Rule("Its sphere.")] = None
    of: Annotated[
        list[str],
        Rule(
            "`tcp` (the flange without a tool), `all`, or names of links and tools.", min_length=1
        ),
    ] = field(default_factory=lambda: ["all"])


def check_zones(zones: Mapping[str, ZoneKeys], report: DraftFindings) -> None:
    """Report zones without exactly one volume, or with sides of length 0 (RG832)."""
    for name, zone in zones.items():
        path: KeyPath = ("zones", name)
        given = [kind for kind in ("box", "cylinder", "sphere") if getattr(zone, kind) is not None]
        if len(given) != 1:
            named = " and ".join(given) or "no volume"
            report.error(
                "RG832", f"{name} has {named}", path, help="give one of box, cylinder, sphere"
            )
        elif zone.box is not None and any(
            low >= high for low, high in zip(zone.box.low, zone.box.high, strict=True)
        ):
            report.error(
                "RG832", f"{name}: each of low has to be below that of high", (*path, "box")
            )
