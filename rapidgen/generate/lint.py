"""RAPID text limits that a configuration could exceed [K §2.1, 2.3, 2.13]."""

import re

from rapidgen.diagnostics import Diagnostic, Span, error

MAX_NAME = 32
MAX_STRING = 80
MAX_LINE = 160
_TOKEN = re.compile(r'"((?:[^"\\]|""|\\\\|\\[0-9A-Fa-f]{2})*)"|![^\n]*|([A-Za-z]\w*)')
_NOT_ASCII = re.compile(r"[^\t -\x7f]")
_ESCAPE = re.compile(r'""|\\\\|\\[0-9A-Fa-f]{2}')


def lint(path: str, text: str) -> list[Diagnostic]:
    """Return the faults of one rendered module: all RG101.

    All text is ASCII: with another character, in a comment too, a controller (a virtual one of
    6.15) did not load the module, and its task failed.
    """
    result = []
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > MAX_LINE:
            result.append(_fault(path, number, 1, f"the line has {len(line)} characters"))
        odd = _NOT_ASCII.search(line)
        if odd is not None:
            result.append(_fault(path, number, odd.start() + 1, f"{odd[0]!r} is not ASCII"))
        for token in _TOKEN.finditer(line):
            if token[2] and len(token[2]) > MAX_NAME:
                label = f"the name '{token[2]}' has {len(token[2])} characters"
                result.append(_fault(path, number, token.start() + 1, label))
            elif token[1] is not None:
                size = len(_ESCAPE.sub("x", token[1]))
                if size > MAX_STRING:
                    label = f"the string has {size} characters"
                    result.append(_fault(path, number, token.start() + 1, label))
    return result


def _fault(path: str, line: int, column: int, label: str) -> Diagnostic:
    return error(
        "RG101",
        Span(path, line, column),
        "the configuration does not fit into RAPID text",
        "use shorter names of ASCII letters in the configuration",
        label=label,
        notes=(
            f"names have at most {MAX_NAME} characters, strings {MAX_STRING}, "
            f"lines here {MAX_LINE}; with a character beyond ASCII, in a comment too, a controller "
            "did not load the module",
        ),
    )
