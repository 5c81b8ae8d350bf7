"""Requests, responses and refusals of Robot Web Services."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from rapidgen.wire.rws.bodies import Body, Generation, Item
from rapidgen.wire.rws.codes import CODES


@dataclass(frozen=True, slots=True)
class HttpRequest:
    """A received request. Names of headers are in lower case.

    `target` is as it was sent; `connection` numbers the TCP connection.
    """

    method: str
    target: str
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes = b""
    cookies: Mapping[str, str] = field(default_factory=dict)
    connection: int = 0


@dataclass(frozen=True, slots=True)
class HttpResponse:
    """An HTTP response; its cookies are to be set."""

    status: int
    headers: tuple[tuple[str, str], ...] = ()
    body: bytes = b""
    cookies: Mapping[str, str] = field(default_factory=dict)

    def header(self, name: str) -> str:
        """Return the first header of a name, or an empty text."""
        return next((v for k, v in self.headers if k.lower() == name.lower()), "")


@dataclass(slots=True, eq=False)
class Session:
    """Session of one client."""

    key: str
    user: str
    number: int
    seen: float
    application: str = ""
    location: str = ""
    alias: str = ""
    station: str = ""
    """Control station of RobotWare 8 to which it belongs."""
    on_end: list[Callable[[], None]] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class RwsRequest:
    """A parsed request of a session. `names` are those of the path."""

    generation: Generation
    session: Session
    path: str
    suffix: str
    names: Mapping[str, str]
    query: Mapping[str, str]
    pairs: tuple[tuple[str, str], ...] = ()
    body: bytes = b""
    host: str = ""

    @property
    def form(self) -> dict[str, str]:
        """Return the form's fields; the last of several with one name."""
        return dict(self.pairs)

    @property
    def is_one(self) -> bool:
        """True for RWS 1.0."""
        return self.generation is Generation.ONE

    def field(self, name: str, choices: tuple[str, ...] = ()) -> str:
        """Return a required field.

        RequestDenied: it is missing, or is not one of the choices.
        """
        value = self.form.get(name)
        if value is None or (choices and value not in choices):
            raise RequestDenied(400, "E_INVALIDARG", f"{name}: {value}")
        return value

    def kind(self, one: str, two: str) -> str:
        """Return a class name by generation."""
        return one if self.is_one else two


@dataclass(frozen=True, slots=True)
class RwsResponse:
    """A handler's result: a body, bytes of a file, or nothing (204)."""

    status: int = 204
    body: Body | None = None
    data: bytes | None = None
    headers: tuple[tuple[str, str], ...] = ()


class RequestDenied(Exception):
    """A refusal with ABB's code; `icode` is added after the words."""

    def __init__(self, status: int, name: str, text: str = "", icode: int = -1) -> None:
        super().__init__(f"{status} {name} {text}")
        self.status = status
        self.code = CODES[name]
        self.text = text or name
        self.icode = icode

    @property
    def message(self) -> str:
        """Text as controllers write it: words, then both codes."""
        return f"rapidgen[1] {self.text} code:{self.code} icode:{self.icode}"


def whole(name: str, text: str, least: int = 0, most: int = 999_999_999) -> int:
    """Parse an integer. RequestDenied: invalid, or out of its range."""
    if text.isdecimal() and len(text) < 10 and least <= int(text) <= most:
        return int(text)
    raise RequestDenied(400, "E_INVALIDARG", f"{name}: {text}")


def show(
    *items: Item, title: str = "rw", collection: bool = False, following: str = ""
) -> RwsResponse:
    """Return a response with these items."""
    body = Body(items, title=title, collection=collection, next=following)
    return RwsResponse(200, body)


def page(
    request: RwsRequest, items: Sequence[Item], most: int, name: str, *, always: bool = False
) -> RwsResponse:
    """Return the requested page, at most `most` items.

    `always`: RWS 1.0 divides them too.
    """
    if request.is_one and not always:
        return show(*items, collection=True)
    try:
        start, limit = (
            int(request.query.get(k, str(d))) for k, d in (("start", 0), ("limit", most))
        )
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", "start or limit") from error
    if start < 0 or limit < 1:
        raise RequestDenied(400, "E_INVALIDARG", "start or limit")
    limit = min(limit, most)
    end = start + limit
    following = f"{name}?start={end}&limit={limit}" if end < len(items) else ""
    return show(*items[start:end], collection=True, following=following)
