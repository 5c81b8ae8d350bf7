"""SRDF: pairs of links that need no check [MoveIt: disable_collisions link1 link2 reason]."""

from collections.abc import Iterable
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import ParseError, fromstring

from rapidgen._atomic_write import write_whole
from rapidgen._reading import TooLarge, read_foreign
from rapidgen.diagnostics import refusal

_LARGEST = 10_000_000


def read_srdf(folder: Path, name: str) -> list[tuple[str, str, str]]:
    """Return (link, link, reason) of all disabled pairs. Raises DiagnosticError RG833."""
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise refusal("RG833", None, f"{name} is outside of the cell file's folder")
    try:
        root = fromstring(read_foreign(path, _LARGEST))
    except (OSError, TooLarge, ParseError, DefusedXmlException, ValueError) as fault:
        raise refusal(
            "RG833", None, f"{name} cannot be read as SRDF: {fault}", "export it again"
        ) from None
    return [
        (pair.get("link1", ""), pair.get("link2", ""), pair.get("reason", "not given"))
        for pair in root.iter("disable_collisions")
    ]


def srdf_text(robot: str, pairs: Iterable[tuple[str, str, str]]) -> str:
    """Return an SRDF with disabled pairs (link, link, reason), sorted by name."""
    root = Element("robot", name=robot)
    for one, other, reason in sorted(pairs):
        SubElement(root, "disable_collisions", link1=one, link2=other, reason=reason)
    indent(root)
    return f'<?xml version="1.0"?>\n{tostring(root, "unicode")}\n'


def write_srdf(path: Path, robot: str, pairs: Iterable[tuple[str, str, str]]) -> None:
    """Write an SRDF file. Raises OSError."""
    write_whole(path, srdf_text(robot, pairs).encode())
