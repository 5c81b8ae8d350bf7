"""The client of a debug session: responses, events, and arguments of requests.

Numbers of lines and columns are the client's (from 0 or from 1) only in this module.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

from rapidgen._json import Json, Members
from rapidgen._message_streams import MessageStream

_LARGEST = 1e300
"""Largest number in a request."""


class RequestRefused(Exception):
    """A request that is not possible; the client shows the text to the user."""


@dataclass(slots=True)
class Client:
    """The other end of a stream, after `initialize` with its properties."""

    stream: MessageStream
    first_line: int = 1
    first_column: int = 1
    has_memory_of_types: bool = False
    """True if it shows types of variables."""
    reads_questions: bool = False
    """True if it answers `rapidgen/question` itself (our extension)."""
    _numbers: "count[int]" = field(default_factory=lambda: count(1))

    def initialise(self, arguments: Members) -> None:
        """Take over what the client says about itself."""
        self.first_line = 0 if arguments.get("linesStartAt1") is False else 1
        self.first_column = 0 if arguments.get("columnsStartAt1") is False else 1
        self.has_memory_of_types = arguments.get("supportsVariableType") is True
        self.reads_questions = arguments.get("supportsRapidgenQuestions") is True

    def respond(self, request: Members, body: Members | None) -> None:
        """Send the response of a request that was executed."""
        self._send(self._response(request, success=True) | ({} if body is None else {"body": body}))

    def refuse(self, request: Members, reason: str, *, code: int = 1, show: bool = False) -> None:
        """Send the response of a request that was not executed; `show`: in a dialog."""
        # Braces would be variables of the format.
        format = reason.replace("{", "(").replace("}", ")")
        error: Members = {"id": code, "format": format, "showUser": show}
        self._send(
            self._response(request, success=False) | {"message": reason, "body": {"error": error}}
        )

    def event(self, name: str, body: Mapping[str, Json] | None = None) -> None:
        """Send an event."""
        self._send(
            {"type": "event", "event": name} | ({} if body is None else {"body": dict(body)})
        )

    def output(self, text: str, category: str = "console", **more: Json) -> None:
        """Send lines for the console; categories: console, important, stdout, stderr."""
        self.event("output", {"category": category, "output": text.rstrip("\n") + "\n", **more})

    def forward(self, message: Members) -> None:
        """Send a message of another adapter."""
        self._send({key: value for key, value in message.items() if key != "seq"})

    def _response(self, request: Members, *, success: bool) -> Members:
        return {
            "type": "response",
            "request_seq": request["seq"],
            "command": request["command"],
            "success": success,
        }

    def _send(self, message: Members) -> None:
        self.stream.write({"seq": next(self._numbers), **message})

    # -- numbers ---------------------------------------------------------------------------------

    def line(self, line: int) -> int:
        """Return a line, from 1, as the client counts."""
        return line - 1 + self.first_line

    def column(self, column: int) -> int:
        """Return a column, from 1, as the client counts."""
        return column - 1 + self.first_column

    def line_of(self, arguments: Members, key: str = "line") -> int:
        """Return the line, from 1, in arguments of a request."""
        return whole(arguments, key) + 1 - self.first_line


# -- arguments -------------------------------------------------------------------------------------
#
# Everything that a client sends may be wrong: each function raises RequestRefused.


def whole(arguments: Members, key: str, default: int | None = None) -> int:
    """Return a whole number."""
    value = arguments.get(key, default)
    if not isinstance(value, int) or isinstance(value, bool):
        raise RequestRefused(f"'{key}' is no whole number")
    return value


def text(arguments: Members, key: str, default: str | None = None) -> str:
    """Return a text."""
    value = arguments.get(key, default)
    if not isinstance(value, str):
        raise RequestRefused(f"'{key}' is no text")
    return value


def flag(arguments: Members, key: str, *, default: bool) -> bool:
    """Return true or false."""
    value = arguments.get(key, default)
    if not isinstance(value, bool):
        raise RequestRefused(f"'{key}' is neither true nor false")
    return value


def number(arguments: Members, key: str, default: float) -> float:
    """Return a number."""
    value = arguments.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise RequestRefused(f"'{key}' is no number")
    if abs(value) > _LARGEST:  # a whole number may be too large for a float
        raise RequestRefused(f"'{key}' is too large")
    return value


def objects(arguments: Members, key: str) -> list[Members]:
    """Return a list of objects, empty if it is missing."""
    value = arguments.get(key)
    if value is None:
        return []
    result = [one for one in value if isinstance(one, dict)] if isinstance(value, list) else []
    if not isinstance(value, list) or len(result) != len(value):
        raise RequestRefused(f"'{key}' is no list of objects")
    return result


def texts(arguments: Members, key: str) -> Sequence[str]:
    """Return texts: a list, one text, or none."""
    value = arguments.get(key)
    values = [] if value is None else [value] if isinstance(value, str) else value
    result = [one for one in values if isinstance(one, str)] if isinstance(values, list) else []
    if not isinstance(values, list) or len(result) != len(values):
        raise RequestRefused(f"'{key}' is neither a text nor a list of texts")
    return result


def members(arguments: Members, key: str) -> Members:
    """Return an object, empty if it is missing."""
    value = arguments.get(key)
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise RequestRefused(f"'{key}' is no object")
    return value
