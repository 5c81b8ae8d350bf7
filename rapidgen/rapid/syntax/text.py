"""Errors of a text as a whole: size, binary, encoding, no module."""

import re
from bisect import bisect_right
from collections.abc import Sequence
from math import isinf
from typing import Final

from rapidgen.diagnostics import Diagnostic, Edit, Fix, Severity, Span, error, replacement
from rapidgen.rapid.syntax import errors
from rapidgen.rapid.syntax.lexer import (
    BAD_RADIX,
    MAX_NAME,
    NAME,
    NUMBER,
    STRING,
    Tokens,
    number_value,
)
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.rapid.syntax.source import TOUCHING, Source

MAX_BYTES: Final = 8_000_000
_HEAD: Final = 4096
_BINARY: Final = re.compile(r"[\x00-\x08\x0e-\x1f]")
_CONTROLS, _ONE_IN = 2, 1000
"""Control characters that a text may have: so many, and one in so many characters."""
_TELLING: Final = frozenset(
    ["ENDMODULE", "PROC", "ENDPROC", "ENDFUNC", "TRAP", "ENDTRAP", "PERS", "CONST"]
)
"""Words that only RAPID has."""
_NUMERIC: Final = frozenset("0123456789.")
_ENCODED: Final = b"\xfc\xfe"
"""First byte of encoded modules in public backups [code]."""
_UTF16: Final = (b"\xff\xfe", b"\xfe\xff")


def refuse(source: str | bytes, path: str) -> Diagnostic | None:
    """Return the diagnostic of a text that cannot be parsed, or None."""
    span = Span(path, 1, 1)
    if len(source) > MAX_BYTES:
        return error(
            "RG209",
            span,
            f"the file has {len(source):,} bytes; {MAX_BYTES:,} is the limit",
            "split the module, or keep positions in a file that the program reads",
        )
    if not source.strip():
        return error("RG208", span, "the file is empty", "a module is MODULE name ... ENDMODULE")
    if isinstance(source, bytes) and source.startswith(_UTF16):
        return error("RG218", span, "the file is UTF-16 text", "save it as UTF-8 or Latin-1")
    # Binary files contain early or many zero bytes. A few control characters in a text are errors
    # at their own places.
    head = source[:_HEAD].decode("latin-1") if isinstance(source, bytes) else source[:_HEAD]
    zeros = source.count(b"\0") if isinstance(source, bytes) else source.count("\0")
    controls = len(_BINARY.findall(head))
    encoded = isinstance(source, bytes) and source[0] in _ENCODED and controls > 0
    few = _CONTROLS + len(head) // _ONE_IN
    if not encoded and controls <= few and zeros <= _CONTROLS + len(source) // _ONE_IN:
        return None
    if encoded:
        return error(
            "RG219",
            span,
            "the module is encoded: only a controller can read it",
            "ask its maker for the source, or leave it out",
            severity=Severity.INFO,
        )
    return error("RG218", span, "the file is binary, not RAPID text")


def no_module(source: Source, kinds: Sequence[str]) -> Diagnostic:
    """Report a text that does not start with MODULE."""
    if not source.tokens:
        return error(
            "RG208",
            errors.place(source, 0),
            "the file has no module, only comments",
            "a module is MODULE name ... ENDMODULE",
        )
    return error(
        "RG208",
        errors.place(source, 0),
        f"met {errors.describe_token(source, kinds, 0)}, expected MODULE",
        "a module is MODULE name ... ENDMODULE",
        label="expected MODULE",
    )


def is_rapid(module: Module) -> bool:
    """Return True if a text looks like RAPID.

    Other languages also use the suffix .mod.
    """
    return any(t.upper() in _TELLING for t in module.source.tokens)


def _unseen(tokens: Tokens) -> Diagnostic:
    """Report invisible characters once."""
    source, places = tokens.source, tokens.blanks
    named = sorted({f"U+{ord(tokens.unread[at]):04X}" for at in places})
    line, column = source.position(places[0])
    more = f", in {len(places)} places" if len(places) > 1 else ""
    edits = tuple(Edit(_character(source, at), " ") for at in places)
    return error(
        "RG204",
        Span(source.path, line, column),
        f"this character has no meaning in RAPID: {' and '.join(named[:3])}{more}",
        "put a blank in its place",
        notes=("the character is invisible or looks like a blank",),
        fixes=(Fix("Put blanks in their place", edits, is_safe=True),),
    )


def _character(source: Source, at: int) -> Span:
    line, column = source.position(at)
    return Span(source.path, line, column, line, column + 1)


def _touching(source: Source) -> list[Diagnostic]:
    """Report the first number with a word touching it."""
    for match in TOUCHING.finditer(source.text):
        at = bisect_right(source.starts, match.start()) - 1
        number = source.tokens[at] if at >= 0 else ""
        if number[:1] in _NUMERIC and source.starts[at] + len(number) == match.start() + 1:
            return [
                error(
                    "RG205",
                    source.span(at, at + 1),
                    f"a blank is missing between {number} and {source.tokens[at + 1]}",
                    "put a blank between them",
                    notes=("[K §2.2] requires one; controllers seem to accept its absence",),
                    severity=Severity.INFO,
                    fixes=replacement("Insert a blank", _between(source, at), " ", is_safe=True),
                )
            ]
    return []


def _between(source: Source, at: int) -> Span:
    """Return the empty span behind token `at`."""
    span = source.span(at, at)
    return Span(span.path, span.end_line, span.end_column, span.end_line, span.end_column)


def spellings(tokens: Tokens) -> list[Diagnostic]:
    """Report long names, tabs in strings and huge numbers once each."""
    findings = [_unseen(tokens)] if tokens.blanks else []
    findings += _touching(tokens.source)
    folded = set()
    for text, kind in tokens.spellings.items():
        if kind in (NUMBER, BAD_RADIX) and isinf(number_value(text)):
            at = tokens.source.tokens.index(text)
            findings.append(
                error(
                    "RG205",
                    tokens.source.span(at, at),
                    f"no type holds {errors.describe_token(tokens.source, tokens.kinds, at)}",
                    "num ends at 3.4E38, dnum at 1.79E308",
                    notes=("an exponent out of range is an error of the text [K §1.4, 2.5]",),
                )
            )
        if kind is STRING and "\t" in text:
            at = tokens.source.tokens.index(text)
            findings.append(
                error(
                    "RG206",
                    tokens.source.span(at, at),
                    "a tab in a string is written as the code \\09",
                    "write \\09 in its place",
                    notes=("the characters of a string [K §2.1, 2.7]",),
                    severity=Severity.WARNING,
                    fixes=replacement(
                        "Write tabs as \\09",
                        tokens.source.span(at, at),
                        text.replace("\t", "\\09"),
                        is_safe=True,
                    ),
                )
            )
        if kind is NAME and len(text) > MAX_NAME and text.lower() not in folded:
            folded.add(text.lower())
            at = tokens.source.tokens.index(text)
            findings.append(
                error(
                    "RG220",
                    tokens.source.span(at, at),
                    f"the name {errors.describe_token(tokens.source, tokens.kinds, at)} "
                    f"has {len(text)} characters; {MAX_NAME} is the limit",
                    "shorten it",
                    notes=("all characters of a name count [K §2.3]",),
                )
            )
    return findings
