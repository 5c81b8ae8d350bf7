"""Appearance of robots in a recording: drawings and their meshes.

Meshes are attachments, each once, named by the hash of their content. A file may be of any origin:
a drawing that does not fit the robots, or a mesh that does not match its name, is not drawn, and
this is reported.
"""

import hashlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Final

from pydantic import ValidationError

from rapidgen.axes.frames import Pose
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.config.urdf.source import xml_fault
from rapidgen.viewer.appearance import Appearance
from rapidgen.viewer.messages import SeenThing
from rapidgen.viewer.primitive_urdf import Drawing
from rapidgen.viewer.recording.messages import Recorded

MOST: Final = 64_000_000
"""Largest size of all meshes of a recording, bytes."""
_MESH = re.compile(r"mesh-([0-9a-f]{20})(\.stl|\.obj|\.dae)", re.ASCII)


class RecordedAppearance(Recorded):
    """`Appearance` without the meshes."""

    drawings: dict[str, Drawing]
    things: tuple[SeenThing, ...]
    bases: dict[str, Pose]
    faults: tuple[str, ...]


def carried(look: Appearance, most: int = MOST) -> Appearance:
    """Return the meshes to record, in order, up to the size limit."""
    files: dict[str, bytes] = {}
    left: list[int] = []
    remaining = most
    for name, data in look.files.items():
        if len(data) > remaining:
            left.append(len(data))
        else:
            remaining -= len(data)
            files[name] = data
    if not left:
        return look
    text = (
        f"{len(left)} of {len(look.files)} meshes ({sum(left) / 1e6:.1f} MB) are not in the "
        f"recording: it carries {most / 1e6:.0f} MB of them"
    )
    return replace(_with(look, files), faults=(*look.faults, text))


def written(look: Appearance) -> bytes:
    """Return everything except the meshes, as JSON."""
    result = RecordedAppearance(
        drawings=dict(look.drawings), things=look.things, bases=dict(look.bases), faults=look.faults
    )
    return result.model_dump_json().encode()


def read(data: bytes, meshes: Mapping[str, bytes], groups: Iterable[GroupConfig]) -> Appearance:
    """Read the stored appearance. Raises ValueError."""
    try:
        result = RecordedAppearance.model_validate_json(data)
    except ValidationError as error:
        fault = error.errors(include_url=False, include_input=False)[0]
        raise ValueError(fault["msg"]) from error
    drawings, faults = {}, list(result.faults)
    for group in groups:
        drawing = result.drawings.get(group.name)
        if drawing is not None and (why := _misfit(drawing, group)):
            faults.append(f"the drawing of {group.name} is not its own: {why}")
        elif drawing is not None:
            drawings[group.name] = drawing
    files = {name: mesh for name, mesh in meshes.items() if _is_mesh(name, mesh)}
    if len(files) < len(meshes):
        faults.append(f"{len(meshes) - len(files)} meshes are damaged")
    look = Appearance(drawings, {}, tuple(faults), result.things, result.bases)
    return _with(look, files)


def _with(look: Appearance, files: Mapping[str, bytes]) -> Appearance:
    """Return an appearance with these meshes; solids replace others."""

    def known(name: re.Match[str]) -> str:
        return name[0] if name[0] in files else ""

    drawings = {
        name: replace(drawing, urdf=_MESH.sub(known, drawing.urdf))
        for name, drawing in look.drawings.items()
    }
    things = tuple(
        thing
        for thing in look.things
        if all(shape.mesh in files for shape in thing.shapes if shape.kind == "mesh")
    )
    return replace(look, drawings=drawings, things=things, files=MappingProxyType(dict(files)))


def _misfit(drawing: Drawing, group: GroupConfig) -> str:
    names = JointMap.of(group).names
    if drawing.movable[: len(names)] != names:
        return "it has other joints"
    if len(drawing.movable) != len(names) + len(drawing.passive):
        return "it has other passive joints"
    if not all(0 <= i < len(names) for terms in drawing.passive for i, _ in terms):
        return "a joint follows one that is not there"
    return xml_fault(drawing.urdf.encode())


def _is_mesh(name: str, data: bytes) -> bool:
    text = _MESH.fullmatch(name)
    if text is None or hashlib.sha256(data).hexdigest()[:20] != text[1]:
        return False
    return text[2] != ".dae" or not xml_fault(data)
