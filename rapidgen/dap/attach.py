"""Attach to a running simulator: its endpoint, and the relay of the adapter to it.

The control socket of `rapidgen sim` opens the endpoint for clients with the token. It is a loopback
port with a thread of its own, because the control socket waits while the debugger pauses the
controller. A key, which only the answer of the control socket contains, admits one connection.
"""

import hmac
import json
import secrets
import socket
import threading
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

from rapidgen._json import Json, Members
from rapidgen._message_streams import MessageStream
from rapidgen.dap.client import Client, RequestRefused, members, text, whole
from rapidgen.diagnostics import DiagnosticError, refusal
from rapidgen.wire.framing import ContentError, FramingError

if TYPE_CHECKING:
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.dap.session import Session

_ADMISSION = 10.0
"""s between the answer of the control socket and the connection."""
_ANSWER = 5.0
"""s that the control socket has to answer; a simulator that is paused does not."""
_LONGEST_ANSWER = 65_536


# -- in the simulator ------------------------------------------------------------------------------


class Endpoint:
    """Debug sessions of other processes on the controller of a simulator."""

    def __init__(self, runner: "ControllerRunner") -> None:
        self._runner = runner

    def open(self, _request: Members) -> Json:
        """Command `debug` of the control socket: return port and key of one session."""
        server = socket.create_server(("127.0.0.1", 0), backlog=1)
        key = secrets.token_urlsafe(24)
        threading.Thread(
            target=self._serve, args=(server, key), name="debug session", daemon=True
        ).start()
        return {"port": server.getsockname()[1], "key": key}

    def _serve(self, server: socket.socket, key: str) -> None:
        with server:
            server.settimeout(_ADMISSION)
            try:
                own, _ = server.accept()
            except OSError:
                return
        with own:
            own.settimeout(_ADMISSION)
            own.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            stream = MessageStream(own.recv, own.sendall)
            try:
                hello = stream.read()
                given = (hello or {}).get("key")
                if isinstance(given, str) and hmac.compare_digest(
                    given.encode("utf-8", "surrogatepass"), key.encode()
                ):
                    own.settimeout(None)
                    _Attached(self._runner, stream, members(hello or {}, "initialize")).read()
            except (ContentError, FramingError, RequestRefused):
                return


class _Attached:
    """A client of the endpoint: one thread reads, the controller's thread executes."""

    def __init__(
        self, runner: "ControllerRunner", stream: MessageStream, initialize: Members
    ) -> None:
        self._runner = runner
        self._stream = stream
        self._client = Client(stream)
        self._client.initialise(initialize)
        self._inbox: SimpleQueue[Members | None] = SimpleQueue()
        self._session: Session | None = None
        self._has_left = threading.Event()

    def read(self) -> None:
        """Read messages until the client leaves."""
        self._runner.on_boot.append(self._drain)
        message: Members | None = {}
        try:
            while message is not None and not self._has_left.is_set():
                message = self._stream.read()
                self._inbox.put(message)
                # False during a restart, after which the messages are executed.
                self._runner.post(self._drain)
        finally:
            self._inbox.put(None)
            self._runner.post(self._drain)

    def _drain(self) -> None:
        while True:
            try:
                message = self._inbox.get_nowait()
            except Empty:
                return
            if message is None:
                self._leave()
            elif not self._has_left.is_set():
                self._take(message)

    def _leave(self) -> None:
        session, self._session = self._session, None
        if session is not None:
            session.close()
            self._runner.on_boot.remove(self._drain)
        self._has_left.set()

    def _take(self, message: Members) -> None:
        command = message.get("command")
        if not isinstance(command, str) or not isinstance(message.get("seq"), int):
            return
        try:
            body = self._perform(command, members(message, "arguments"))
        except RequestRefused as reason:
            self._client.refuse(message, str(reason))
            return
        self._client.respond(message, body)
        if command == "attach":
            self._client.event("initialized")
        elif command == "configurationDone" and self._session is not None:
            self._session.report_pause()
        elif command in ("disconnect", "terminate"):
            self._client.event("terminated")
            self._leave()

    def _perform(self, command: str, arguments: Members) -> Members | None:
        from rapidgen.dap.session import Session

        if command == "attach" and self._session is None:
            self._session = Session(self._runner, self._client, ends=False)
            return None
        if self._session is None:
            raise RequestRefused(f"'{command}' comes after 'attach'")
        if command == "restart":
            self._runner.ask_restart()
        elif command not in ("configurationDone", "disconnect", "terminate"):
            return self._session.execute(command, arguments)
        return None


# -- in the adapter --------------------------------------------------------------------------------


class Relay:
    """The connection of an adapter to a simulator, whose messages it passes on."""

    def __init__(self, client: Client, initialize: Members, arguments: Members) -> None:
        """Connect with `control` and `token` of the arguments. DiagnosticError RG940."""
        port, token = whole(arguments, "control"), text(arguments, "token", "")
        answer = _ask(port, token)
        self._client = client
        try:
            self._own = socket.create_connection(
                ("127.0.0.1", whole(answer, "port")), timeout=_ANSWER
            )
        except OSError as fault:
            raise _cannot(f"the simulator's debug port: {fault.strerror or fault}") from fault
        self._own.settimeout(None)
        self._own.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._stream = MessageStream(self._own.recv, self._own.sendall)
        self._stream.write({"key": text(answer, "key"), "initialize": initialize})
        threading.Thread(target=self._read, name="simulator", daemon=True).start()

    def forward(self, message: Members) -> None:
        """Pass a message of the client on."""
        self._stream.write(message)

    def _read(self) -> None:
        # A wrong message ends the session like a lost simulator.
        with suppress(ContentError, FramingError):
            while (message := self._stream.read()) is not None:
                self._client.forward(message)
        self._client.event("terminated")

    def close(self) -> None:
        """End the session; the simulator continues."""
        with suppress(OSError):  # the simulator has gone first
            self._own.shutdown(socket.SHUT_RDWR)
        self._own.close()


def _ask(port: int, token: str) -> Members:
    """Return the answer of a control socket to `debug`."""
    request = json.dumps({"do": "debug", "token": token}).encode() + b"\n"
    data = b""
    try:
        with socket.create_connection(("127.0.0.1", port), timeout=_ANSWER) as own:
            own.sendall(request)
            while not data.endswith(b"\n") and len(data) < _LONGEST_ANSWER:
                part = own.recv(4096)
                if not part:
                    break
                data += part
    except TimeoutError as fault:
        raise _cannot("the simulator does not answer: it may be paused already") from fault
    except (OSError, OverflowError) as fault:
        raise _cannot(f"no simulator at control port {port}: {fault}") from fault
    try:
        answer = json.loads(data)
    except ValueError as fault:
        raise _cannot(f"control port {port} is not that of a simulator") from fault
    if not isinstance(answer, dict) or not isinstance(answer.get("result"), dict):
        reason = answer.get("error") if isinstance(answer, dict) else None
        raise _cannot(f"the simulator rejects the session: {reason or 'no reason given'}")
    return members(answer, "result")


def _cannot(reason: str) -> DiagnosticError:
    help = "start `rapidgen sim`, and use `control` and `token` of its line `ready`"
    return refusal("RG940", None, f"cannot attach: {reason}", help)
