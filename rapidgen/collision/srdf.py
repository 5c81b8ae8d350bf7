"""SRDF: pairs of links that need no check [MoveIt: disable_collisions link1 link2 reason]."""

from collections.abc import Collection, Iterable, Mapping
from itertools import combinations
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import ParseError, fromstring

from rapidgen._atomic_write import write_whole
from rapidgen._reading import TooLarge, read_foreign
from rapidgen.collision.scene import Scene
from rapidgen.diagnostics import refusal

_LARGEST = 10_000_000
FROM_SRDF = "SRDF: "
"""Begins the reason of a pair that an SRDF disables."""


def read_srdf(folder: Path, name: str) -> list[tuple[str, str, str]]:
    """Return (link, link, reason) of all disabled pairs. Raises DiagnosticError RG833."""
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise refusal("RG833", None, f"{name} is outside of the cell file's folder")
    try:
        data = read_foreign(path, _LARGEST)
    except (OSError, TooLarge) as fault:
        raise refusal("RG833", None, f"{name} cannot be read: {fault}", "export it again") from None
    root = _root(data, name)
    return [
        (pair.get("link1", ""), pair.get("link2", ""), pair.get("reason", "not given"))
        for pair in root.iter("disable_collisions")
    ]


def _root(data: bytes, name: str) -> Element:
    try:
        root: Element = fromstring(data)
    except (ParseError, DefusedXmlException, ValueError) as fault:
        raise refusal(
            "RG833", None, f"{name} cannot be read as SRDF: {fault}", "export it again"
        ) from None
    if root.tag != "robot":
        raise refusal("RG833", None, f"{name} is no SRDF: its root is <{root.tag}>", "export it")
    return root


def disabled_pairs(
    scene: Scene, allowed: Mapping[frozenset[str], str], things: Collection[str]
) -> list[tuple[str, str, str]]:
    """Return (link, link, reason) of all pairs of links that a scene does not check.

    `allowed` are reasons by names of bodies, `things` the names of objects, which are in no
    description. Reasons are those of the cell file or of the SRDF that it reads, else MoveIt's
    "Adjacent": a joint connects the links, or nothing between them moves. Raises DiagnosticError
    RG848 for robots whose links have the same names.
    """
    links = {
        index: body.name.rpartition("/")[2]
        for index, body in enumerate(scene.bodies)
        if body.role == "link" and body.name not in things
    }
    if len(set(links.values())) < len(links):
        raise refusal(
            "RG848",
            None,
            "two robots of the cell have links with the same names",
            "write the SRDF of each robot with a cell file of this robot alone",
        )
    checked = {frozenset((pair.first, pair.second)) for pair in scene.pairs}
    result = []
    for one, other in combinations(links, 2):
        if frozenset((one, other)) not in checked:
            names = frozenset((scene.bodies[one].name, scene.bodies[other].name))
            reason = allowed.get(names, "Adjacent").removeprefix(FROM_SRDF)
            first, second = sorted((links[one], links[other]))
            result.append((first, second, reason))
    return sorted(result)


def srdf_text(robot: str, pairs: Iterable[tuple[str, str, str]], before: bytes = b"") -> str:
    """Return an SRDF with disabled pairs (link, link, reason), sorted by name.

    `before` is an SRDF whose other elements stay. Raises DiagnosticError RG833 if it is none.
    """
    root = _root(before, "the existing file") if before else Element("robot", name=robot)
    for old in root.findall("disable_collisions"):
        root.remove(old)
    for one, other, reason in sorted(pairs):
        SubElement(root, "disable_collisions", link1=one, link2=other, reason=reason)
    indent(root)
    return f'<?xml version="1.0"?>\n{tostring(root, "unicode")}\n'


def write_srdf(path: Path, robot: str, pairs: Iterable[tuple[str, str, str]]) -> None:
    """Write an SRDF file; other elements of an existing one stay.

    Raises OSError, and DiagnosticError RG833 for an existing file that is no SRDF.
    """
    before = read_foreign(path, _LARGEST) if path.exists() else b""
    write_whole(path, srdf_text(robot, pairs, before).encode())
