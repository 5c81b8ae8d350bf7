"""Pages of the diagnostic codes: one file for each family of codes.

A file has a section for each code.
"""

import re
from functools import cache
from pathlib import Path

_FOLDER = Path(__file__).resolve().parent


@cache
def _pages() -> dict[str, str]:
    """Return the section of each code, by the code."""
    files = (path.read_text(encoding="utf-8") for path in sorted(_FOLDER.glob("RG*.md")))
    sections = (part for text in files for part in re.split(r"^# (?=RG\d)", text, flags=re.M)[1:])
    return {part.partition(":")[0]: f"# {part.rstrip()}\n" for part in sections}


def codes() -> list[str]:
    """All codes, sorted."""
    return sorted(_pages())


def page(code: str) -> str:
    """Text of a code's page (Markdown)."""
    return _pages()[code]


def title(code: str) -> str:
    """Title of a code's page, without the code."""
    return page(code).partition("\n")[0].removeprefix(f"# {code}: ")
