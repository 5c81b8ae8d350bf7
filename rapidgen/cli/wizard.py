"""Questions of `rapidgen new` in a terminal: the robot, then each missing value."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import typer

from rapidgen.config.draft import DescriptionChoices
from rapidgen.config.placeholders import OPEN
from rapidgen.config.scaffold import ranges
from rapidgen.diagnostics import DiagnosticError, render

_JOINT = re.compile(r'^\s*("[^"]*"|\w+): \{axis: ("\?{3}"|\w+)', re.MULTILINE)
_SHOWN = re.compile(r"^\s*(?:#.*|tip: .*|rob\w+:|(?:\"[^\"]*\"|\w+): \{axis: .*|coupling: .*)$")
_AXES = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6", "eax_a", "ignore")


def ask_source() -> tuple[str | None, Path | None]:
    """Ask for a shipped model or a description file."""
    answer = typer.prompt("Robot (see `rapidgen robots`) or URDF file", default="irb120", err=True)
    path = Path(answer)
    return (None, path) if path.suffix or path.exists() else (answer, None)


def draw_chain(text: str) -> str:
    """Draw the arms of a configuration as a chain, from the base to the flange."""
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
    """Show the known arms and ask for the missing values."""
    text = make(answers)
    typer.echo(draw_chain(text), err=True)
    while left := [joint for joint, axis in _axes(text) if axis == OPEN]:
        joint = left[0]
        in_use = {axis for _, axis in _axes(text)}
        usual = next((axis for axis in _AXES if axis not in in_use), "ignore")
        answer = _choice(f"Axis of {joint}", _AXES, usual)
        if answer == "ignore":
            answers = replace(answers, ignore=(*answers.ignore, joint))
        else:
            answers = replace(answers, joints={**answers.joints, joint: answer})
        text = make(answers)  # one answer may settle other joints, which are not asked for
    if f"lower: {OPEN}" in text:
        answers = replace(answers, ranges={**answers.ranges, **_ranges(text)})
    if f"coupling: {OPEN}" in text:
        rod = _choice("Does a rod couple axes 2 and 3 (0 no, 1 yes)", ("0", "1"), "")
        answers = replace(answers, coupling=float(rod))
    if f"speed: {OPEN}" in text:
        speed = typer.prompt(
            "Maximum speed of the axes without one, deg/s (mm/s)", type=float, err=True
        )
        answers = replace(answers, speed=speed)
    return answers


def _axes(text: str) -> list[tuple[str, str]]:
    return [(hit[1].strip('"'), hit[2]) for hit in _JOINT.finditer(text)]


def _ranges(text: str) -> dict[str, tuple[float, float]]:
    """Ask for missing ranges; offer the last answer for the next turning joint."""
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
            answer = str(typer.prompt(question, default=default, err=True))
            if answer == ".":
                break
            try:
                made |= ranges([f"{name}={answer}"])
            except DiagnosticError as fault:
                typer.echo(render(fault.diagnostics), err=True, nl=False)
                continue
            usual = answer if unit == "deg" else usual
            break
    return made


def _choice(question: str, choices: tuple[str, ...], usual: str) -> str:
    while True:
        displayed = f"{question} [{' '.join(choices)}]"
        answer = str(typer.prompt(displayed, default=usual or None, err=True))
        if answer in choices:
            return answer
        typer.echo(f"answer one of {' '.join(choices)}", err=True)
