"""What `rapidgen new` asks in a terminal: a robot, then what the description leaves open."""

import re
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import typer

from rapidgen.config.from_description import DescriptionChoices
from rapidgen.config.placeholders import OPEN
from rapidgen.config.scaffold import ranges
from rapidgen.diagnostics import DiagnosticError, render

_JOINT = re.compile(r'^\s*("[^"]*"|\w+): \{axis: ("\?{3}"|\w+)', re.MULTILINE)
_SHOWN = re.compile(r"^\s*(?:#.*|tip: .*|rob\w+:|(?:\"[^\"]*\"|\w+): \{axis: .*|coupling: .*)$")
_AXES = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6", "eax_a", "ignore")


def is_terminal() -> bool:
    """Whether a person can answer."""
    return sys.stdin.isatty() and sys.stderr.isatty()


def ask_source() -> tuple[str | None, Path | None]:
    """A shipped model or a description."""
    given = typer.prompt(
        "Robot (a name of `rapidgen robots`) or URDF file", default="irb120", err=True
    )
    path = Path(given)
    return (None, path) if path.suffix or path.exists() else (given, None)


def drawn(text: str) -> str:
    """The arms of a configuration's text as a chain, from the base to the flange."""
    lines = []
    for line in text.split("# What follows")[0].splitlines():
        if not _SHOWN.match(line) or line.startswith("# Made from"):
            continue
        hit = _JOINT.match(line)
        if hit:
            figures = line.partition("#")[2].strip()
            lines.append(f"  | {hit[2].replace(OPEN, '?'):<6} {hit[1]}  {figures}".rstrip())
        else:
            lines.append(line.strip("# "))
    return "\n".join(lines)


def ask_open(
    make: Callable[[DescriptionChoices], str], answers: DescriptionChoices
) -> DescriptionChoices:
    """Show what is known, and ask until nothing is open that one answer settles."""
    text = make(answers)
    typer.echo(drawn(text), err=True)
    while left := [joint for joint, axis in _axes(text) if axis == OPEN]:
        joint = left[0]
        in_use = {axis for _, axis in _axes(text)}
        usual = next((axis for axis in _AXES if axis not in in_use), "ignore")
        given = _choice(f"Axis of {joint}", _AXES, usual)
        if given == "ignore":
            answers = replace(answers, ignore=(*answers.ignore, joint))
        else:
            answers = replace(answers, joints={**answers.joints, joint: given})
        text = make(answers)  # where the others are told by it, they are not asked for
    if f"lower: {OPEN}" in text:
        answers = replace(answers, ranges={**answers.ranges, **_ranges(text)})
    if f"coupling: {OPEN}" in text:
        rod = _choice("Does a rod couple axes 2 and 3 (0 no, 1 yes)", ("0", "1"), "")
        answers = replace(answers, coupling=float(rod))
    if f"speed: {OPEN}" in text:
        speed = typer.prompt(
            "Largest speed of the axes without one, deg/s (mm/s)", type=float, err=True
        )
        answers = replace(answers, speed=speed)
    return answers


def _axes(text: str) -> list[tuple[str, str]]:
    return [(hit[1].strip('"'), hit[2]) for hit in _JOINT.finditer(text)]


def _ranges(text: str) -> dict[str, tuple[float, float]]:
    """The ranges that a person knows, the last one offered again for the next turning joint."""
    made: dict[str, tuple[float, float]] = {}
    usual = ""
    for line in text.splitlines():
        hit = _JOINT.match(line)
        if not hit or f"lower: {OPEN}" not in line:
            continue
        name = hit[1].strip('"')
        unit = "mm" if "unit: mm" in line else "deg"
        while True:
            question = f"Range of {name}, {unit}, LOWER..UPPER (. leaves it open)"
            default = usual if unit == "deg" and usual else "."
            given = str(typer.prompt(question, default=default, err=True))
            if given == ".":
                break
            try:
                made |= ranges([f"{name}={given}"])
            except DiagnosticError as fault:
                typer.echo(render(fault.diagnostics), err=True, nl=False)
                continue
            usual = given if unit == "deg" else usual
            break
    return made


def _choice(question: str, choices: tuple[str, ...], usual: str) -> str:
    while True:
        displayed = f"{question} [{' '.join(choices)}]"
        given = str(typer.prompt(displayed, default=usual or None, err=True))
        if given in choices:
            return given
        typer.echo(f"one of {' '.join(choices)}", err=True)
