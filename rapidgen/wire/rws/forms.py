"""Forms and paths: percent encoding by segment; `$` and `;` stay."""

import re
from collections.abc import Iterable, Mapping
from urllib.parse import quote, unquote, unquote_plus

from rapidgen.wire.rws.bodies import Generation, Unreadable

Fields = Mapping[str, str] | Iterable[tuple[str, str]]
FORM = "application/x-www-form-urlencoded"
_SAFE = "$-_.!~*'(),:@"
"""Characters of a segment that stay: `$` must not be %24 on RobotWare 6."""


def form_type(generation: Generation) -> str:
    """Return the Content-Type of a form.

    RWS 2.0 rejects one without its version (406).
    """
    return FORM if generation is Generation.ONE else f"{FORM};v=2.0"


def write_form(fields: Fields) -> bytes:
    """Return a form, percent-encoded; blanks as %20."""
    pairs = fields.items() if isinstance(fields, Mapping) else fields
    return "&".join(f"{quote(k, safe='')}={quote(v, safe='')}" for k, v in pairs).encode()


def read_form(data: bytes | str) -> list[tuple[str, str]]:
    """Return fields in order; `Attr=[v,1]` may come raw.

    UnicodeDecodeError: not a UTF-8 text.
    """
    text = data.decode() if isinstance(data, bytes) else data
    pairs = (part.partition("=") for part in text.split("&") if part)
    return [(unquote_plus(key), unquote_plus(value)) for key, _, value in pairs]


def segment(text: str) -> str:
    """Return a name as one segment of a path."""
    return quote(text, safe=_SAFE)


def path_of(text: str) -> str:
    """Return a path with several segments, each encoded."""
    return "/".join(segment(part) for part in text.split("/"))


def split_target(target: str) -> tuple[str, str, list[tuple[str, str]]]:
    """Return a request target as path, text after `;`, and query fields.

    A `;` written as %3B belongs to a name. Unreadable: not a path.
    """
    path, _, query = target.partition("?")
    if not path.startswith("/") or re.search(r"%(?![0-9A-Fa-f]{2})", path):
        raise Unreadable("no path")
    path, _, suffix = path.partition(";")
    try:
        decoded, fields = unquote(path, errors="strict"), read_form(query)
        target.encode()
    except UnicodeError as error:
        raise Unreadable("no path") from error
    if "\0" in decoded:
        raise Unreadable("no path")
    return decoded.rstrip("/") or "/", unquote(suffix), fields
