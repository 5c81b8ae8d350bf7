"""Configurations to start from: commented, and checked before they are written."""

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen._writing import write_whole
from rapidgen.config import schema
from rapidgen.config.catalogue import model_description
from rapidgen.config.draft import GroupDraft, JointDraft
from rapidgen.config.load import load_config
from rapidgen.config.registry import find_shipped
from rapidgen.config.urdf.group import complete_from, request
from rapidgen.config.urdf.source import macros, read_xml
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, refusal

_OPTIONS = """
# What follows is optional; the values shown are the defaults. `rapidgen schema` and
# docs/start/configuration.md have the rest.
#
# trajectory:
#   capacity: 1000         # points; a longer trajectory is refused whole
#   zone: z50              # corners at most as large; as small as the axes follow
#   start_tolerance: 0.5   # deg between the robot and the first point
#   too_fast: refuse       # or slow_down
# state:
#   rate: 10               # Hz
# network:
#   bind: lan              # or service, or an address
#   allowed_clients: []    # addresses that may connect; empty: all
# commissioning: false     # true while setting up: background tasks can be stopped and edited
# main: driver             # own: your main calls the driver's entry routine
"""
_GROUP_OPTIONS = """# ports: {motion: 11000, control: 11001, state: 11002}
# tool:
#   name: gripper
#   frame: {position: [0, 0, 120], orientation: [1, 0, 0, 0]}   # mm, quaternion
#   load: {mass: 1.2, centre: [0, 0, 50]}                       # kg, mm
# tcp_speed_limit: 5000    # mm/s
"""


def from_shipped(name: str) -> str:
    """Configuration text for a shipped model."""
    find_shipped(name)
    config = load_config(name)
    major, minor = config.robotware
    lines = [
        f"# {model_description(name)}",
        f"model: {name}",
        "controller:",
        f"  type: {config.controller}",
        f"  robotware: {major}.{minor:02d}        # see the FlexPendant: Settings or System Info",
    ]
    text = "\n".join(lines) + "\n" + _OPTIONS
    if len(config.groups) == 1:
        return text + _GROUP_OPTIONS + _limits_hint(config.groups[0].joints[0].name)
    names = ", ".join(group.name for group in config.groups)
    first = config.groups[0]
    return text + (
        f"# groups:                  # {names}\n"
        f"#   {first.name}:\n"
        f"#     ports: {{motion: {first.ports.motion}, control: {first.ports.control}, "
        f"state: {first.ports.state}}}\n"
    )


def _limits_hint(joint: str) -> str:
    return (
        "# joints:                  # your limits over the model's, never wider than the robot's\n"
        f'#   {joint}: {{lower: -90, upper: 90, source: "fence of the cell"}}\n'
    )


def from_urdf(
    urdf: Path,
    *,
    folder: Path,
    package_paths: Sequence[Path] = (),
    macro: str | None = None,
    arguments: Mapping[str, str] | None = None,
    macro_arguments: Mapping[str, str] | None = None,
    tip: str | None = None,
) -> str:
    """Configuration text for a robot description; `folder` is where the file will lie.

    A file with one macro is called through it, and a robot of a coupled family gets its
    coupling; whatever else cannot be known raises DiagnosticError with the lines to paste.
    """
    given = schema.UrdfKeys(
        file=_relative(urdf, folder),
        macro=macro,
        macro_args=dict(macro_arguments or {}),
        args=dict(arguments or {}),
        tip=tip,
    )
    text, _ = read_xml(urdf)
    coupling: float | None = None
    while True:
        draft = GroupDraft("rob1", coupling=coupling)
        wanted = request(given, folder, package_paths, None)
        found, _ = complete_from(draft, given, wanted, frozenset())
        errors = [d for d in found if d.severity is Severity.ERROR]
        codes = {d.code for d in errors}
        defined = macros(text)
        if codes == {"RG031"} and len(defined) == 1 and not given.macro:
            given = replace(given, macro=defined[0].name)
        elif codes == {"RG047"} and coupling is None:
            coupling = 1.0
        elif errors:
            raise DiagnosticError(errors)
        else:
            break
    return _urdf_text(given, draft, _packages(wanted.packages.used, folder))


def _packages(used: Mapping[str, Path], folder: Path) -> dict[str, str]:
    return {name: _relative(path, folder) for name, path in sorted(used.items())}


def _relative(path: Path, folder: Path) -> str:
    return os.path.relpath(path.resolve(), folder.resolve())


def _urdf_text(given: schema.UrdfKeys, draft: GroupDraft, packages: Mapping[str, str]) -> str:
    quoted = json.dumps  # a JSON text is a YAML text
    lines = [
        f"# Made from {Path(given.file).name}. Check every axis against the robot before it moves.",
        "controller:",
        "  type: irc5               # or irc5_compact, omnicore",
        "  robotware: 6.15          # see the FlexPendant: Settings or System Info",
        "urdf:",
        f"  file: {quoted(given.file)}",
    ]
    lines += [f"  macro: {given.macro}"] if given.macro else []
    lines += [f"  macro_args: {quoted(given.macro_args)}"] if given.macro_args else []
    lines += [f"  tip: {quoted(given.tip)}"] if given.tip else []
    lines += [f"  args: {quoted(given.args)}"] if given.args else []
    lines += [f"  packages: {quoted(packages)}"] if packages else []
    lines.append("joints:                    # in the order of the wire; limits from the URDF")
    lines += [f"  {_joint_line(joint)}" for joint in draft.joints]
    lines.append(
        f"coupling: {draft.coupling or 0:g}                # 1 where a rod couples axes 2 and 3"
    )
    return "\n".join(lines) + "\n" + _OPTIONS + _GROUP_OPTIONS


def _joint_line(joint: JointDraft) -> str:
    name = joint.name if joint.name.isidentifier() else json.dumps(joint.name)
    unit = ", unit: mm" if joint.unit == "mm" else ""
    of = joint.unit or "deg"
    lower, upper = (math.floor((v or 0) * 100 + 0.5) / 100 for v in (joint.lower, joint.upper))
    return (
        f"{name}: {{axis: {joint.axis}{unit}}}   "
        f"# {lower:g}..{upper:g} {of}, {joint.speed or 0:.4g} {of}/s"
    )


def assignments(words: Sequence[str]) -> dict[str, str]:
    """NAME=VALUE words; anything else raises DiagnosticError (RG020)."""
    made = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not name or not equals:
            raise refusal("RG020", None, f"'{word}' is not NAME=VALUE")
        made[name] = value
    return made


def write_new(
    path: Path, text: str, *, package_paths: Sequence[Path] = (), force: bool = False
) -> tuple[Diagnostic, ...]:
    """Write a new configuration once it loads; its warnings.

    Raises DiagnosticError when the file exists (RG020, unless `force`), cannot be written
    (RG001), or does not load; in the last case nothing is left behind.
    """
    if path.exists() and not force:
        raise refusal(
            "RG020",
            None,
            f"{path} exists",
            "give another name, or --force to replace it",
            exit_code=1,
        )
    before = path.read_bytes() if path.is_file() else None
    try:
        write_whole(path, text.encode())
    except OSError as fault:
        raise refusal(
            "RG001",
            None,
            f"cannot write {path}: {fault.strerror}",
            "name a file in a folder that exists and may be written",
        ) from None
    try:
        return load_config(path, package_paths=package_paths).diagnostics
    except DiagnosticError:
        if before is None:
            path.unlink()
        else:
            write_whole(path, before)
        raise
