"""The RWS application: resources of one controller, without a network.

`RwsApplication.handle` maps a request to a response, on the controller's thread. The application
holds all that clients share: accounts, logins, sessions, masterships, subscriptions, the state of
handlers. It is as strict as controllers: versions in media types (406, 415), allowed methods (405),
20 requests a second of RWS 1.0, 70 sessions, mastership.

aiohttp does the rest (`server.py`): HTTP, TLS and websockets. It does not find routes: `?action=`
selects an operation in RWS 1.0, the answer to an unknown path or method has a body with ABB's code,
after the checks of login and media type, and the index below is faster. It has no negotiation of
media types. Handlers register with `@serves(...)`; importing this package imports them.
"""

import re
import secrets
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache

from rapidgen.controller.controller import VirtualController
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.client_queue import ClientQueue
from rapidgen.servers.rws.mastership import ManualPrivilege, Masterships
from rapidgen.servers.rws.messages import (
    HttpRequest,
    HttpResponse,
    RequestDenied,
    RwsRequest,
    RwsResponse,
    Session,
)
from rapidgen.servers.rws.subscriptions import Groups
from rapidgen.wire.rws import login as logging_in
from rapidgen.wire.rws.bodies import Body, Fault, Generation, Syntax, Unreadable
from rapidgen.wire.rws.codes import CODES, OK
from rapidgen.wire.rws.forms import FORM, read_form, split_target
from rapidgen.wire.rws.grants import GRANTS, missing, needed
from rapidgen.wire.rws.media import CONTENT_TYPES, FILE_TYPES, WRITERS, plain, wanted
from rapidgen.wire.rws.operations import Route, RwsOperation

SESSION, CONNECTION = "-http-session-", "ABBCX"
"""Cookies of the session and of the TCP connection."""
LARGEST_FORM = 100_000
MOST_SESSIONS, IDLE = 70, 300.0
"""Sessions in all, and s without a request that end one [RWS manual]."""
RATE = 20
"""Requests in a second of the controller's clock, on RWS 1.0 [RWS manual]."""
_SAFE = ("GET", "HEAD", "OPTIONS")
"""Methods that change nothing."""
_MOST_NONCES = 1000
_MOST_COUNTS = 1000
"""Logins with one nonce."""
_MOST_CONNECTIONS = 1000
"""TCP connections that are remembered."""
_DEEPEST = 8
"""Parts of a path in which routes may begin to differ: a path may have thousands."""
_LATER = (("Retry-After", "1"),)


# -- routes --------------------------------------------------------------------------------------

Handler = Callable[["RwsApplication", RwsRequest], RwsResponse | None]
_TABLE: list[tuple[RwsOperation, Handler]] = []


def serves(*operations: RwsOperation) -> Callable[[Handler], Handler]:
    """Register the decorated function for these operations."""

    def put(handler: Handler) -> Handler:
        _TABLE.extend((operation, handler) for operation in operations)
        return handler

    return put


def served() -> tuple[tuple[RwsOperation, Handler], ...]:
    """Return all served operations and their handlers."""
    return tuple(_TABLE)


@dataclass(frozen=True, slots=True)
class _Row:
    pattern: re.Pattern[str]
    route: Route
    grants: tuple[str, ...]
    handler: Handler


@cache
def _rows(generation: Generation) -> Mapping[str, tuple[_Row, ...]]:
    """Return the rows by the part of their path before the first name."""
    result: dict[str, list[_Row]] = {}
    for operation, handler in _TABLE:
        if route := operation.route(generation):
            row = _Row(route.pattern, route, needed(operation, generation), handler)
            result.setdefault(route.path.partition("{")[0].rstrip("/"), []).append(row)

    def vagueness(row: _Row) -> tuple[int, bool, int, bool]:
        path = row.route.path
        return path.count("{"), "*" in path, -len(path), not row.route.selector

    # The more specific path goes first: `{signal*}/config` before `{signal*}`.
    return {start: tuple(sorted(rows, key=vagueness)) for start, rows in result.items()}


@cache
def services(generation: Generation) -> tuple[str, ...]:
    """Return the names directly below `/rw`."""
    starts = (start.split("/") for start in _rows(generation))
    return tuple(sorted({start[2] for start in starts if start[1] == "rw" and len(start) > 2}))


def _find(
    generation: Generation, method: str, path: str, query: Mapping[str, str]
) -> tuple[_Row, dict[str, str]]:
    """Return the row of a request, and the names in its path.

    RequestDenied: 404 without such a path, 405 with another method or verb.
    """
    verb = f"action={query['action']}" if query.get("action") else ""
    selectors = (verb,) if verb else (f"resource={query.get('resource', '')}", "")
    rows, status = _rows(generation), 404
    start = "/".join(path.split("/", _DEEPEST)[:_DEEPEST])
    while start:
        for row in rows.get(start, ()):
            match = row.pattern.fullmatch(path)
            if match is None:
                continue
            if row.route.method == method and row.route.selector in selectors:
                return row, match.groupdict()
            status = 405
        start = start.rpartition("/")[0]
    if status == 405:
        raise RequestDenied(405, "E_INVALIDARG", f"{method} {path}")
    raise RequestDenied(404, "E_UNRESOLVED_URL", path)


# -- users and sessions --------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Accounts:
    """Accounts that may log in.

    All users have all grants except `Default User`, which lacks those of `denied`.
    """

    users: dict[str, str]
    denied: frozenset[str] = frozenset()

    def granted(self, user: str) -> frozenset[str]:
        """Return a user's grants by UAS name."""
        return frozenset(GRANTS) - (self.denied if user == "Default User" else frozenset())


class Logins:
    """Checks of the Authorization header: Digest in RWS 1.0, Basic in 2.0."""

    def __init__(self, users: Mapping[str, str], *, is_digest: bool) -> None:
        self._users = users
        self._is_digest = is_digest
        self.nonces: dict[str, set[int]] = {}
        """Used counts by nonce: a login is valid once."""

    def user(self, http: HttpRequest) -> str | None:
        """Return the user of a request; None without a valid login."""
        header = http.headers.get("authorization", "")
        if not self._is_digest:
            return logging_in.basic_user(header, self._users)
        sent = self._digest(http)
        return sent.user if sent is not None and self._is_first(sent) else None

    def challenge(self, http: HttpRequest) -> str:
        """Return WWW-Authenticate for a request without a valid login."""
        if not self._is_digest:
            return 'Basic realm="Robot Web Services"'
        nonce = secrets.token_hex(16)
        self.nonces[nonce] = set()
        if len(self.nonces) > _MOST_NONCES:
            del self.nonces[next(iter(self.nonces))]
        # Only the nonce is wrong: the client need not ask its user again.
        return logging_in.challenge(nonce, stale=self._digest(http) is not None)

    def _digest(self, http: HttpRequest) -> logging_in.Digest | None:
        """Return a login with the right password for this request, of any nonce."""
        sent = logging_in.parse(http.headers.get("authorization", ""))
        if sent is None or not logging_in.is_for(sent, http.target):
            return None
        password = self._users.get(sent.user)
        if password is None or not logging_in.is_right(sent, http.method, password):
            return None
        return sent

    def _is_first(self, sent: logging_in.Digest) -> bool:
        """Use a nonce's count; False if it was used before, or the nonce is unknown.

        Counts may come in any order: a client sends them on several connections.
        """
        used, count = self.nonces.get(sent.nonce), logging_in.count_of(sent)
        if used is None or count is None or count in used:
            return False
        used.add(count)
        if len(used) >= _MOST_COUNTS:
            del self.nonces[sent.nonce]
        return True


class Sessions:
    """All sessions, and their limits by the controller's clock."""

    def __init__(self, clock: Callable[[], float], *, limited: bool) -> None:
        """`limited`: at most RATE requests in a second."""
        self._clock = clock
        self._limited = limited
        self._sessions: dict[str, Session] = {}
        self._recent: deque[float] = deque()
        self._made = 0

    def __len__(self) -> int:
        return len(self._sessions)

    def all(self) -> tuple[Session, ...]:
        """All sessions, in the order of their start."""
        self._expire()
        return tuple(self._sessions.values())

    def is_too_fast(self) -> bool:
        """Count a request; True if it exceeds the rate."""
        if not self._limited:
            return False
        now = self._clock()
        while self._recent and self._recent[0] <= now - 1:
            self._recent.popleft()
        if len(self._recent) >= RATE:
            return True
        self._recent.append(now)
        return False

    def find(self, key: str) -> Session | None:
        """Return the session of a cookie and keep it alive; None if it ended."""
        self._expire()
        session = self._sessions.get(key)
        if session is not None:
            session.seen = self._clock()
        return session

    def begin(self, user: str) -> Session | None:
        """Create a session; None if there are too many."""
        self._expire()
        if len(self._sessions) >= MOST_SESSIONS:
            return None
        self._made += 1
        session = Session(secrets.token_hex(16), user, self._made, self._clock())
        self._sessions[session.key] = session
        return session

    def end(self, session: Session) -> None:
        """End a session and everything that depends on it."""
        if self._sessions.pop(session.key, None) is not None:
            for act in tuple(session.on_end):
                act()

    def end_all(self) -> None:
        """End all sessions, for a restart."""
        for session in tuple(self._sessions.values()):
            self.end(session)
        self._recent.clear()

    def _expire(self) -> None:
        before = self._clock() - IDLE
        for session in tuple(self._sessions.values()):
            if session.seen < before:
                self.end(session)


# -- the application -----------------------------------------------------------------------------


class RwsApplication:
    """Resources of one controller, and the state that its clients share."""

    controller: VirtualController
    """The running controller; a restart replaces it."""
    masterships: Masterships

    def __init__(
        self,
        runner: ControllerRunner,
        generation: Generation,
        accounts: Accounts,
        *,
        strict: bool = True,
    ) -> None:
        self.runner = runner
        self.generation = generation
        self.accounts = accounts
        self.strict = strict
        self.is_one = generation is Generation.ONE
        self.sessions = Sessions(lambda: runner.now, limited=strict and self.is_one)
        self.groups = Groups(self)
        """Subscriptions."""
        self.progress: dict[str, int] = {}
        """Result codes of jobs by number."""
        self.dialogs: dict[int, str] = {}
        """Answers to dialogs by number, until they are complete."""
        self.queues: dict[str, ClientQueue] = {}
        """Message queues of clients, by name in lower case."""
        self.chosen: dict[str, dict[str, str]] = {}
        """Clients' choices for jogging by mechanical unit: tool, wobj, ..."""
        self.led: set[str] = set()
        """Units in lead-through."""
        self.program_names: dict[str, str] = {}
        """Names of loaded program files, by task."""
        self.mode_lock = ""
        """Lock of the operating mode by a pin: `Temporary`, `Permanent` or empty."""
        self._logins = Logins(accounts.users, is_digest=self.is_one)
        self._key = secrets.randbelow(10**9) * 10**6
        self._connections: dict[str, str] = {}
        """Keys of sessions by the cookie of the TCP connection."""
        runner.on_restart.append(self._restarted)
        runner.on_boot.append(self._booted)
        self._booted()

    def _booted(self) -> None:
        controller = self.controller = self.runner.controller
        manual = ManualPrivilege(controller, lambda: self.runner.now)
        self.masterships = Masterships(
            self.generation, lambda: controller.mode, manual, strict=self.strict
        )
        # Dialogs of programs wait for answers.
        controller.operator.attach()

    def _restarted(self) -> None:
        self.groups.end_all()
        self.sessions.end_all()
        self._logins.nonces.clear()
        for state in (self.progress, self.dialogs, self.queues, self.chosen, self.led):
            state.clear()

    def started(self, refused: str) -> RwsResponse:
        """Return the answer to a job that has ended already.

        It is a refusal with a code's name, or a success. RWS 2.0, and a backup in RWS 1.0, answer
        202 with the address of the result.
        """
        number = str(len(self.progress) + 1)
        self.progress[number] = CODES[refused] if refused else OK
        return RwsResponse(202, headers=(("Location", f"/progress/{number}"),))

    # -- a request -------------------------------------------------------------------------------

    def session_of(self, http: HttpRequest) -> Session | None:
        """Return the session of a request; None if it is not logged in."""
        session = self.sessions.find(http.cookies.get(SESSION, ""))
        if session is None and self.is_one and (user := self._logins.user(http)) is not None:
            # A client may send its connection's cookie and its digest [code: abb_robot_client].
            connection = http.cookies.get(CONNECTION, "")
            session = self.sessions.find(self._connections.get(connection, ""))
            if session is not None and session.user != user:
                return None
        return session

    def handle(self, http: HttpRequest) -> HttpResponse:
        """Answer a request."""
        if self.sessions.is_too_fast():
            return HttpResponse(503, _LATER)
        try:
            path, suffix, pairs = split_target(http.target)
        except Unreadable:
            return HttpResponse(400)
        query = dict(pairs)
        syntax = wanted(self.generation, http.headers.get("accept", ""), query)
        content_type = plain(http.headers.get("content-type", ""))
        host = http.headers.get("host", "")
        if not host.isascii():
            return HttpResponse(400)
        if http.method not in _SAFE and is_foreign(http):
            return HttpResponse(403)
        session = self.sessions.find(http.cookies.get(SESSION, ""))
        if session is None:
            user = self._logins.user(http)
            if user is None:
                return HttpResponse(401, (("WWW-Authenticate", self._logins.challenge(http)),))
            session = self.sessions.begin(user)
            if session is None:
                return HttpResponse(503, _LATER)
        if syntax is None and (not self.strict or path == "/logout"):
            syntax = "hal"
        try:
            self._check_types(http, path, syntax, content_type)
            method = "GET" if http.method == "HEAD" else http.method
            row, names = _find(self.generation, method, path, query)
            if row.grants:
                self._check_grants(row.grants, session)
            form = self._form(http) if method == "POST" or path.startswith("/subscription") else ()
            answer = row.handler(
                self,
                RwsRequest(
                    self.generation, session, path, suffix, names, query, form, http.body, host
                ),
            )
        except RequestDenied as denied:
            fault = Fault(denied.code, denied.message)
            answer = RwsResponse(
                denied.status, Body(title="rw" if self.is_one else "", fault=fault)
            )
        return self._reply(http, session, path, answer or RwsResponse(), syntax or "hal")

    def _check_types(
        self, http: HttpRequest, path: str, syntax: Syntax | None, content_type: str
    ) -> None:
        """Check media types.

        406 for a request without those that RWS 2.0 requires, 415 for a file of another.
        """
        files = path.startswith("/fileservice")
        if syntax is None and not (files and http.method in ("GET", "HEAD", "PUT")):
            text = "cannot generate response for given accept header"
            raise RequestDenied(406, "E_INVALIDARG", text)
        if http.method in _SAFE or not self.strict:
            return
        if self.is_one:
            # An empty body is accepted: public clients send such requests [code: rwsuis].
            if http.method == "POST" and http.body and not content_type.startswith(FORM):
                raise RequestDenied(415, "E_INVALIDARG", "a form is wanted")
        elif files and http.method == "PUT":
            if content_type not in FILE_TYPES:
                text = f"Content type {content_type} is not supported"
                raise RequestDenied(415, "E_INVALIDARG", text)
        elif content_type != f"{FORM};v=2.0":
            raise RequestDenied(406, "E_INVALIDARG", "Content type is not supported")

    def _check_grants(self, grants: tuple[str, ...], session: Session) -> None:
        lacking = missing(grants, self.accounts.granted(session.user))
        if lacking:
            raise RequestDenied(403, "E_UAS_REJECT", f"user lacks the grant {lacking[0]}", -757)

    def _form(self, http: HttpRequest) -> tuple[tuple[str, str], ...]:
        if len(http.body) > LARGEST_FORM:
            raise RequestDenied(413, "E_BUFFER_OVERFLOW", "the form is too large")
        try:
            return tuple(read_form(http.body))
        except UnicodeDecodeError as error:
            raise RequestDenied(400, "E_INVALIDARG", "no form") from error

    def _reply(
        self, http: HttpRequest, session: Session, path: str, answer: RwsResponse, syntax: Syntax
    ) -> HttpResponse:
        number = str(self._key + http.connection)
        self._connections[number] = session.key
        if len(self._connections) > _MOST_CONNECTIONS:
            del self._connections[next(iter(self._connections))]
        cookies = {SESSION: session.key, CONNECTION: number}
        if answer.body is None:
            headers, kind = answer.headers, ""
            if answer.data is not None:
                kind = "application/octet-stream"
            elif self.is_one and answer.status != 204:
                # Also of an answer without a body [code: abb_robot_client].
                kind = CONTENT_TYPES[syntax]
            if kind and not any(name == "Content-Type" for name, _ in headers):
                headers += (("Content-Type", kind),)
            return HttpResponse(answer.status, headers, answer.data or b"", cookies)
        folder, _, last = path.rpartition("/")
        scheme = "http" if self.is_one else "https"
        body = replace(
            answer.body,
            base=f"{scheme}://{http.headers.get('host', '')}{folder}/",
            here=answer.body.here or last,
        )
        kind = CONTENT_TYPES[syntax]
        if syntax == "xhtml" and not self.is_one:
            kind += ";v=2.0"
        headers = (*answer.headers, ("Content-Type", kind))
        return HttpResponse(answer.status, headers, WRITERS[syntax](body), cookies)


def is_foreign(http: HttpRequest) -> bool:
    """True if a page of another server sent a request: its Origin is not the Host.

    A browser adds a user's login and cookies to such a request. Other clients send no Origin, or
    the server's own address.
    """
    origin = http.headers.get("origin")
    if origin is None:
        return False
    _, _, netloc = origin.partition("://")
    return netloc.lower() != http.headers.get("host", "").lower()
