"""Lists rules of docs/rapid.md without a conformance file, and files that no rule claims.

python tests/rapid/uncovered.py
"""

import re
import sys
from fnmatch import fnmatchcase
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests" / "rapid" / "conformance"
_ROW = re.compile(r"^\| ([^|]+) \| ([^|]+) \| ((?:`[\w.*/-]+` ?)+)\|$", re.MULTILINE)


def rules():
    """(rule, source, patterns) of each row of the table."""
    text = (ROOT / "docs" / "rapid.md").read_text("utf-8")
    return [
        (rule, source, re.findall(r"`([^`]+)`", files))
        for rule, source, files in _ROW.findall(text)
    ]


def uncovered():
    """Patterns without a file, and files without a pattern."""
    names = [f.relative_to(FOLDER).with_suffix("").as_posix() for f in FOLDER.rglob("*.mod")]
    patterns = [(rule, p) for rule, _, listed in rules() for p in listed]
    empty = [f"{rule}: {p}" for rule, p in patterns if not any(fnmatchcase(n, p) for n in names)]
    claimed = [n for n in names if any(fnmatchcase(n, p) for _, p in patterns)]
    return empty, sorted(set(names) - set(claimed))


if __name__ == "__main__":
    without_file, without_rule = uncovered()
    for line in [*without_file, *without_rule]:
        print(line)
    sys.exit(1 if without_file or without_rule else 0)
