"""Visuals of the links of a robot description [ROS: urdf/XML/link].

A mesh is found as in ROS: `package://PACKAGE/PATH`, `file://PATH`, or relative to the description's
folder. It must be in its package, in the description's package or folder, or in the configuration's
folder. A link may lead out of a package to the same package's sources: `colcon build
--symlink-install` makes such.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias
from urllib.parse import unquote

from rapidgen.config.urdf.expand import Description
from rapidgen.config.urdf.packages import PackageNotFound, Packages, package_name, package_of

if TYPE_CHECKING:
    from lxml.etree import _Element as Element

SUFFIXES = frozenset({".stl", ".dae", ".obj"})
MOST = 2000
"""Maximum number of visuals in a description; further ones are not drawn."""
Kind: TypeAlias = Literal["box", "cylinder", "sphere", "mesh"]
Vector = tuple[float, float, float]
_SIZES: Mapping[Kind, tuple[str, ...]] = {
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
}


class NoMesh(Exception):
    """A mesh cannot be read; the text gives the reason."""


@dataclass(frozen=True, slots=True)
class Visual:
    """A shape in the frame of its link: m, rad, colour as red, green, blue, opacity 0..1."""

    kind: Kind
    size: tuple[float, ...]
    """Box x, y, z; cylinder radius, length; sphere radius; of a mesh factors for x, y, z."""
    xyz: Vector
    rpy: Vector
    colour: tuple[float, ...] = ()
    """Empty: not in the description."""
    mesh: Path | None = None
    fault: str = ""
    """Reason of a missing mesh."""


def visuals(
    description: Description,
    packages: Packages,
    folder: Path,
    tag: Literal["visual", "collision"] = "visual",
) -> dict[str, tuple[Visual, ...]]:
    """Return the visuals of each link that has some, or its collision geometry by `tag`.

    `read_robot` must accept the description; `folder` is the configuration's.
    """
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    root = etree.fromstring(description.text.encode(), parser)
    named = {m.get("name", ""): _colour(m) for m in root.iterchildren("material")}

    def files(name: str) -> Path:
        return mesh_file(name, description.path, packages, folder)

    result: dict[str, tuple[Visual, ...]] = {}
    left = MOST
    for link in root.iterchildren("link"):
        own = tuple(_visuals(link, named, files, tag))[:left]
        left -= len(own)
        if own:
            result[link.get("name", "")] = own
    return result


def _visuals(
    link: "Element",
    named: Mapping[str, tuple[float, ...]],
    files: Callable[[str], Path],
    tag: str,
) -> Iterator[Visual]:
    for visual in link.iterchildren(tag):
        geometry, material = visual.find("geometry"), visual.find("material")
        shape = next(iter(geometry), None) if geometry is not None else None
        if shape is None:
            continue
        own = _colour(material) if material is not None else ()
        colour = own or (named.get(material.get("name", ""), ()) if material is not None else ())
        origin = visual.find("origin")
        xyz = _numbers(origin, "xyz", 3) or (0.0, 0.0, 0.0)
        rpy = _numbers(origin, "rpy", 3) or (0.0, 0.0, 0.0)
        place: tuple[Vector, Vector] = ((xyz[0], xyz[1], xyz[2]), (rpy[0], rpy[1], rpy[2]))
        if shape.tag == "mesh":
            scale = _numbers(shape, "scale", 3) or (1.0, 1.0, 1.0)
            try:
                yield Visual("mesh", scale, *place, colour, files(shape.get("filename", "")))
            except NoMesh as why:
                yield Visual("mesh", scale, *place, colour, fault=str(why))
        for kind, names in _SIZES.items():
            if shape.tag == kind:
                counts = [3 if name == "size" else 1 for name in names]
                parts = [_numbers(shape, *part) for part in zip(names, counts, strict=True)]
                if all(parts):
                    yield Visual(kind, tuple(chain.from_iterable(parts)), *place, colour)


def mesh_file(name: str, description: Path, packages: Packages, folder: Path) -> Path:
    """Return the file of a mesh in a description.

    `folder` is the configuration's. Raises NoMesh if the file is missing or not allowed.
    """
    home = package_of(description.parent) or description.resolve().parent
    inner = description.resolve().is_relative_to(folder.resolve())
    roots = [home, folder] if inner else [home]
    scheme, colon, remaining = name.partition("://")
    if not colon:
        return _within(roots, description.parent / name, name)
    if scheme == "file":
        return _within([*roots, *packages.used.values()], Path(unquote(remaining)), name)
    if scheme != "package":
        raise NoMesh(f"'{name}': meshes are package://, file:// or in the description's folder")
    package, _, inside = remaining.partition("/")
    try:
        result = packages.find(package)
    except PackageNotFound as fault:
        raise NoMesh(str(fault)) from fault
    return _within([result], result / inside, name)


def mesh_in_folder(name: str, folder: Path) -> Path:
    """Return a mesh in a folder or below it.

    Raises NoMesh.
    """
    return _within([folder], folder / name, name)


def _within(roots: Sequence[Path], path: Path, name: str) -> Path:
    if path.suffix.lower() not in SUFFIXES:
        raise NoMesh(f"'{name}' is no STL, DAE or OBJ")
    try:
        real = path.resolve(strict=True)
        is_file = real.is_file() and real.suffix.lower() in SUFFIXES
    except (OSError, RuntimeError, ValueError) as fault:
        raise NoMesh(f"'{name}' is not there") from fault
    if not is_file:
        raise NoMesh(f"'{name}' is no file")
    home = package_of(real.parent)
    for root in roots:
        same = home is not None and package_name(home) == package_name(root) != ""
        if real.is_relative_to(root.resolve()) or same:
            return real
    raise NoMesh(f"'{name}' is outside of {roots[0]}")


def _colour(material: "Element") -> tuple[float, ...]:
    values = _numbers(material.find("color"), "rgba", 4)
    return tuple(min(1.0, max(0.0, value)) for value in values)


def _numbers(element: "Element | None", name: str, count: int) -> tuple[float, ...]:
    """Return the finite numbers of an attribute, or an empty tuple."""
    try:
        values = tuple(
            float(word) for word in (element.get(name, "") if element is not None else "").split()
        )
    except ValueError:
        return ()
    return values if len(values) == count and all(map(math.isfinite, values)) else ()
