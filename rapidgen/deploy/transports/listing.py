"""Answers of FTP servers to MLSD, LIST and NLST, parsed as entries.

RFC 959 leaves LIST open; observed are `ls -l` (with and without the group column), DOS, and the
columns of VxWorks' own server, on which IRC5 runs ([mem]). Other lines are skipped; a name that
could lead elsewhere is dropped.
"""

import re
from collections.abc import Iterable

from rapidgen.deploy.transports.transport import Entry

_UNIX = re.compile(
    r"(?P<type>[-dlbcps])[-rwxsStTl.+@]{9,11}\s+"
    r"(?:\d+\s+)?\S+(?:\s+\S+)*?\s+(?P<size>\d+)\s+"
    r"(?:[^\W\d]{3,4}\.?\s+\d{1,2}|\d{1,2}\.?\s+[^\W\d]{3,4}\.?|\d{4}-\d\d-\d\d)\s+"
    r"(?:\d{1,2}:\d\d(?::\d\d)?|\d{4})\s(?P<name>.+)"
)
_DOS = re.compile(
    r"\d{1,2}[-/.]\d{1,2}[-/.]\d{2,4}\s+\d{1,2}:\d\d\s*(?:[AaPp][Mm])?\s+"
    r"(?P<size><DIR>|[\d,.]+)\s+(?P<name>.+)"
)
_VXWORKS = re.compile(
    r"\s*(?P<size>\d+)\s+[A-Za-z]{3}-\d{1,2}-\d{4}\s+\d{1,2}:\d\d:\d\d\s+"
    r"(?P<name>.+?)\s*(?P<folder><DIR>)?\s*"
)


def parse_list(lines: Iterable[str]) -> tuple[Entry, ...] | None:
    """Return entries of a LIST answer.

    None if it has lines and none is of a known form.
    """
    result: list[Entry] = []
    understood = True
    for line in lines:
        entry = _entry(line.rstrip("\r\n"))
        if entry is not None:
            result.append(entry)
        elif line.strip() and not re.fullmatch(r"\s*(?:total\s.*|[-\s]+|size\s+date.*)", line):
            understood = False
    if not result and not understood:
        return None
    return _kept(result)


def parse_names(lines: Iterable[str]) -> tuple[Entry, ...]:
    """Return entries of an NLST answer.

    Some servers return whole paths: the last part counts.
    """
    return _kept(Entry(re.split(r"[/\\]", line.strip("\r\n"))[-1]) for line in lines)


def parse_facts(lines: Iterable[str]) -> tuple[Entry, ...]:
    """Entries of an MLSD answer (RFC 3659)."""
    result = []
    for line in lines:
        facts_text, space, name = line.rstrip("\r\n").partition(" ")
        facts = dict(fact.split("=", 1) for fact in facts_text.casefold().split(";") if "=" in fact)
        if space and facts.get("type") not in ("cdir", "pdir"):
            size = facts.get("size", "")
            kind = facts.get("type")
            result.append(
                Entry(name, _number(size), None if kind is None else kind.startswith("dir"))
            )
    return _kept(result)


def _entry(line: str) -> Entry | None:
    if match := _UNIX.fullmatch(line):
        name = match["name"].strip()
        if match["type"] == "l":
            return Entry(name.split(" -> ")[0])
        folder = match["type"] == "d"
        return Entry(name, None if folder else _number(match["size"]), folder)
    if match := _DOS.fullmatch(line):
        folder = match["size"] == "<DIR>"
        return Entry(match["name"].strip(), None if folder else _number(match["size"]), folder)
    if match := _VXWORKS.fullmatch(line):
        folder = match["folder"] is not None
        return Entry(match["name"], None if folder else _number(match["size"]), folder)
    return None


def _number(text: str) -> int | None:
    digits = re.sub(r"[,.]", "", text)
    return int(digits) if digits.isascii() and digits.isdigit() and len(digits) < 19 else None


def _kept(entries: Iterable[Entry]) -> tuple[Entry, ...]:
    """Drop '.', '..', repeated names and invalid names."""
    retained: dict[str, Entry] = {}
    for entry in entries:
        plain = entry.name.isprintable() and not re.search(r"[/\\]", entry.name)
        if plain and entry.name not in ("", ".", ".."):
            retained.setdefault(entry.name, entry)
    return tuple(sorted(retained.values(), key=lambda e: e.name))
