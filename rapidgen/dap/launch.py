"""Arguments of a launch request, read into one frozen value."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

from rapidgen._json import Members
from rapidgen.dap.client import RequestRefused, flag, members, number, text, texts
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable

FASTEST = 1000.0
"""Largest factor of real time."""


@dataclass(frozen=True, slots=True)
class Launch:
    """What a user wants to debug."""

    targets: tuple[str, ...]
    """Modules, a folder, a backup, a generated folder, a configuration or a shipped name."""
    tasks: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Files of separate tasks."""
    robot: str = ""
    robotware: str = ""
    entry: str = ""
    cell: str = ""
    start: str = ""
    """Start position of the first robot, deg and mm, with commas."""
    backup: Path | None = None
    overrides: tuple[str, ...] = ()
    answers: Path | None = None
    """Script of the operator's answers."""
    speed: float = 1.0
    """Simulated seconds per second; 0: the virtual clock, as fast as possible, without sockets."""
    cycle: Literal["once", "forever", ""] = ""
    """Empty: once for programs, forever for a generated driver."""
    stop_on_entry: bool = False
    check: bool = True
    page: bool = False
    """Serve the page that shows the robot."""
    debug: bool = True
    """False: run without breakpoints."""


Loader: TypeAlias = Callable[[Launch], "Bootable"]
"""Reads the files of a launch; DiagnosticError."""


def read_launch(arguments: Members) -> Launch:
    """Check the arguments of a launch request.

    Relative paths begin at `cwd`. RequestRefused: one has a wrong type. DiagnosticError RG942: a
    value is not possible.
    """
    here = Path(text(arguments, "cwd", "") or ".")
    speed, cycle = number(arguments, "speed", 1.0), text(arguments, "cycle", "")
    if not (math.isfinite(speed) and 0 <= speed <= FASTEST):
        raise _impossible(f"speed {speed:g} is outside 0 to {FASTEST:g}", "1 is real time")
    if cycle not in ("", "once", "forever"):
        raise _impossible(f"cycle '{cycle}' does not exist", 'use "once" or "forever"')
    tasks = {name: _paths(here, texts(given, name)) for given in [members(arguments, "tasks")]
             for name in given}  # fmt: skip
    targets = _paths(here, texts(arguments, "program"))
    if not any(targets) and not tasks:
        raise _impossible(
            "the launch has no program", 'set "program" to a module, a folder or a configuration'
        )
    backup, answers = text(arguments, "backup", ""), text(arguments, "answers", "")
    cell = text(arguments, "cell", "")
    return Launch(
        targets,
        tasks,
        robot=_path(here, text(arguments, "robot", "")),
        robotware=text(arguments, "robotware", ""),
        entry=text(arguments, "entry", ""),
        cell=_path(here, cell),
        start=_start(arguments),
        backup=here / backup if backup else None,
        overrides=tuple(texts(arguments, "set")),
        answers=here / answers if answers else None,
        speed=speed,
        cycle="once" if cycle == "once" else "forever" if cycle else "",
        stop_on_entry=flag(arguments, "stopOnEntry", default=False),
        check=flag(arguments, "check", default=True),
        page=flag(arguments, "view", default=False),
        debug=not flag(arguments, "noDebug", default=False),
    )


def _start(arguments: Members) -> str:
    value = arguments.get("start", "")
    if isinstance(value, list) and all(
        isinstance(one, int | float) and not isinstance(one, bool) for one in value
    ):
        return ",".join(str(one) for one in value)
    if not isinstance(value, str):
        raise RequestRefused("'start' is neither a text nor a list of numbers")
    return value


def _paths(here: Path, names: Sequence[str]) -> tuple[str, ...]:
    return tuple(_path(here, name) for name in names)


def _path(here: Path, name: str) -> str:
    """Return a path that exists as an absolute one; a shipped name as it is."""
    try:
        return str((here / name).absolute()) if name and (here / name).exists() else name
    except ValueError as error:  # a zero byte
        raise RequestRefused(f"{name!r} is no path") from error


def _impossible(message: str, help: str) -> Exception:
    return refusal("RG942", None, message, help)
