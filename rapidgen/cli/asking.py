"""What `rapidgen new` asks in a terminal: a robot, then what the description leaves open."""

import re
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import typer

from rapidgen.config.described import Answers
from rapidgen.config.open_lines import OPEN

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


def ask_open(make: Callable[[Answers], str], answers: Answers) -> Answers:
    """Show what is known, and ask until nothing is open that one answer settles."""
    text = make(answers)
    typer.echo(drawn(text), err=True)
    for joint, axis in [(hit[1].strip('"'), hit[2]) for hit in _JOINT.finditer(text)]:
        if axis == OPEN:
            taken = {a for _, a in _JOINT.findall(text)} | set(answers.joints.values())
            usual = next((a for a in _AXES if a not in taken), "ignore")
            given = _choice(f"Axis of {joint}", _AXES, usual)
            if given == "ignore":
                answers = replace(answers, ignore=(*answers.ignore, joint))
            else:
                answers = replace(answers, joints={**answers.joints, joint: given})
    if f"coupling: {OPEN}" in text:
        rod = _choice("Does a rod couple axes 2 and 3 (0 no, 1 yes)", ("0", "1"), "")
        answers = replace(answers, coupling=float(rod))
    if f"speed: {OPEN}" in text:
        speed = typer.prompt(
            "Largest speed of the axes without one, deg/s (mm/s)", type=float, err=True
        )
        answers = replace(answers, speed=speed)
    return answers


def _choice(question: str, choices: tuple[str, ...], usual: str) -> str:
    while True:
        shown = f"{question} [{' '.join(choices)}]"
        given = str(typer.prompt(shown, default=usual or None, err=True))
        if given in choices:
            return given
        typer.echo(f"one of {' '.join(choices)}", err=True)
