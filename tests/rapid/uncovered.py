"""List rules of docs/rapid/language.md without tests, and vice versa.

python -m tests.rapid.uncovered
"""

import re
import sys
from fnmatch import fnmatchcase
from pathlib import Path

from tests.rapid_programs import read_all

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests" / "rapid" / "conformance"
_ROW = re.compile(r"^\| ([^|]+) \| ([^|]+) \| ((?:`[\w.*/:-]+` ?)+)\|$", re.MULTILINE)


def rules():
    """(rule, source, patterns) of each row of the table."""
    text = (ROOT / "docs" / "rapid" / "language.md").read_text("utf-8")
    return [
        (rule, source, re.findall(r"`([^`]+)`", files))
        for rule, source, files in _ROW.findall(text)
    ]


def uncovered():
    """Patterns without a program, and programs without a pattern."""
    names = [program.below(FOLDER) for program in read_all(FOLDER)]
    patterns = [(rule, p) for rule, _, listed in rules() for p in listed]
    names += _tests()
    empty = [f"{rule}: {p}" for rule, p in patterns if not any(fnmatchcase(n, p) for n in names)]
    claimed = [n for n in names if any(fnmatchcase(n, p) for _, p in patterns)]
    return empty, sorted(n for n in set(names) - set(claimed) if "::" not in n)


def _tests():
    """Names of test functions, as `file.py::test_name`."""
    return [
        f"{file.name}::{name}"
        for file in sorted(FOLDER.parent.glob("test_*.py"))
        for name in re.findall(r"^def (test_\w+)", file.read_text("utf-8"), re.MULTILINE)
    ]


if __name__ == "__main__":
    without_file, without_rule = uncovered()
    for line in [*without_file, *without_rule]:
        print(line)
    sys.exit(1 if without_file or without_rule else 0)
