"""The server: life cycle, order of messages, findings in the background.

One thread reads messages and puts them into a queue, another one does everything else. Edits are
applied in the order in which they arrive; an answer is of the text that the client had when it
asked. While no message waits, the server loads modules and computes findings, one module at a time,
so that a message never waits longer than for one module.

The reading thread notes cancellations at once: a request that is cancelled before its turn is not
executed. So is one about the whole text of a document of which a newer edit already waits; the
client asks again.
"""

import logging
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Final

from rapidgen import __version__
from rapidgen._json import Json, Members, members, text
from rapidgen._message_streams import MessageStream
from rapidgen.diagnostics import Diagnostic
from rapidgen.editor.completion import prepare
from rapidgen.editor.documents import is_file, path_of, real_path, uri_of
from rapidgen.editor.workspace import Workspace
from rapidgen.lsp import capabilities
from rapidgen.lsp.conversion import (
    Client,
    Converter,
    client_of,
    document_path,
    settings_of,
)
from rapidgen.lsp.methods import NOTIFICATIONS, REQUESTS, RequestFailed, Session
from rapidgen.wire.framing import ContentError, FramingError

log = logging.getLogger("rapidgen.lsp")
_DELAY: Final = 0.08
"""Seconds after an edit before findings are computed: the time between two keys is longer only
when the user stops typing."""
_MANY: Final = 60
"""Modules of a program from which on the client gets the progress of loading."""
_PARSE, _INVALID, _UNKNOWN, _PARAMS, _INTERNAL = -32700, -32600, -32601, -32602, -32603
_NOT_INITIALIZED, _CANCELLED, _MODIFIED, _FAILED = -32002, -32800, -32801, -32803
_END: Final = object()
_OF_WHOLE_TEXT: Final = frozenset(
    (
        "textDocument/semanticTokens/full",
        "textDocument/semanticTokens/full/delta",
        "textDocument/semanticTokens/range",
        "textDocument/inlayHint",
        "textDocument/codeLens",
        "textDocument/documentSymbol",
        "textDocument/foldingRange",
        "textDocument/documentLink",
        "textDocument/documentHighlight",
    )
)
"""Requests whose answer is useless after the next edit."""


@dataclass(slots=True, eq=False)
class Queue:
    """Messages that wait, filled by the reading thread."""

    waiting: deque[object] = field(default_factory=deque)
    cancelled: set[int | str] = field(default_factory=set)
    _condition: threading.Condition = field(default_factory=threading.Condition)

    def put(self, message: object) -> None:
        """Add a message."""
        with self._condition:
            self.waiting.append(message)
            self._condition.notify()

    def get(self, timeout: float | None) -> object | None:
        """Return the next message, or None after `timeout` seconds (None: wait)."""
        with self._condition:
            if not self.waiting and timeout != 0:
                self._condition.wait_for(lambda: bool(self.waiting), timeout)
            return self.waiting.popleft() if self.waiting else None

    def is_superseded(self, path: str) -> bool:
        """Return True if an edit of a document waits."""
        with self._condition:
            return any(
                isinstance(message, dict)
                and message.get("method") == "textDocument/didChange"
                and _path_in(message) == path
                for message in self.waiting
            )


def _path_in(message: Members) -> str:
    try:
        return document_path(members(message["params"]))
    except (KeyError, TypeError):
        return ""


class Server:
    """A language server for one client."""

    def __init__(self, stream: MessageStream) -> None:
        self.stream = stream
        self.queue = Queue()
        self.session = Session(Workspace(), Client())
        self.state = "new"
        """`new`, `running`, `shut down`."""
        self._published: dict[str, tuple[int | None, tuple[Diagnostic, ...]]] = {}
        """By path: what the client shows of findings that we sent."""
        self._work: Iterator[tuple[str, list[Diagnostic]]] | None = None
        self._due = 0.0
        self._is_prepared = False
        self._answers: dict[int, Callable[[Json], None]] = {}
        self._asked = 0
        self._progress = ""

    # -- loop ----------------------------------------------------------------------------

    def run(self) -> int:
        """Serve until the client ends; return the exit code."""
        reader = threading.Thread(target=self._read, name="rapidgen-lsp-reader", daemon=True)
        reader.start()
        while True:
            message = self.queue.get(self._wait())
            if message is _END:
                log.info("the client has ended the stream")
                return 0 if self.state == "shut down" else 1
            if isinstance(message, ContentError):
                self._send_error(None, _PARSE, str(message))
            elif isinstance(message, dict):
                if message.get("method") == "exit":
                    return 0 if self.state == "shut down" else 1
                self._handle(message)
            elif message is None:
                self._step()

    def _read(self) -> None:
        while True:
            try:
                message = self.stream.read()
            except ContentError as fault:
                self.queue.put(fault)
                continue
            except FramingError as fault:
                log.error("the stream is not in the protocol: %s", fault)
                message = None
            if message is None:
                self.queue.put(_END)
                return
            if message.get("method") == "$/cancelRequest":
                params = message.get("params")
                identity = params.get("id") if isinstance(params, dict) else None
                if isinstance(identity, int | str):
                    self.queue.cancelled.add(identity)
                continue
            self.queue.put(message)

    def _wait(self) -> float | None:
        """Return how long to wait for a message before the next piece of work."""
        if self.state != "running" or (self._work is None and self.session.workspace.is_idle()):
            return None
        return max(0.0, self._due - time.monotonic())

    def _step(self) -> None:
        """Do one piece of work: load a module, or compute the findings of one."""
        workspace = self.session.workspace
        loaded = workspace.load_step()
        if loaded is not None:
            self._report_loading(*loaded)
            return
        if self._work is None:
            self._work = workspace.work()
        found = next(self._work, None)
        if found is not None:
            self._publish(*found)
            return
        self._work = None
        if not self._is_prepared:
            self._is_prepared = True
            prepare()

    # -- messages ------------------------------------------------------------------------

    def _handle(self, message: Members) -> None:
        method, identity = message.get("method"), message.get("id")
        if method is None:
            answer = self._answers.pop(identity, None) if isinstance(identity, int) else None
            if answer is not None:
                answer(message.get("result"))
            return
        if not isinstance(method, str):
            self._send_error(None, _INVALID, "the method of a message is a text")
            return
        params = message.get("params")
        params = params if isinstance(params, dict) else {}
        if isinstance(identity, int | str):
            self._request(identity, method, params)
        else:
            self._notification(method, params)

    def _request(self, identity: int | str, method: str, params: Members) -> None:
        if identity in self.queue.cancelled:
            self.queue.cancelled.discard(identity)
            self._send_error(identity, _CANCELLED, "cancelled")
            return
        if method == "initialize" and self.state == "new":
            self._answer(identity, method, self._initialize, params)
        elif self.state == "new":
            self._send_error(identity, _NOT_INITIALIZED, "`initialize` comes first")
        elif self.state == "shut down" or method == "initialize":
            self._send_error(identity, _INVALID, f"{method} is not possible now")
        elif method == "shutdown":
            self.state = "shut down"
            self.stream.write({"jsonrpc": "2.0", "id": identity, "result": None})
        elif method not in REQUESTS:
            self._send_error(identity, _UNKNOWN, f"no such method: {method}")
        elif method in _OF_WHOLE_TEXT and self._is_superseded(params):
            self._send_error(identity, _MODIFIED, "the text has changed")
        else:
            handler = REQUESTS[method]
            self._answer(identity, method, lambda p: handler(self.session, p), params)

    def _is_superseded(self, params: Members) -> bool:
        path = _path_in({"params": params})
        return bool(path) and self.queue.is_superseded(path)

    def _answer(
        self, identity: int | str, method: str, handler: Callable[[Members], Json], params: Members
    ) -> None:
        start = time.monotonic()
        try:
            result = handler(params)
        except RequestFailed as fault:
            self._send_error(identity, _FAILED, str(fault))
        except (KeyError, TypeError) as fault:
            log.warning("%s: invalid parameters", method, exc_info=True)
            self._send_error(identity, _PARAMS, f"invalid parameters: {fault}")
        except Exception as fault:
            log.exception("%s failed", method)
            self._send_error(identity, _INTERNAL, f"{type(fault).__name__}: {fault}")
        else:
            self.stream.write({"jsonrpc": "2.0", "id": identity, "result": result})
        for message in self.session.messages:
            self._notify("window/showMessage", {"type": 2, "message": message})
        self.session.messages.clear()
        log.debug("%s: %.1f ms", method, 1e3 * (time.monotonic() - start))

    def _notification(self, method: str, params: Members) -> None:
        if self.state != "running":
            return
        if method == "initialized":
            self._initialized()
            return
        handler = NOTIFICATIONS.get(method)
        if handler is None:
            return
        closed = path_of(_uri_in(params)) if method == "textDocument/didClose" else ""
        try:
            handler(self.session, params)
        except (KeyError, TypeError):
            log.warning("%s: invalid parameters", method, exc_info=True)
            return
        can_pull = self.session.client.can("workspace", "configuration")
        if method == "workspace/didChangeConfiguration" and can_pull:
            self.pull_configuration()
        self._work = None
        self._due = time.monotonic() + (_DELAY if method == "textDocument/didChange" else 0)
        if method == "textDocument/didOpen" and self.session.client.pulls:
            self._clear(path_of(_uri_in(params)))
        elif closed:
            self._forget(closed)

    # -- life cycle ----------------------------------------------------------------------

    def _initialize(self, params: Members) -> Json:
        given = params.get("capabilities")
        client = client_of(given if isinstance(given, dict) else {})
        listed = params.get("workspaceFolders")
        folders = [
            path_of(text(members(folder)["uri"]))
            for folder in (listed if isinstance(listed, list) else [])
        ]
        root = params.get("rootUri")
        if not folders and isinstance(root, str):
            folders = [path_of(root)]
        workspace = self.session.workspace
        workspace.folders = tuple(map(real_path, filter(is_file, folders)))
        workspace.settings = settings_of(params.get("initializationOptions"), workspace.settings)
        self.session.client = client
        self.state = "running"
        log.info("rapidgen %s, folders %s, units %s", __version__, folders, client.units)
        return {
            "capabilities": capabilities.of_server(client),
            "serverInfo": {"name": "rapidgen", "version": __version__},
        }

    def _initialized(self) -> None:
        client = self.session.client
        if client.can("workspace", "didChangeWatchedFiles", "dynamicRegistration"):
            self._ask("client/registerCapability", capabilities.watchers(), lambda _: None)
        if client.can("workspace", "configuration"):
            self.pull_configuration()

    def pull_configuration(self) -> None:
        """Ask the client for its settings."""

        def use(result: Json) -> None:
            if isinstance(result, list) and result:
                self.session.use_settings(result[0])
                self._work = None

        self._ask("workspace/configuration", {"items": [{"section": "rapidgen"}]}, use)

    # -- to the client -------------------------------------------------------------------

    def _ask(self, method: str, params: Json, answer: Callable[[Json], None]) -> None:
        self._asked += 1
        self._answers[self._asked] = answer
        message: Members = {
            "jsonrpc": "2.0", "id": self._asked, "method": method, "params": params,
        }  # fmt: skip
        self.stream.write(message)

    def _notify(self, method: str, params: Json) -> None:
        self.stream.write({"jsonrpc": "2.0", "method": method, "params": params})

    def _send_error(self, identity: int | str | None, code: int, message: str) -> None:
        error: Members = {"code": code, "message": message}
        self.stream.write({"jsonrpc": "2.0", "id": identity, "error": error})

    def _publish(self, path: str, findings: list[Diagnostic]) -> None:
        """Send the findings of a file if they have changed, or make the client ask for them."""
        present = tuple(findings)
        known, before = self._published.get(path, (None, ()))
        document = self.session.workspace.documents.get(real_path(path))
        version = document.version if document is not None else None
        if version == known and present == before:
            return
        self._published[path] = (version, present)
        client = self.session.client
        if document is not None and client.pulls:
            # A client asks after each edit of its own; this is about edits of other documents.
            if present != before and client.can("workspace", "diagnostics", "refreshSupport"):
                self._ask("workspace/diagnostic/refresh", None, lambda _: None)
            return
        self._send_findings(path, findings, version)

    def _send_findings(
        self, path: str, findings: list[Diagnostic], version: int | None = None
    ) -> None:
        converter = Converter(self.session.workspace, self.session.client.units)
        params: Members = {
            "uri": uri_of(path),
            "diagnostics": converter.diagnostics(findings, self.session.client),
        }
        if version is not None:
            params["version"] = version
        self._notify("textDocument/publishDiagnostics", params)

    def _clear(self, path: str) -> None:
        """Take back what was sent about a file that the client has opened and asks about now."""
        if self._published.pop(path, (None, ()))[1]:
            self._send_findings(path, [])

    def _forget(self, closed: str) -> None:
        """Take back findings of files that belong to no program any more."""
        workspace = self.session.workspace
        known = {real for program in workspace.programs for real in program.program.paths}
        for path in [closed, *self._published]:
            if real_path(path) not in known and path in self._published:
                del self._published[path]
                self._send_findings(path, [])

    def _report_loading(self, root: str, done: int, total: int) -> None:
        """Tell the client how many modules of a large program are loaded."""
        if total < _MANY or not self.session.client.can("window", "workDoneProgress"):
            return
        if not self._progress:
            self._progress = f"rapidgen-{self._asked + 1}"
            token = self._progress
            self._ask("window/workDoneProgress/create", {"token": token}, lambda _: None)
            self._report({"kind": "begin", "title": "Loading RAPID modules", "percentage": 0})
        if done == total:
            self._report({"kind": "end", "message": f"{total} modules"})
            self._progress = ""
        elif done % 10 == 0:
            self._report(
                {
                    "kind": "report",
                    "message": f"{done} of {total} modules",
                    "percentage": 100 * done // total,
                }
            )

    def _report(self, value: Members) -> None:
        self._notify("$/progress", {"token": self._progress, "value": value})


def _uri_in(params: Members) -> str:
    document = params.get("textDocument")
    uri = document.get("uri") if isinstance(document, dict) else None
    return uri if isinstance(uri, str) else ""
