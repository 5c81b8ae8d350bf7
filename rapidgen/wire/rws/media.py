"""Media types of answers, and their negotiation in each generation.

RWS 1.0 looks at `?json=1` alone. RWS 2.0 rejects `*/*` and a type without its version with 406,
except for files [VC 7.21, real 7.21]; a trailing `;` is tolerated [code: App SDK].
"""

from collections.abc import Callable

from rapidgen.wire.rws import json_bodies, xhtml
from rapidgen.wire.rws.bodies import Body, Generation, Syntax, Unreadable

HAL = "application/hal+json;v=2.0"
XHTML = "application/xhtml+xml;v=2.0"
HAL_21 = "application/hal+json;v=2.1"
"""Requested where the log is read newest first."""
CONTENT_TYPES: dict[Syntax, str] = {
    "xhtml": "application/xhtml+xml",
    "json": "application/json",
    "hal": HAL,
}
FILE_TYPES = ("text/plain;v=2.0", "application/octet-stream;v=2.0")
"""Media types of written files in RWS 2.0; else 415."""
WRITERS: dict[Syntax, Callable[[Body], bytes]] = {
    "xhtml": xhtml.write,
    "json": json_bodies.write_json,
    "hal": json_bodies.write_hal,
}


def plain(value: str) -> str:
    """Return a media type without blanks, case and a trailing semicolon."""
    return value.replace(" ", "").lower().rstrip(";")


def wanted(generation: Generation, accept: str, query: dict[str, str]) -> Syntax | None:
    """Return the syntax of the answer; None is 406."""
    if generation is Generation.ONE:
        return "json" if query.get("json") == "1" else "xhtml"
    for requested in map(plain, accept.split(",")):
        name, _, version = requested.partition(";v=")
        if version.split(";")[0] in ("2.0", "2.1"):
            if name == "application/hal+json":
                return "hal"
            if name == "application/xhtml+xml":
                return "xhtml"
    return None


def read(data: bytes, content_type: str) -> Body:
    """Read a body by its type.

    A 404 for a file says text/html and is JSON [VC 7.21]. Raises Unreadable if it is neither XHTML
    nor JSON.
    """
    if data.lstrip()[:1] == b"{":
        return json_bodies.read(data)
    if "json" in content_type:
        raise Unreadable("it says to be JSON")
    return xhtml.read(data)
