"""A JSON socket of the controller: one object a line, one answer a line.

Request `{"do": "signals", ...}` with an optional `id`; answer `{"ok": true, "result": ...}` or
`{"ok": false, "error": "..."}` with the same `id`. Commands that change something need the `token`,
which only the user who started the simulator has, and whom he gives it to. After `{"do":
"subscribe"}` events are sent in between as `{"event": ...}`. `control_commands.py` has the
commands; this module has lines, limits and misbehaving clients. The connection is closed at a line
that is not a JSON object: a web page can send an HTTP request here, whose body would otherwise be
executed after its header. It is also closed at a line that is too long, and if a client reads too
slowly.
"""

import hmac
import json
import math
import secrets
import selectors
import socket
from collections.abc import Callable, Collection, Mapping
from typing import TypeAlias

from rapidgen._json import Json, Members
from rapidgen.machine.scheduler import Scheduler

MAX_CLIENTS = 16
MAX_LINE = 65_536
MAX_UNREAD = 1_048_576
"""Bytes that may wait for a client that does not read."""

Command: TypeAlias = Callable[[Members], Json]
"""Function that executes a request and returns its result."""
Listener: TypeAlias = Callable[[Members], None]
Subscribe: TypeAlias = Callable[[Listener, bool], Callable[[], None]]
"""Function that starts a subscription.

The flag is true if the client may change something.
"""


def _finite(text: str) -> float:
    """Parse a number of a request.

    ValueError: JSON cannot represent it in an answer.
    """
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text} is no number")
    return value


class CommandError(Exception):
    """A request that cannot be executed; the client receives the text."""


class _Client:
    __slots__ = ("end", "input", "output", "socket")

    def __init__(self, own: socket.socket) -> None:
        self.socket = own
        self.input = bytearray()
        self.output = bytearray()
        self.end: Callable[[], None] | None = None
        """Function that ends the subscription."""


class ControlSocket:
    """Server of `commands` on a port, driven by the scheduler's selector.

    Commands in `readable` need no token. `subscribe(listener, trusted)` starts events and returns
    the function that ends them. Raises OSError if the port is not available.
    """

    def __init__(
        self,
        scheduler: Scheduler,
        commands: Mapping[str, Command],
        subscribe: Subscribe,
        *,
        readable: Collection[str] = (),
        token: str = "",
        host: str = "127.0.0.1",
        port: int = 0,
    ) -> None:
        self.token = token or secrets.token_urlsafe(24)
        """The `token` of requests that change something."""
        self._readable = frozenset(readable)
        self._scheduler = scheduler
        self._commands = commands
        self._subscribe = subscribe
        self._clients: dict[_Client, None] = {}
        self._server = socket.create_server((host, port), backlog=MAX_CLIENTS)
        self._server.setblocking(False)
        self.address: tuple[str, int] = self._server.getsockname()[:2]
        scheduler.selector.register(self._server, selectors.EVENT_READ, self._accept)

    def close(self) -> None:
        """Stop serving."""
        for client in tuple(self._clients):
            self._drop(client)
        self._scheduler.selector.unregister(self._server)
        self._server.close()

    def _accept(self, _mask: int) -> None:
        try:
            own, _ = self._server.accept()
        except OSError:
            return  # the client has gone, or no handle is free: keep serving
        if len(self._clients) >= MAX_CLIENTS:
            own.close()
            return
        own.setblocking(False)
        client = _Client(own)
        self._clients[client] = None
        self._watch(client, selectors.EVENT_READ, new=True)

    def _watch(self, client: _Client, events: int, *, new: bool = False) -> None:
        selector = self._scheduler.selector
        change = selector.register if new else selector.modify
        change(client.socket, events, lambda mask: self._ready(client, mask))

    def _drop(self, client: _Client) -> None:
        if client not in self._clients:
            return
        del self._clients[client]
        if client.end is not None:
            client.end()
        self._scheduler.selector.unregister(client.socket)
        client.socket.close()

    def _ready(self, client: _Client, mask: int) -> None:
        if client in self._clients and mask & selectors.EVENT_WRITE:
            self._flush(client)
        if client in self._clients and mask & selectors.EVENT_READ:
            self._read(client)

    def _read(self, client: _Client) -> None:
        try:
            data = client.socket.recv(MAX_LINE)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            self._drop(client)
            return
        client.input += data
        while (end := client.input.find(b"\n")) >= 0:
            line = bytes(client.input[:end])
            del client.input[: end + 1]
            if line.strip():
                request = self._parse(client, line)
                if request is None:
                    return
                self._send(client, self._answer(client, request))
            if client not in self._clients:
                return
        if len(client.input) > MAX_LINE:
            self._send(client, {"ok": False, "error": f"a line has at most {MAX_LINE} bytes"})
            self._drop(client)

    def _parse(self, client: _Client, line: bytes) -> Members | None:
        """Return the object of a line, or close the connection."""
        error = "a request is a JSON object"
        try:
            request = json.loads(line, parse_float=_finite, parse_constant=_finite)
        except (ValueError, RecursionError) as fault:
            request, error = None, f"not JSON: {fault}"
        if isinstance(request, dict):
            return request
        self._send(client, {"ok": False, "error": error})
        self._drop(client)
        return None

    def _answer(self, client: _Client, request: Members) -> Members:
        name = request.get("do")
        if not isinstance(name, str):
            return {"ok": False, "error": 'a request is an object with "do"'}
        if not isinstance(request.get("id", ""), str | int):
            return {"ok": False, "error": "an id is a text or a whole number"}
        answer: dict[str, Json] = {"id": request["id"]} if "id" in request else {}
        try:
            result = self._perform(client, name, request)
        except CommandError as error:
            return {**answer, "ok": False, "error": str(error)}
        return {**answer, "ok": True, "result": result}

    def _perform(self, client: _Client, name: str, request: Members) -> Json:
        trusted = self._has_token(request)
        if name == "subscribe":
            former = client.end
            if former is None or trusted:
                client.end = self._subscribe(lambda event: self._send(client, event), trusted)
                if former is not None:
                    former()
            return None
        command = self._commands.get(name)
        if command is None:
            known = ", ".join(sorted([*self._commands, "subscribe"]))
            raise CommandError(f"cannot do '{name}'; can do {known}")
        if name not in self._readable and not trusted:
            raise CommandError(
                f"'{name}' changes the controller and needs the 'token' that the line "
                "'ready' of the simulator gives"
            )
        return command(request)

    def _has_token(self, request: Members) -> bool:
        """True if a request has the right token.

        CommandError: it has another one.
        """
        if "token" not in request:
            return False
        given = request["token"]
        # A JSON text may have half of a surrogate pair, which UTF-8 cannot encode.
        if isinstance(given, str) and hmac.compare_digest(
            given.encode("utf-8", "surrogatepass"), self.token.encode()
        ):
            return True
        raise CommandError("the 'token' is not that of this simulator")

    def _send(self, client: _Client, message: Members) -> None:
        if client not in self._clients:
            return
        client.output += json.dumps(message, allow_nan=False).encode() + b"\n"
        if len(client.output) > MAX_UNREAD:
            self._drop(client)
            return
        self._flush(client)

    def _flush(self, client: _Client) -> None:
        try:
            sent = client.socket.send(client.output)
        except BlockingIOError:
            sent = 0
        except OSError:
            self._drop(client)
            return
        del client.output[:sent]
        events = selectors.EVENT_READ | (selectors.EVENT_WRITE if client.output else 0)
        self._watch(client, events)
