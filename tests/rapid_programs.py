"""Theme files: RAPID programs of one theme in one `.mod`, each with what is expected of it.

A line `!=== NAME` begins a program, which ends before the next such line. NAME is letters, digits
and `_`, and is there once in a file. The first line of a file is such a line, and no other line
begins with `!===`. What is between two of them is the program, byte for byte (UTF-8, `\\n`); its
lines are counted from 1, so that it can be moved without a change.
"""

import re
from dataclasses import dataclass
from pathlib import Path

_BEGINNING = re.compile(r"^!===.*(?:\n|\Z)", re.MULTILINE)
_NAMED = re.compile(r"!=== (\w+)\n", re.ASCII)


@dataclass(frozen=True)
class Program:
    """A program of a theme file."""

    file: Path
    line: int
    """Line of the file that names the program: line N of it is line `line` + N of the file."""
    name: str
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.name}"

    def below(self, folder: Path) -> str:
        """Theme file and name, `control/goto`: what tests and documentation call the program."""
        return (self.file.relative_to(folder).with_suffix("") / self.name).as_posix()


def read(file: Path) -> list[Program]:
    """The programs of a theme file, in order; ValueError if it cannot be cut."""
    text = file.read_text("utf-8")
    beginnings = list(_BEGINNING.finditer(text))
    if not beginnings or beginnings[0].start():
        raise ValueError(f"{file}:1: the first line is no `!=== NAME`")
    programs: list[Program] = []
    ends = [*(b.start() for b in beginnings[1:]), len(text)]
    for beginning, end in zip(beginnings, ends, strict=True):
        line = text.count("\n", 0, beginning.start()) + 1
        named = _NAMED.fullmatch(beginning[0])
        if named is None:
            raise ValueError(f"{file}:{line}: a line with `!===` is `!=== NAME`")
        if named[1] in {program.name for program in programs}:
            raise ValueError(f"{file}:{line}: {named[1]} is there already")
        if beginning.end() == end:
            raise ValueError(f"{file}:{line}: {named[1]} is empty")
        programs.append(Program(file, line, named[1], text[beginning.end() : end]))
    return programs


def read_all(folder: Path) -> list[Program]:
    """The programs of all theme files below a folder, in order."""
    return [program for file in sorted(folder.rglob("*.mod")) for program in read(file)]
