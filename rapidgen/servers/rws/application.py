"""The RWS application without a network, on the controller's thread.

It maps a request to a response. It is as strict as controllers: versions in media types (406, 415),
allowed methods (405), 20 requests a second of RWS 1.0, 70 sessions, mastership.
"""

import secrets
from dataclasses import replace
from functools import partial

from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws import handlers as handlers
from rapidgen.servers.rws.context import Accounts, RwsContext
from rapidgen.servers.rws.event_sources import watched
from rapidgen.servers.rws.messages import (
    HttpRequest,
    HttpResponse,
    RequestDenied,
    RwsRequest,
    RwsResponse,
)
from rapidgen.servers.rws.routing import find
from rapidgen.servers.rws.sessions import Session, Sessions
from rapidgen.servers.rws.subscriptions import Groups
from rapidgen.wire.rws import login as logging_in
from rapidgen.wire.rws.bodies import Body, Fault, Generation, Syntax, Unreadable
from rapidgen.wire.rws.forms import FORM, read_form, split_target
from rapidgen.wire.rws.grants import missing
from rapidgen.wire.rws.media import CONTENT_TYPES, FILE_TYPES, WRITERS, plain, wanted
from rapidgen.wire.rws.operations import RwsOperation

SESSION, CONNECTION = "-http-session-", "ABBCX"
"""Cookies of the session and of the TCP connection."""
LARGEST_FORM = 100_000
_SAFE = ("GET", "HEAD", "OPTIONS")
"""Methods that change nothing."""
_MOST_NONCES = 1000
_MOST_COUNTS = 1000
"""Logins with one nonce."""
_REALM = 'Basic realm="Robot Web Services"'


class RwsApplication:
    """Application that answers requests to one controller."""

    def __init__(
        self,
        runner: ControllerRunner,
        generation: Generation,
        login: Accounts,
        *,
        strict: bool = True,
    ) -> None:
        self.context = office = RwsContext(runner, generation, login, strict=strict)
        self.generation = generation
        # The limit is that of RWS 1.0 [RWS manual].
        self.sessions = Sessions(lambda: runner.now, limited=strict and self.is_one)
        self.groups = office.groups = Groups(
            generation, lambda: runner.controller.scheduler, partial(watched, office)
        )
        office.end_session = self.sessions.end
        office.sessions = self.sessions.all
        self._users = login.users
        self._strict = strict
        self._key = secrets.randbelow(10**9) * 10**6
        self._nonces: dict[str, set[int]] = {}
        """Used counts by nonce: a login is valid once."""
        self._connections: dict[str, Session] = {}
        """Sessions by the cookie of the TCP connection."""
        runner.on_restart.append(self._restarted)
        runner.on_boot.append(self._booted)
        self._booted()

    @property
    def is_one(self) -> bool:
        """True for RWS 1.0."""
        return self.generation is Generation.ONE

    def session_of(self, got: HttpRequest) -> Session | None:
        """Return the session of a request; None if it is not logged in."""
        session = self.sessions.find(_cookies(got).get(SESSION, ""))
        if session is None and self.is_one and (user := self._user(got)) is not None:
            # A client may send its connection's cookie and its digest [code: abb_robot_client].
            number = _cookies(got).get(CONNECTION, "")
            session = self._connections.get(number)
            if session is not None and session.user != user:
                return None
        return session

    def _booted(self) -> None:
        """Let dialogs of programs wait for answers after a boot."""
        self.context.controller.operator.attach()

    def _restarted(self) -> None:
        self.groups.end_all()
        self.sessions.end_all()
        self.context.restarted()
        self._nonces.clear()

    # -- a request -------------------------------------------------------------------------------

    def handle(self, got: HttpRequest) -> HttpResponse:
        """Answer a request."""
        if self.sessions.is_too_fast():
            return HttpResponse(503, (("Retry-After", "1"),))
        try:
            path, suffix, query = split_target(got.target)
        except Unreadable:
            return HttpResponse(400)
        if not got.headers.get("host", "").isascii():
            return HttpResponse(400)
        if got.method not in _SAFE and is_foreign(got):
            return HttpResponse(403)
        session = self.sessions.find(_cookies(got).get(SESSION, ""))
        if session is None:
            entered = self._enter(got)
            if isinstance(entered, HttpResponse):
                return entered
            session = entered
        syntax: Syntax = "xhtml"
        try:
            accepted = self._syntax(got, path, dict(query))
            syntax = accepted or "hal"
            answer = self._carry_out(got, session, path, suffix, dict(query), accepted)
        except RequestDenied as refused:
            title = "rw" if self.is_one else ""
            fault = Fault(refused.code, refused.message)
            answer = RwsResponse(refused.status, Body(title=title, fault=fault))
        return self._reply(got, session, path, answer, syntax)

    def _enter(self, got: HttpRequest) -> Session | HttpResponse:
        """Log in; a response gives the reason for a refusal."""
        user = self._user(got)
        if user is None:
            return HttpResponse(401, (("WWW-Authenticate", self._challenge(got)),))
        return self.sessions.begin(user) or HttpResponse(503, (("Retry-After", "1"),))

    def _challenge(self, got: HttpRequest) -> str:
        if self.generation is not Generation.ONE:
            return _REALM
        nonce = secrets.token_hex(16)
        self._nonces[nonce] = set()
        if len(self._nonces) > _MOST_NONCES:
            del self._nonces[next(iter(self._nonces))]
        # Only the nonce is wrong: the client need not ask its user again.
        return logging_in.challenge(nonce, stale=self._digest(got) is not None)

    def _user(self, got: HttpRequest) -> str | None:
        """Return the user of the Authorization header; None if there is none."""
        header = got.headers.get("authorization", "")
        if self.generation is not Generation.ONE:
            return logging_in.basic_user(header, self._users)
        sent = self._digest(got)
        if sent is None or not self._is_first(sent):
            return None
        return sent.user

    def _digest(self, got: HttpRequest) -> logging_in.Digest | None:
        """Return a login with the right password for this request, of any nonce."""
        sent = logging_in.parse(got.headers.get("authorization", ""))
        if sent is None or not logging_in.is_for(sent, got.target):
            return None
        password = self._users.get(sent.user)
        if password is None or not logging_in.is_right(sent, got.method, password):
            return None
        return sent

    def _is_first(self, sent: logging_in.Digest) -> bool:
        """Use a nonce's count; False if it was used before, or the nonce is unknown.

        Counts may come in any order: a client sends them on several connections.
        """
        used, count = self._nonces.get(sent.nonce), logging_in.count_of(sent)
        if used is None or count is None or count in used:
            return False
        used.add(count)
        if len(used) >= _MOST_COUNTS:
            del self._nonces[sent.nonce]
        return True

    def _syntax(self, got: HttpRequest, path: str, query: dict[str, str]) -> Syntax | None:
        """Return the syntax of the answer; None if the client accepts none."""
        match = wanted(self.generation, got.headers.get("accept", ""), query)
        if match is None and not self._strict:
            return "hal"
        if match is None and path == "/logout":
            return "hal"
        return match

    def _carry_out(
        self,
        got: HttpRequest,
        session: Session,
        path: str,
        suffix: str,
        query: dict[str, str],
        syntax: Syntax | None,
    ) -> RwsResponse:
        files = path.startswith("/fileservice")
        if syntax is None and not (files and got.method in ("GET", "HEAD", "PUT")):
            raise RequestDenied(
                406, "E_INVALIDARG", "cannot generate response for given accept header"
            )
        self._check_type(got, files)
        method = "GET" if got.method == "HEAD" else got.method
        result = find(self.generation, method, path, query)
        if result.handler is None:
            if result.allowed:
                raise RequestDenied(405, "E_INVALIDARG", f"{got.method} {path}")
            raise RequestDenied(404, "E_UNRESOLVED_URL", path)
        self._check_grants(result.operation, session)
        form = got.method == "POST" or path.startswith("/subscription")
        request = RwsRequest(
            self.generation, session, path, suffix, result.names, query,
            self._form(got) if form else (), got.body,
            plain(got.headers.get("content-type", "")), got.headers.get("host", ""),
        )  # fmt: skip
        return result.handler(self.context, request) or RwsResponse()

    def _check_grants(self, operation: RwsOperation | None, session: Session) -> None:
        granted = self.context.login.granted(session.user)
        lacking = missing(operation, self.generation, granted) if operation else ()
        if lacking:
            raise RequestDenied(403, "E_UAS_REJECT", f"user lacks the grant {lacking[0]}", -757)

    def _check_type(self, got: HttpRequest, files: bool) -> None:
        """Check the media type.

        406 for a request without the type that RWS 2.0 requires, 415 for a file of another.
        """
        if got.method in ("GET", "HEAD", "OPTIONS") or not self._strict:
            return
        sent = plain(got.headers.get("content-type", ""))
        if self.generation is Generation.ONE:
            # An empty body is accepted: public clients send such requests [code: rwsuis].
            if got.method == "POST" and got.body and not sent.startswith(FORM):
                raise RequestDenied(415, "E_INVALIDARG", "a form is wanted")
        elif files and got.method == "PUT":
            if sent not in FILE_TYPES:
                raise RequestDenied(415, "E_INVALIDARG", f"Content type {sent} is not supported")
        elif sent != f"{FORM};v=2.0":
            raise RequestDenied(406, "E_INVALIDARG", "Content type is not supported")

    def _form(self, got: HttpRequest) -> tuple[tuple[str, str], ...]:
        if len(got.body) > LARGEST_FORM:
            raise RequestDenied(413, "E_BUFFER_OVERFLOW", "the form is too large")
        try:
            return tuple(read_form(got.body))
        except UnicodeDecodeError as error:
            raise RequestDenied(400, "E_INVALIDARG", "no form") from error

    def _connection(self, got: HttpRequest, session: Session) -> str:
        """The cookie of a TCP connection, which leads to the session."""
        number = str(self._key + got.connection)
        if number not in self._connections:
            self._connections[number] = session
            session.on_end.append(lambda: self._connections.__delitem__(number))
        return number

    def _reply(
        self, got: HttpRequest, session: Session, path: str, answer: RwsResponse, syntax: Syntax
    ) -> HttpResponse:
        headers = [*answer.headers]
        cookies = {SESSION: session.key, CONNECTION: self._connection(got, session)}
        for name, value in cookies.items():
            # A page of another server that runs in the same browser must not use the session.
            headers.append(("Set-Cookie", f"{name}={value}; path=/; httponly; samesite=strict"))
        if answer.body is None:
            if not any(name == "Content-Type" for name, _ in headers):
                if answer.data is not None:
                    headers.append(("Content-Type", "application/octet-stream"))
                elif self.is_one and answer.status != 204:
                    # Also of an answer without a body [code: abb_robot_client].
                    headers.append(("Content-Type", CONTENT_TYPES[syntax]))
            return HttpResponse(answer.status, tuple(headers), answer.data or b"")
        scheme = "http" if self.is_one else "https"
        base = f"{scheme}://{got.headers.get('host', '')}{path.rpartition('/')[0]}/"
        body = replace(answer.body, base=base, here=answer.body.here or path.rpartition("/")[2])
        kind = CONTENT_TYPES[syntax]
        if syntax == "xhtml" and self.generation is not Generation.ONE:
            kind += ";v=2.0"
        headers.append(("Content-Type", kind))
        return HttpResponse(answer.status, tuple(headers), WRITERS[syntax](body))


def is_foreign(got: HttpRequest) -> bool:
    """True if a page of another server sent a request: its Origin is not the Host.

    A browser adds a user's login and cookies to such a request. Other clients send no Origin, or
    the server's own address.
    """
    origin = got.headers.get("origin")
    if origin is None:
        return False
    _, _, netloc = origin.partition("://")
    return netloc.lower() != got.headers.get("host", "").lower()


def _cookies(got: HttpRequest) -> dict[str, str]:
    parts = (part.strip().partition("=") for part in got.headers.get("cookie", "").split(";"))
    return {name: value for name, _, value in parts if name}
