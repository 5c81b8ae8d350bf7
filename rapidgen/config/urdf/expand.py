"""Expand xacro to URDF within limits (`sandbox.py`).

The result lists every file that was read.
"""

import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from xml.dom import minidom
from xml.parsers.expat import ExpatError

from rapidgen._extras import require
from rapidgen.config.urdf.expressions import ExpressionError
from rapidgen.config.urdf.packages import PackageNotFound, Packages
from rapidgen.config.urdf.sandbox import restricted
from rapidgen.config.urdf.source import (
    Macro,
    bind_prefixes,
    declared_arguments,
    is_xacro,
    macros,
    read_xml,
    unexpanded,
)
from rapidgen.diagnostics import (
    Diagnostic,
    DiagnosticError,
    Severity,
    Span,
    error,
    refusal,
    suggest,
)

_ROBOT_JOINTS = 4
"""Minimum number of joints of a robot macro; one with fewer is a part."""
_WORLD = "world"
"""Default of a macro's `parent`."""
_NAMED = re.compile(r"""<(joint|link)\b[^>]*?\bname\s*=\s*["']([^"']*)["']""")
_NAMESPACE = "http://www.ros.org/wiki/xacro"
_DEEPEST = 1000
"""Maximum nesting of Python calls in an expansion: that of a new interpreter."""
_LONGEST_REASON = 300
_APPEARANCE = re.compile(r"material|colou?r", re.IGNORECASE)
"""Names of files and macros that only give colours."""
_ABSENT = ".package-not-found"
"""Folder that stands for the packages that were not found."""
_MOST_BYTES = 4_000_000
"""Bytes of all files of a xacro description."""


@dataclass(slots=True)
class Description:
    """An expanded robot description and its source files."""

    path: Path
    text: str
    expanded: bool
    inputs: list[tuple[str, bytes]] = field(default_factory=list)
    found: list[Diagnostic] = field(default_factory=list)
    sources: list[tuple[Path, str]] = field(default_factory=list)
    """The files that were expanded."""
    _places: dict[str, list[tuple[re.Pattern[str], Span]]] = field(default_factory=dict)

    def origin(self, name: str, tag: str) -> Span | None:
        """Return the source of an expanded element, found by its name."""
        if not self._places:
            self._places[""] = []
            for path, text in self.sources:
                for hit in _NAMED.finditer(text):
                    line = text.count("\n", 0, hit.start()) + 1
                    span = Span(str(path), line, hit.start() - text.rfind("\n", 0, hit.start()))
                    parts = re.split(r"\$\{[^}]*\}|\$\([^)]*\)", hit[2])
                    pattern = re.compile(".*".join(map(re.escape, parts)))
                    self._places.setdefault(hit[1], []).append((pattern, span))
        hits = [span for pattern, span in self._places.get(tag, []) if pattern.fullmatch(name)]
        return hits[0] if hits else None


@dataclass(frozen=True, slots=True)
class Request:
    """What to read, and how; `place` is the configuration's request."""

    path: Path
    packages: Packages
    arguments: Mapping[str, str] = field(default_factory=dict)
    macro: str = ""
    macro_arguments: Mapping[str, str] = field(default_factory=dict)
    place: Span | None = None


def expand(request: Request) -> Description:
    """Read a description.

    Raises DiagnosticError (RG031..RG033, RG056, RG060, RG061; RG905 without the extra `urdf`).
    """
    text, data = read_xml(request.path, place=request.place)
    require("urdf", request.place)
    if not is_xacro(request.path, text):
        text, found = bind_prefixes(request.path, text)
        made = Description(request.path, text, False, [(request.path.name, data)], found)
        if request.arguments or request.macro:
            raise refusal(
                "RG056",
                request.place,
                f"{request.path.name} is a plain URDF and takes no arguments or macro",
                "leave them out, or name the xacro file that the URDF was made from",
            )
    else:
        made = _expand_xacro(request, text)
    result = unexpanded(made.text, str(request.path) if not made.expanded else "(expanded)")
    if result:
        if made.expanded:
            result = [
                error(
                    "RG033",
                    request.place,
                    d.message + f" of {request.path.name}",
                    d.help,
                    label=d.label,
                )
                for d in result
            ]
        raise DiagnosticError(result)
    return made


def _expand_xacro(request: Request, text: str) -> Description:
    made = Description(request.path, "", True)
    texts: list[str] = []
    defined = macros(text)
    if request.macro:
        document = _wrapper(request, defined)
    else:
        document = text
        texts.append(text)
        made.inputs.append((request.path.name, text.encode()))
        made.sources.append((request.path, text))
    failure: Diagnostic | None = None
    try:
        made.text = _run(request, document, made, texts)
    except DiagnosticError as fault:
        (failure,) = fault.diagnostics
        if failure.code == "RG032":
            failure = _without_colours(request, document, made, texts, failure)
    unknown = _unknown_arguments(request, declared_arguments([*texts, text]))
    if unknown or failure:
        raise DiagnosticError([*unknown, *([failure] if failure else [])])
    for name, (first, second) in request.packages.doubles.items():
        made.found.append(
            error(
                "RG057",
                request.place,
                f"two packages are called '{name}'",
                f"the other is {second}; name one under urdf.packages",
                label=f"used: {first}",
                severity=Severity.WARNING,
            )
        )
    if not request.macro and "<link" not in made.text and defined:
        raise DiagnosticError(_macro_only(request, defined))
    return made


def _without_colours(
    request: Request, document: str, made: Description, texts: list[str], failure: Diagnostic
) -> Diagnostic | None:
    """Expand a description without files of materials in packages that were not found.

    Returns `failure` if more than colours depends on the packages.
    """
    again = Description(request.path, "", True, made.inputs[:1], sources=made.sources[:1])
    if request.macro:
        again.inputs, again.sources = [], []
    absent: dict[str, str] = {}
    try:
        again.text = _run(request, document, again, texts, absent)
    except DiagnosticError:
        return failure
    if _ABSENT in again.text:
        return failure
    made.text, made.inputs, made.sources = again.text, again.inputs, again.sources
    for package, name in absent.items():
        made.found.append(
            error(
                "RG032",
                request.place,
                f"package '{package}' was not found: the robot is read without the colours of "
                f"its {name}",
                f"add\n  urdf:\n    packages: {{{package}: FOLDER}}\nor give --package-path FOLDER",
                severity=Severity.WARNING,
            )
        )
    return None


def _run(
    request: Request,
    document: str,
    made: Description,
    texts: list[str],
    absent: dict[str, str] | None = None,
) -> str:
    """Expand a document.

    With `absent`, files of materials in packages that were not found count as empty; `absent` then
    has package and file name of each.
    """
    import xacro
    from xacro import substitution_args

    reading = [request.path]
    bytes_read = 0

    def find(name: str) -> str:
        try:
            return str(request.packages.find(name))
        except PackageNotFound:
            if absent is None:
                raise
            return str(request.path.absolute().parent / _ABSENT / name)

    def is_absent(path: Path) -> bool:
        """Note a file of materials in a package that was not found."""
        if absent is None or _ABSENT not in path.parts:
            return False
        package = path.parts[path.parts.index(_ABSENT) + 1]
        if not _APPEARANCE.search(path.name):
            request.packages.find(package)
        absent[package] = path.name
        return True

    def plain(document: minidom.Document) -> minidom.Document:
        """Remove colours that are computed: their values may be in a file that is absent."""
        for node in list(document.getElementsByTagName("color")) if absent is not None else []:
            if "$" in node.getAttribute("rgba") and node.parentNode is not None:
                node.parentNode.removeChild(node)
        return document

    def handle_unknown(node: minidom.Element) -> bool:
        """Remove the call of an unknown macro that only gives a colour."""
        if not absent or not _gives_colour(node):
            return False
        xacro.replace_node(node, by=None)
        return True

    def read(path: Path) -> str:
        nonlocal bytes_read
        if path != request.path.resolve() and not request.packages.allows(path):
            raise refusal(
                "RG032",
                request.place,
                f"{path} is outside the folders of {request.path.name} and its packages",
                "give the folder by --package-path FOLDER, or under urdf.packages",
                label=f"included by {reading[-1].name}",
            )
        content, data = read_xml(path, place=request.place)
        bytes_read += len(data)
        if bytes_read > _MOST_BYTES:
            raise ExpressionError(f"its files have more than {_MOST_BYTES:,} bytes")
        made.inputs.append((path.name, data))
        made.sources.append((path, content))
        return content

    original_parse = xacro.parse

    def parse(value: object, filename: str | None = None) -> minidom.Document:
        if value is None and filename is not None:
            path = Path(filename)
            if is_absent(path):
                return minidom.parseString(f'<robot xmlns:xacro="{_NAMESPACE}"/>')
            content = read(path)
            texts.append(content)
            reading.append(path)
            document = plain(minidom.parseString(content))
            reading.pop()
            return document
        parsed: minidom.Document = original_parse(value, filename)
        return parsed

    xacro.parse = parse
    try:
        if len(document) > _MOST_BYTES:
            raise ExpressionError(f"it has more than {_MOST_BYTES:,} bytes")
        xacro.init_stacks(str(request.path))
        tree = plain(minidom.parseString(document))
        with (
            restricted(find, read, request.packages.allows, handle_unknown),
            _bounded_depth(),
        ):
            xacro.process_doc(tree, mappings=dict(request.arguments), verbosity=0)
            return str(tree.toprettyxml(indent="  "))
    except (
        xacro.XacroException,
        substitution_args.SubstitutionException,
        ExpatError,
        ArithmeticError,
        AssertionError,
        AttributeError,
        LookupError,
        NameError,
        OSError,
        RuntimeError,
        SyntaxError,
        TypeError,
        ValueError,
    ) as fault:
        stack = getattr(xacro, "filestack", None) or ()
        names = [Path(name) for name in stack if isinstance(name, str)]
        at = reading[-1] if len(reading) > 1 or not names else names[-1]
        raise DiagnosticError(_translate(request, fault, at)) from None
    finally:
        xacro.parse = original_parse


def _gives_colour(node: minidom.Element) -> bool:
    """True if a macro call is part of what is seen of a link, or has the name of a material."""
    name: str = node.tagName
    around: minidom.Node | None = node.parentNode
    while around is not None:
        if getattr(around, "tagName", "") in ("visual", "material"):
            return True
        around = around.parentNode
    return bool(_APPEARANCE.search(name))


@contextmanager
def _bounded_depth() -> Iterator[None]:
    """Limit the recursion depth of an expansion.

    RAPID's own depth needs a larger limit, at which Python 3.10 runs out of its C stack.
    """
    limit, depth = sys.getrecursionlimit(), 0
    frame: FrameType | None = sys._getframe()
    while frame is not None:
        depth, frame = depth + 1, frame.f_back
    sys.setrecursionlimit(min(limit, depth + _DEEPEST))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


def _translate(request: Request, fault: BaseException, at: Path) -> Diagnostic:
    inner: BaseException = fault
    while isinstance(cause := getattr(inner, "exc", None), BaseException):
        inner = cause
    name = at.name
    place = request.place
    if at.name != request.path.name:
        place = Span(str(at), 1, 1)  # xacro keeps no line numbers
    if isinstance(inner, DiagnosticError):
        return inner.diagnostics[0]
    if isinstance(inner, PackageNotFound):
        package = str(inner).split("'")[1]
        return error(
            "RG032",
            place,
            str(inner),
            f"add\n  urdf:\n    packages: {{{package}: FOLDER}}\nor give --package-path FOLDER",
            label=f"needed by {name}",
        )
    if isinstance(inner, ExpatError):
        unbound = "unbound prefix" in str(inner)
        hint = "declare xmlns:xacro on <robot>" if unbound else "correct the file there"
        return error(
            "RG060",
            Span(str(at), max(1, inner.lineno), inner.offset + 1),
            f"{name} is not well-formed XML: {inner}",
            hint,
        )
    if isinstance(inner, RecursionError):
        hint = "a macro calls, or a file includes, itself without end?"
        return error("RG061", place, f"xacro: {name} nests too deep", hint)
    text = " ".join(str(inner).split())[:_LONGEST_REASON] or type(inner).__name__
    hint = (
        "correct it there, or expand the file where its packages are installed, and give the URDF"
    )
    if type(inner).__name__ == "ArgException":
        expected, text = text, f"the argument '{text}' has no value"
        lines = f"urdf:\n  args: {{{expected}: VALUE}}"
        hint = f"--arg {expected}=VALUE for `new`, in a configuration\n{lines}"
    return error("RG061", place, f"xacro cannot expand {name}: {text}", hint)


def _unknown_arguments(request: Request, known: set[str]) -> list[Diagnostic]:
    return [
        error(
            "RG056",
            request.place,
            f"{request.path.name} has no xacro argument '{name}'",
            suggest(name, sorted(known)) or f"it declares: {', '.join(sorted(known)) or 'none'}",
        )
        for name in request.arguments
        if name not in known
    ]


def _macro_only(request: Request, defined: tuple[Macro, ...]) -> Diagnostic:
    displayed = ", ".join(macro.shown for macro in defined[:6]) + (
        ", ..." if len(defined) > 6 else ""
    )
    robots = [m.name for m in defined if m.joints >= _ROBOT_JOINTS]
    return error(
        "RG031",
        request.place,
        f"{request.path.name} only defines macros: {displayed}",
        "give the top-level file"
        + (f", or add\n  urdf:\n    macro: {robots[0]}" if len(robots) == 1 else ""),
        label="expands to an empty robot",
    )


def _wrapper(request: Request, defined: tuple[Macro, ...]) -> str:
    """Return a document that includes the file and calls the macro."""
    macro = next((m for m in defined if m.name == request.macro), None)
    if macro is None:
        known = [m.name for m in defined]
        raise refusal(
            "RG031",
            request.place,
            f"{request.path.name} defines no macro '{request.macro}'",
            suggest(request.macro, known) or f"it defines: {', '.join(known) or 'none'}",
        )
    given = dict(request.macro_arguments)
    names = {name for name, _ in macro.parameters}
    for name, usual in (("prefix", ""), ("parent", _WORLD), ("name", "robot")):
        if name in names:
            given.setdefault(name, usual)
    link = f'<link name="{_WORLD}"/>' if given.get("parent") == _WORLD else ""
    faults = [
        error(
            "RG056",
            request.place,
            f"macro '{macro.name}' has no parameter '{name}'",
            suggest(name, sorted(names)) or f"it is {macro.shown}",
        )
        for name in given
        if name not in names
    ]
    blocks = [name for name, _ in macro.parameters if name.startswith("*")]
    missing = [n for n, has in macro.parameters if not has and n not in given and n not in blocks]
    missing += [name for name in blocks if name.lstrip("*") != "origin"]
    faults += [
        error(
            "RG056",
            request.place,
            f"macro '{macro.name}' needs a value for '{name}'",
            f"it is {macro.shown}; "
            + (
                "a block cannot be given here: write a xacro file that calls the macro"
                if name.startswith("*")
                else f"add\n  urdf:\n    macro_args: {{{name}: VALUE}}"
            ),
        )
        for name in missing
    ]
    if faults:
        raise DiagnosticError(faults)
    from xml.sax.saxutils import quoteattr  # imports urllib.request, which takes 20 ms

    attributes = "".join(f" {name}={quoteattr(str(value))}" for name, value in given.items())
    inner = '<origin xyz="0 0 0" rpy="0 0 0"/>' if blocks else ""
    return (
        f'<robot name="robot" xmlns:xacro="{_NAMESPACE}">'
        f"<xacro:include filename={quoteattr(str(request.path.resolve()))}/>{link}"
        f"<xacro:{macro.name}{attributes}>{inner}</xacro:{macro.name}></robot>"
    )
