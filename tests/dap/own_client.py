"""A small client of the debug adapter, which runs in a thread of the test."""

import socket
import threading

from rapidgen._message_streams import MessageStream
from rapidgen.cli.dap import _load
from rapidgen.dap.adapter import Adapter


class Refused(Exception):
    """A response without success."""


class OwnClient:
    """Sends requests and keeps events; every wait ends after 10 s."""

    def __init__(self, page=None):
        self._own, other = socket.socketpair()
        self._own.settimeout(10)
        self._stream = MessageStream(self._receive, self._own.sendall)
        self.events = []
        self._seq = 0

        def serve():
            with other:
                Adapter(MessageStream(other.recv, other.sendall), _load, page).run()

        self._thread = threading.Thread(target=serve)
        self._thread.start()

    def _receive(self, size):
        # TimeoutError is an OSError, which the stream takes for the end.
        try:
            return self._own.recv(size)
        except TimeoutError as error:
            raise AssertionError(f"no message in 10 s; events: {self.events}") from error

    def send(self, command, **arguments):
        """Send a request and return its number."""
        self._seq += 1
        self._stream.write(
            {"seq": self._seq, "type": "request", "command": command, "arguments": arguments}
        )
        return self._seq

    def response(self, number):
        """Return the body of a response."""
        while True:
            message = self._read()
            if message["type"] == "response" and message["request_seq"] == number:
                if not message["success"]:
                    raise Refused(message["message"])
                return message.get("body", {})

    def ask(self, command, **arguments):
        """Send a request and return the body of its response."""
        return self.response(self.send(command, **arguments))

    def event(self, name, **fits):
        """Return the next event of a name whose body has the given members."""
        while True:
            for i, (kind, body) in enumerate(self.events):
                if kind == name and all(body.get(key) == value for key, value in fits.items()):
                    del self.events[: i + 1]
                    return body
            self._read()

    def _read(self):
        message = self._stream.read()
        assert message is not None, f"the adapter has gone; events: {self.events}"
        if message["type"] == "event":
            self.events.append((message["event"], message.get("body", {})))
        return message

    # -- usual sequences -------------------------------------------------------------------------

    def begin(self, path, lines=(), *, filters=("unhandled",), configured=True, **launch):
        """Launch on the virtual clock, set breakpoints, and start."""
        self.ask("initialize", adapterID="rapidgen")
        self.ask("launch", program=str(path), speed=0, **launch)
        self.event("initialized")
        self.ask("setExceptionBreakpoints", filters=list(filters))
        placed = self.set_lines(path, *lines)
        if configured:
            self.ask("configurationDone")
        return placed

    def set_lines(self, path, *lines):
        """Set breakpoints; a line is a number or a dict."""
        breakpoints = [{"line": one} if isinstance(one, int) else one for one in lines]
        asked = {"source": {"path": str(path)}, "breakpoints": breakpoints}
        return self.ask("setBreakpoints", **asked)["breakpoints"]

    def stopped(self):
        """Wait for the next pause; return its reason and the innermost frame."""
        body = self.event("stopped")
        return body["reason"], self.frames(body["threadId"])[0]

    def frames(self, thread=1):
        """Return the frames of a task, innermost first."""
        return self.ask("stackTrace", threadId=thread)["stackFrames"]

    def value(self, expression, frame=None, context="watch"):
        """Evaluate an expression."""
        at = {} if frame is None else {"frameId": frame["id"]}
        return self.ask("evaluate", expression=expression, context=context, **at)["result"]

    def scopes(self, frame):
        """Return the numbers of the scopes by name."""
        scopes = self.ask("scopes", frameId=frame["id"])["scopes"]
        return {scope["name"]: scope["variablesReference"] for scope in scopes}

    def variables(self, number, **page):
        """Return variables by name."""
        body = self.ask("variables", variablesReference=number, **page)
        return {one["name"]: one for one in body["variables"]}

    def close(self):
        """Disconnect and wait for the end of the adapter."""
        try:
            self._stream.write({"seq": 0, "type": "request", "command": "disconnect"})
        finally:
            self._own.shutdown(socket.SHUT_WR)
            self._thread.join(10)
            self._own.close()
        assert not self._thread.is_alive()
