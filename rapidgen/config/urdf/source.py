"""Files of a robot description as checked XML text.

Untrusted XML is read with limits: no document type, hence no entities, at most 20 MB. xacro is
expanded within limits (`sandbox.py`); plain URDF is only data.
"""

import re
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from xml.parsers import expat

from rapidgen._reading import TooLarge, read_foreign
from rapidgen.diagnostics import Diagnostic, Severity, Span, error, refusal

MAX_BYTES = 20_000_000
_ARG = re.compile(r"""<xacro:arg\s[^<>]*?name\s*=\s*["']([^"']+)["']""")
_ARG_USE = re.compile(r"""\$\(arg\s+([^)\s]+)\s*\)|\barg\(\s*["']([^"']+)["']""")
_MACRO = re.compile(r"<xacro:macro\s([^<>]*)>", re.DOTALL)
_ATTRIBUTE = re.compile(r"""([\w:]{1,64})\s*=\s*(?:"([^"]*)"|'([^']*)')""", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Macro:
    """A xacro macro: parameters in order as (name, has a default)."""

    name: str
    parameters: tuple[tuple[str, bool], ...]
    joints: int = 0
    """Number of joints that it creates."""

    @property
    def shown(self) -> str:
        """Return its signature: `name(a, b=)`."""
        names = [f"{name}=" if has else name for name, has in self.parameters]
        return f"{self.name}({', '.join(names)})"


def read_xml(path: Path, *, place: Span | None = None) -> tuple[str, bytes]:
    """Return text and bytes of an XML file.

    Raises DiagnosticError (RG060).
    """
    try:
        data = read_foreign(path, MAX_BYTES)
    except OSError as fault:
        too_large = isinstance(fault, TooLarge)
        raise refusal(
            "RG060",
            place,
            f"cannot read {path}: {fault.strerror}",
            "give a URDF: meshes are files of their own"
            if too_large
            else "give the path of a file",
        ) from None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise refusal(
            "RG060", place, f"{path} is not UTF-8 text", "save the file as UTF-8"
        ) from None
    line = _doctype(text)
    if line:
        raise refusal(
            "RG060",
            Span(str(path), line, 1),
            "a robot description has no document type and no entities",
            "remove the <!DOCTYPE ...>",
            label="refused",
        )
    return text, data


class _Declared(Exception):
    """A document type was found; the rest is not read."""


def _doctype(text: str) -> int:
    """Return the line of a document type; 0: none before the root."""

    def declared(*_: object) -> None:
        raise _Declared

    parser = expat.ParserCreate("utf-8")
    parser.StartDoctypeDeclHandler = declared
    try:
        with suppress(expat.ExpatError):  # reported where the text is read
            parser.Parse(text.encode(), True)
    except _Declared:
        return parser.CurrentLineNumber
    return 0


def xml_fault(data: bytes) -> str:
    """Return why bytes are not accepted as XML; empty: they are."""

    def declared(*_: object) -> None:
        raise _Declared

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = declared
    try:
        parser.Parse(data, True)
    except _Declared:
        return "it has a document type"
    except (expat.ExpatError, LookupError, ValueError) as fault:  # or an unknown encoding
        return f"it is not well-formed XML: {fault}"
    return ""


_OF_JOINT = frozenset(("parent", "child", "origin", "axis", "limit", "mimic"))
_MOST_WARNINGS = 5


def bind_prefixes(path: Path, text: str) -> tuple[str, list[Diagnostic]]:
    """Declare prefixes that a URDF uses without a namespace, and return a warning for each.

    URDF parsers of ROS know no namespaces: an element with a prefix has an unknown name, and they
    skip it. Raises DiagnosticError (RG060): such an element is or holds a part of the chain.
    """
    parser = expat.ParserCreate("utf-8")
    bound = [{"xml", "xmlns"}]
    """The prefixes that are bound in each open element."""
    holders: list[tuple[str, int]] = []
    """For each open element the outermost one with an unbound prefix, or an empty name."""
    unbound: dict[str, tuple[str, int]] = {}
    root_end, section = -1, ""

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal root_end, section
        own = {word.removeprefix("xmlns:") for word in attributes if word.startswith("xmlns:")}
        bound.append(bound[-1] | own if own else bound[-1])
        prefix, _, local = name.rpartition(":")
        line = parser.CurrentLineNumber
        for word, what in ((name, f"<{name}>"), *((a, f"{a} of <{name}>") for a in attributes)):
            used = word.rpartition(":")[0]
            if used and used not in bound[-1]:
                unbound.setdefault(used, (what, line))
        holder = holders[-1] if holders else ("", 0)
        if not holder[0] and prefix and prefix not in bound[-1]:
            holder = name, line
        if not holders:
            root_end = parser.CurrentByteIndex + 1 + len(name.encode())
        elif len(holders) == 1:
            section = local if local in ("link", "joint") or not holder[0] else ""
        is_part = local in ("link", "joint") and (len(holders) == 1 or not section)
        if holder[0] and (is_part or (section == "joint" and local in _OF_JOINT)):
            used = holder[0].rpartition(":")[0]
            raise refusal(
                "RG060",
                Span(str(path), holder[1], 1),
                f"the prefix of <{holder[0]}> has no namespace, and the element "
                + (f"holds <{name}>," if holder != (name, line) else "is")
                + " a part of the robot",
                f"remove the prefix, or declare xmlns:{used} on <robot>",
            )
        holders.append(holder)

    def end(_name: str) -> None:
        bound.pop()
        holders.pop()

    parser.StartElementHandler, parser.EndElementHandler = start, end
    data = text.encode()
    try:
        parser.Parse(data, True)
    except expat.ExpatError:
        return text, []  # reported where the text is read
    if not unbound:
        return text, []
    declared = "".join(f' xmlns:{prefix}="unbound:{prefix}"' for prefix in unbound)
    found = [
        error(
            "RG060",
            Span(str(path), line, 1),
            f"the prefix of {what} has no namespace, so it is skipped",
            f"declare xmlns:{prefix} on <robot>, or remove it",
            severity=Severity.WARNING,
        )
        for prefix, (what, line) in list(unbound.items())[:_MOST_WARNINGS]
    ]
    return (data[:root_end] + declared.encode() + data[root_end:]).decode(), found


def is_xacro(path: Path, text: str) -> bool:
    """True if xacro has to expand the file.

    Without the namespace of xacro nothing can: the elements are unknown ones of a URDF.
    """
    return path.suffix == ".xacro" or "xmlns:xacro" in text


def macros(text: str) -> tuple[Macro, ...]:
    """Return the macros that a xacro text defines, in order."""
    result = []
    plain = _without_comments(text)
    for hit in _MACRO.finditer(plain):
        end = plain.find("</xacro:macro", hit.end())
        joints = plain.count("<joint", hit.end(), end if end >= 0 else len(plain))
        value = {m[1]: m[2] if m[2] is not None else m[3] for m in _ATTRIBUTE.finditer(hit[1])}
        if "name" in value:
            result.append(Macro(value["name"], _parameters(value.get("params", "")), joints))
    return tuple(result)


def _parameters(text: str) -> tuple[tuple[str, bool], ...]:
    made = []
    for word in re.findall(r"""(?:[^\s'"]|'[^']*'|"[^"]*")+""", text):
        name, default, _ = re.split(r"(:?=|$)", word, maxsplit=1)
        made.append((name, bool(default)))
    return tuple(made)


def declared_arguments(texts: list[str]) -> set[str]:
    """Return all xacro arguments that the texts declare or use."""
    names: set[str] = set()
    for text in texts:
        names.update(_ARG.findall(text))
        names.update(a or b for a, b in _ARG_USE.findall(text))
    return names


def _without_comments(text: str) -> str:
    """Return the text with comments replaced by blanks.

    Lines and columns stay. A regular expression that does not find an end would search again from
    each start.
    """
    parts, at = [], 0
    while (begin := text.find("<!--", at)) >= 0 and (end := text.find("-->", begin + 4)) >= 0:
        parts += [text[at:begin], re.sub(r"[^\n]", " ", text[begin : end + 3])]
        at = end + 3
    return "".join([*parts, text[at:]])


def unexpanded(text: str, displayed: str) -> list[Diagnostic]:
    """Report unexpanded parts (pitfall 3 of the field: RG033)."""
    findings = []
    for hit in re.finditer(
        r"\$\{[^$}]*\}|\$\([^$)]*\)|<(xacro:)?(macro|include|property|if|unless)[\s>/]",
        _without_comments(text),
    ):
        line = text.count("\n", 0, hit.start()) + 1
        column = hit.start() - text.rfind("\n", 0, hit.start())
        findings.append(
            error(
                "RG033",
                Span(displayed, line, column),
                f"'{hit[0].strip()}' is left over after expansion",
                "xacro only replaces tags with the prefix `xacro:`; declare xmlns:xacro on "
                "<robot> and write <xacro:macro>, <xacro:include>",
                label="not replaced",
            )
        )
        if len(findings) == 5:
            break
    return findings
