"""The event log that a controller saves as text (`Elog_all*.txt` in HOME of a backup).

Titles and texts are in the controller's language; number, type and arguments are not. A line is

    SeqNo <tab> type <tab> category <tab> code <tab> title <tab> date <tab> text <tab> {args: "a"}

as RobotWare 5.15, 5.61 and 6.03 write it.
"""

import re
from dataclasses import dataclass
from pathlib import Path

from rapidgen._reading import read_foreign
from rapidgen.diagnostics import refusal

LARGEST = 50_000_000
"""Bytes of a file."""
_RELEASE = re.compile(r"RobotWare\W{1,3}\s*([0-9.]+)")
_ARGUMENTS = re.compile(r'"((?:[^"\\]|\\.)*)"')
_COLUMNS = 8


@dataclass(frozen=True, slots=True)
class SavedEvent:
    """One line of a saved log. `type` is E, W or I; `date` is as it is written."""

    sequence: int
    type: str
    code: int
    title: str
    date: str
    text: str
    arguments: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SavedLog:
    """A saved log, in the order of the file. `robotware` is empty if the file does not say it."""

    robotware: str
    events: tuple[SavedEvent, ...]


def read_saved_log(path: Path) -> SavedLog:
    """Read a saved event log.

    Raises DiagnosticError RG724: the file cannot be read, or has no line of a log.
    """
    try:
        data = read_foreign(path, LARGEST)
    except FileNotFoundError as error:
        help = "give the path of the file that the pendant saves; a backup often has one in HOME"
        raise refusal("RG724", None, f"{path}: no such file", help) from error
    except OSError as error:
        raise refusal(
            "RG724", None, f"{path} cannot be read: {error.strerror}", "give a text file"
        ) from error
    text = _decoded(data)
    events = tuple(
        event for line in text.splitlines() if (event := _event(line.split("\t"))) is not None
    )
    if not events:
        raise refusal(
            "RG724",
            None,
            f"{path} has no line of an event log",
            "give the file that the pendant saves, such as HOME/Elog_all000518.txt of a backup",
        )
    release = _RELEASE.search(text)
    return SavedLog(release[1] if release else "", events)


def _decoded(data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Both accept almost any bytes. Chinese letters have two each, European ones stand alone.
        runs = re.findall(rb"[\x80-\xff]+", data)
        pairs = sum(len(run) % 2 == 0 for run in runs)
        return data.decode("gb18030" if 2 * pairs > len(runs) else "cp1252", "replace")


def _event(columns: list[str]) -> SavedEvent | None:
    """Return the event of a line; None for a heading or another text."""
    cells = [cell.strip() for cell in columns]
    if len(cells) < _COLUMNS or cells[1] not in ("E", "W", "I"):
        return None
    if not (cells[0].isdecimal() and cells[3].isdecimal()) or len(cells[0] + cells[3]) > 20:
        return None
    arguments = tuple(
        match[1].replace('\\"', '"').strip() for match in _ARGUMENTS.finditer(cells[7])
    )
    return SavedEvent(
        int(cells[0]), cells[1], int(cells[3]), cells[4], cells[5], cells[6], arguments
    )
