"""ABB's cfg text (SYS, EIO, SIO, MOC, ...): parse and write.

Layout as real controllers save it: a header line `DOMAIN:CFG_1.0:<major>:<minor>::`, `#` lines
between sections, `SECTION:` on a line of its own, instances of `-Attribute value` pairs that a `\\`
at the end of a line continues, text in double quotes, numbers bare, and a true boolean as a bare
`-Flag` (a false one is left out). Controllers read a looser format (files that ABB ships): no blank
lines, any indentation, `# text` anywhere between lines, LF; RobotWare 7 ends a file with
`#CTRL_SIGNATURE:...`. Names have no case.
"""

import re
from codecs import BOM_UTF8
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import isinf

from rapidgen.diagnostics import DiagnosticError, Span, refusal

Scalar = str | int | float

_HEADER = re.compile(r"([A-Za-z]+):CFG_1\.0:(?:(\d+):(\d+))?:{1,2}\s*$")
# MMC.cfg of all backups: `MMC_MC1 = MMC_PALETTE:`.
_SECTION = re.compile(r"\s*(?:[A-Za-z]\w*\s*=\s*)?([A-Za-z][A-Za-z0-9_]*):\s*$")
_TOKEN = re.compile(r'\s*(?:(-[A-Za-z_][A-Za-z0-9_]*)(?=\s|$)|"([^"]*)"|([^\s"]+))')
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?$")
_LINE_END = re.compile(r"\r\n|\n|\r")
_LINE_LENGTH = 80
_INDENT = " " * 6


@dataclass(frozen=True, slots=True)
class Attribute:
    """`-name value ...`; a flag has no values."""

    name: str
    values: tuple[Scalar, ...] = ()


@dataclass(frozen=True, slots=True)
class Instance:
    """One instance of a section; `line` is its first line (0: not from a file)."""

    attributes: tuple[Attribute, ...]
    line: int = 0

    def text(self, name: str, default: str = "") -> str:
        """Return the first value of an attribute as text; empty for a flag."""
        for attribute in self.attributes:
            if attribute.name.casefold() == name.casefold():
                return str(attribute.values[0]) if attribute.values else ""
        return default

    def number(self, name: str, default: float = 0.0) -> float:
        """Return the first value of an attribute as a number, also if quoted."""
        text = self.text(name)
        return float(text) if _NUMBER.match(text) else default

    def flag(self, name: str) -> bool:
        """True if a boolean is set: a bare flag, or a written TRUE."""
        for attribute in self.attributes:
            if attribute.name.casefold() == name.casefold():
                return not attribute.values or str(attribute.values[0]).upper() in ("TRUE", "1")
        return False


@dataclass(frozen=True, slots=True)
class Section:
    """Instances under one `NAME:` line."""

    name: str
    instances: tuple[Instance, ...]


@dataclass(frozen=True, slots=True)
class CfgText:
    """One cfg file."""

    domain: str
    version: tuple[int, int] | None
    """Digits of the header; ABB's own examples (DAP on a 7.6) have none."""
    sections: tuple[Section, ...]
    path: str = ""
    encoding: str = field(default="utf-8", compare=False)
    """Of the file that it was read from, for `cfg_bytes`."""

    def instances(self, name: str) -> Iterator[Instance]:
        """Yield instances of every section with this name, in order.

        Case is ignored.
        """
        for section in self.sections:
            if section.name.casefold() == name.casefold():
                yield from section.instances


def parse_cfg(data: bytes | str, *, path: str = "") -> CfgText:
    """Parse a cfg file.

    Raises DiagnosticError: RG701 (no header), RG702 (not a cfg text).
    """
    text, encoding = (data, "utf-8") if isinstance(data, str) else _decode(data)
    lines = _LINE_END.split(text)
    start = next((i for i, line in enumerate(lines) if line.strip()), 0)
    header = _HEADER.match(lines[start].strip("\ufeff"))
    if header is None:
        raise refusal(
            "RG701",
            Span(path, start + 1, 1),
            "not a cfg file: the header line is missing",
            "the first line of a cfg file reads like 'SYS:CFG_1.0:6:0::'",
        )
    sections: list[tuple[str, list[Instance]]] = []
    for number, line in _logical_lines(lines, start + 1):
        stripped = line.strip()
        if not stripped or stripped.startswith("#"):
            continue
        section = _SECTION.match(line)
        if section:
            sections.append((section[1], []))
        elif sections and stripped.startswith("-"):
            sections[-1][1].append(Instance(_attributes(line, path, number), number))
        else:
            raise _unreadable(path, number, "expected a section ('NAME:') or '-Attribute value'")
    return CfgText(
        header[1].upper(),
        (int(header[2]), int(header[3])) if header[2] else None,
        tuple(Section(name, tuple(instances)) for name, instances in sections),
        path,
        encoding,
    )


def write_cfg(cfg: CfgText) -> str:
    """Return the file as text with LF; parsing gives the same sections.

    Raises DiagnosticError RG703 for a text that the format cannot hold (quote, line end).
    """
    digits = f"{cfg.version[0]}:{cfg.version[1]}" if cfg.version is not None else ""
    out = [f"{cfg.domain}:CFG_1.0:{digits}::"]
    for section in cfg.sections:
        out += ["#", f"{section.name}:"]
        for instance in section.instances:
            out.append("")
            line = _INDENT
            for attribute in instance.attributes:
                words = " ".join([f"-{attribute.name}", *map(_written, attribute.values)])
                if line.strip() and len(line) + 1 + len(words) > _LINE_LENGTH:
                    out.append(line + "\\")
                    line = _INDENT
                line += (" " if line.strip() else "") + words
            out.append(line)
    return "\n".join(out) + "\n"


def cfg_bytes(cfg: CfgText) -> bytes:
    """Return `write_cfg` in the file's encoding, with byte order mark.

    Raises DiagnosticError RG703, also for a character that this encoding lacks.
    """
    text = write_cfg(cfg)
    try:
        return text.encode(cfg.encoding)
    except UnicodeEncodeError as fault:
        raise refusal(
            "RG703",
            None,
            f"{cfg.path or cfg.domain} is in {cfg.encoding}, which has no {text[fault.start]!r}",
            "save the file as UTF-8",
        ) from None


def _decode(data: bytes) -> tuple[str, str]:
    """Return the text and its encoding."""
    encoding = "utf-8-sig" if data.startswith(BOM_UTF8) else "utf-8"
    try:
        return data.decode(encoding), encoding
    except UnicodeDecodeError:
        return data.decode("latin-1"), "latin-1"


def _logical_lines(lines: list[str], start: int) -> Iterator[tuple[int, str]]:
    """Yield lines with their continuations joined, numbered from 1."""
    index = start
    while index < len(lines):
        number = index + 1
        line = lines[index].rstrip()
        while line.endswith("\\") and index + 1 < len(lines):
            index += 1
            line = line[:-1] + " " + lines[index].strip()
        yield number, line.removesuffix("\\")
        index += 1


def _attributes(line: str, path: str, number: int) -> tuple[Attribute, ...]:
    result: list[tuple[str, list[Scalar]]] = []
    line = line.rstrip()
    at = 0
    while at < len(line):
        token = _TOKEN.match(line, at)
        if token is None or (token[1] is None and not result):
            raise _unreadable(path, number, "a quote is not closed, or a value has no attribute")
        at = token.end()
        if token[1] is not None:
            result.append((token[1][1:], []))
        elif token[2] is not None:
            result[-1][1].append(token[2])
        else:
            result[-1][1].append(scalar(token[3]))
    return tuple(Attribute(name, tuple(values)) for name, values in result)


def scalar(word: str) -> Scalar:
    """Return a bare word as a value: a number if it is one."""
    if not _NUMBER.match(word) or isinf(float(word)):
        return word
    return int(word) if re.fullmatch(r"[+-]?\d{1,18}", word) else float(word)


def _written(value: Scalar) -> str:
    if not isinstance(value, str):
        return repr(value)
    if '"' in value or "\n" in value or "\r" in value:
        raise refusal(
            "RG703",
            None,
            f"a cfg file cannot hold the text {value!r}",
            "leave out quotes and line ends",
        )
    return f'"{value}"'


def _unreadable(path: str, number: int, label: str) -> DiagnosticError:
    return refusal("RG702", Span(path, number, 1), "unreadable line in a cfg file", label=label)
