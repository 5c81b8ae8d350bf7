"""Configurations to start from: commented, and checked before they are written."""

from collections.abc import Sequence
from pathlib import Path

from rapidgen.config.catalogue import model_description
from rapidgen.config.load import load_config
from rapidgen.config.registry import find_shipped
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity

_OPTIONS = """
# What follows is optional; the values shown are the defaults. `rapidgen schema` and
# docs/configuration.md have the rest.
#
# trajectory:
#   capacity: 1000         # points; a longer trajectory is refused whole
#   zone: z10
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


def write_new(
    path: Path, text: str, *, package_paths: Sequence[Path] = (), force: bool = False
) -> tuple[Diagnostic, ...]:
    """Write a new configuration once it loads; its warnings.

    Raises DiagnosticError when the file exists (RG020, unless `force`), cannot be written
    (RG001), or does not load; in the last case nothing is left behind.
    """
    if path.exists() and not force:
        raise DiagnosticError(
            Diagnostic(
                "RG020",
                Severity.ERROR,
                f"{path} exists",
                help="give another name, or --force to replace it",
            ),
            exit_code=1,
        )
    before = path.read_bytes() if path.is_file() else None
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as fault:
        raise DiagnosticError(
            Diagnostic("RG001", Severity.ERROR, f"cannot write {path}: {fault.strerror}")
        ) from None
    try:
        return load_config(path, package_paths=package_paths).diagnostics
    except DiagnosticError:
        if before is None:
            path.unlink()
        else:
            path.write_bytes(before)
        raise
