"""Generate initial configurations: commented, checked before written."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen._atomic_write import write_whole
from rapidgen.config import schema
from rapidgen.config.catalogue import model_description
from rapidgen.config.draft import DescriptionChoices
from rapidgen.config.load import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.config.placeholders import OPEN
from rapidgen.config.registry import find_shipped
from rapidgen.config.variant_library import Variant, variants
from rapidgen.config.variant_model import model_name, named
from rapidgen.config.yaml_text import yaml_flow, yaml_text
from rapidgen.diagnostics import Diagnostic, DiagnosticError, refusal

if TYPE_CHECKING:
    from rapidgen.config.from_description import GroupText

_IRC5, _OMNICORE = ("irc5", "6.15"), ("omnicore", "7.10")
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


def from_model(name: str, message: DescriptionChoices | None = None) -> str:
    """Return the configuration text of a shipped model or a known variant."""
    find_shipped(name)
    variant = named(name)
    if variant:
        return _from_variant(variant, message or DescriptionChoices())
    config = load_config(name)
    lines = [
        f"# {model_description(name)}",
        f"model: {name}",
        *_controller(message or DescriptionChoices(), _delivered(config)),
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


def _from_variant(variant: Variant, message: DescriptionChoices) -> str:
    """Return the configuration text of a variant.

    Controller and speeds come from the user, or stay open.
    """
    lines = [
        f"# ABB {variant.name}, from public sources: `rapidgen robots show {model_name(variant)}`.",
        f"model: {model_name(variant)}",
        *_controller(message, _of_family(variant.family)),
    ]
    slow = [axis.axis for axis in variant.axes if axis.speed is None]
    speed = OPEN if message.speed is None else f"{message.speed:g}"
    if slow:
        lines.append("joints:                    # no public source has their speeds, deg/s")
        lines += [f"  joint_{axis[-1]}: {{speed: {speed}}}" for axis in slow]
    return "\n".join(lines) + "\n" + _OPTIONS + _GROUP_OPTIONS + _limits_hint("joint_1")


def _delivered(config: RobotConfig) -> tuple[str, str]:
    major, minor = config.robotware
    return config.controller, f"{major}.{minor:02d}"


def _of_family(known: str) -> tuple[str, str]:
    """Return controller and RobotWare of a type that IRC5 does not support."""
    for variant in variants():
        if known and variant.model and variant.family == known:
            config = load_config(variant.model)
            if config.generations and not {5, 6} & set(config.generations):
                return _delivered(config)
    return _IRC5


def _controller(message: DescriptionChoices, own: tuple[str, str]) -> list[str]:
    """Return the user's controller keys, completed by the robot's defaults."""
    if message.controller:
        is_omnicore = message.controller == "omnicore"
    elif message.robotware:
        is_omnicore = message.robotware.partition(".")[0] in ("7", "8")
    else:
        is_omnicore = own[0] == "omnicore"
    if is_omnicore != (own[0] == "omnicore"):
        own = _OMNICORE if is_omnicore else _IRC5
    name, version = message.controller or own[0], message.robotware or own[1]
    return [
        "controller:",
        f"  type: {name:<20}# irc5, irc5_compact, omnicore",
        f"  robotware: {version:<15}# see the FlexPendant: Settings or System Info",
    ]


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
    answers: DescriptionChoices | None = None,
) -> str:
    """Return the configuration text of a robot description.

    `folder` is the folder of the new file. Unknown values are marked `???`. Raises DiagnosticError
    for a description without an ABB robot.
    """
    from rapidgen.config.from_description import describe  # slow import, only for URDF

    message = answers or DescriptionChoices()
    if not str(urdf).isprintable():
        raise refusal(
            "RG020",
            None,
            f"the name {urdf.name!a} has non-printable characters",
            "give the file another name",
        )
    value = schema.UrdfKeys(
        file=_relative(urdf, folder),
        macro=macro,
        macro_args=dict(macro_arguments or {}),
        args=dict(arguments or {}),
    )
    value, groups, used = describe(urdf, folder, package_paths, value, message)
    packages = {name: _relative(path, folder) for name, path in sorted(used.items())}
    lines = [
        f"# Made from {Path(value.file).name}. Check every axis against the robot before it moves.",
        *_controller(message, _of_family(groups[0].family)),
    ]
    source = [f"  file: {yaml_flow(value.file)}"]
    source += [f"  macro: {yaml_text(value.macro)}"] if value.macro else []
    source += [f"  macro_args: {yaml_flow(value.macro_args)}"] if value.macro_args else []
    source += [f"  args: {yaml_flow(value.args)}"] if value.args else []
    source += [f"  packages: {yaml_flow(packages)}"] if packages else []
    source += [f"  ignore_joints: {yaml_flow(message.ignore)}"] if message.ignore else []
    several = len(groups) > 1
    lines += ["groups:"] if several else []
    for group in groups:
        lines += [f"  {group.name}:"] if several else []
        lines += [f"{'    ' if several else ''}{line}" for line in _group_lines(group, source)]
    return "\n".join(lines) + "\n" + _OPTIONS + ("" if several else _GROUP_OPTIONS)


def _group_lines(group: "GroupText", source: Sequence[str]) -> list[str]:
    words = [line for line in group.head if line.startswith("#")]
    tips = [f"  {line}" for line in group.head if not line.startswith("#")]
    width = max(len(line.text(0).split("  #")[0]) for line in group.joints)
    return [
        *words,
        *group.tasks,
        "urdf:",
        *source,
        *tips,
        "joints:                    # in the order of the wire; limits from the URDF",
        *(f"  {line.text(width)}" for line in group.joints),
        *group.tail,
    ]


def _relative(path: Path, folder: Path) -> str:
    return os.path.relpath(path.resolve(), folder.resolve())


def assignments(words: Sequence[str]) -> dict[str, str]:
    """Parse NAME=VALUE words.

    Raises DiagnosticError (RG020).
    """
    made = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not name or not equals:
            raise refusal("RG020", None, f"'{word}' is not NAME=VALUE", "such as joint_1=rax_1")
        made[name] = value
    return made


def ranges(words: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Parse LOWER..UPPER or NAME=LOWER..UPPER words, by name.

    Raises DiagnosticError (RG020).
    """
    made = {}
    for word in words:
        name, _, figures = word.rpartition("=")
        lower, _, upper = figures.partition("..")
        try:
            made[name] = float(lower), float(upper)
        except ValueError:
            text = f"'{word}' is not LOWER..UPPER or NAME=LOWER..UPPER"
            raise refusal("RG020", None, text, "such as joint_1=-170..170") from None
        if not made[name][0] < made[name][1]:
            raise refusal("RG020", None, f"'{word}': lower is not below upper", "swap the two")
    return made


def write_new(
    path: Path, text: str, *, package_paths: Sequence[Path] = (), force: bool = False
) -> tuple[Diagnostic, ...]:
    """Write a new configuration, load it, and return its warnings.

    Raises DiagnosticError when the file exists (RG020, unless `force`), cannot be written (RG001),
    or does not load: then the file stays there for correction, and the exit code is 1.
    """
    if path.exists() and not force:
        raise refusal(
            "RG020",
            None,
            f"{path} exists",
            "give another name, or --force to replace it",
            exit_code=1,
        )
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
    except DiagnosticError as fault:
        raise DiagnosticError(fault.diagnostics, exit_code=1) from None
