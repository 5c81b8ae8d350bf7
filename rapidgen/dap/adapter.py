"""Life of the debug adapter: messages in, a controller booted, run, booted again, ended.

The main thread executes requests: before a launch it waits for messages, afterwards it is the
thread of the controller's scheduler, to which the reading thread posts them. `initialize` is
answered before the controller's code is imported, which takes some tenths of a second.
"""

import threading
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack, redirect_stderr
from io import StringIO
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, TypeAlias

from rapidgen import _extras
from rapidgen._json import Members
from rapidgen._message_streams import MessageStream
from rapidgen.dap.attach import Relay
from rapidgen.dap.capabilities import CAPABILITIES
from rapidgen.dap.client import Client, RequestRefused, flag, members, text
from rapidgen.dap.launch import Launch, Loader, read_launch
from rapidgen.diagnostics import DiagnosticError, refusal, render
from rapidgen.wire.framing import ContentError, FramingError

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.dap.recorded import RecordedSession
    from rapidgen.dap.session import Session

Page: TypeAlias = "Callable[[ControllerRunner, Bootable], AbstractContextManager[str]]"
"""Serves the page of a simulator; yields its address."""


class Adapter:
    """The adapter for one client. `run` returns when the client is gone."""

    def __init__(
        self,
        stream: MessageStream,
        load: Loader,
        page: "Page | None" = None,
    ) -> None:
        self._stream = stream
        self._client = Client(stream)
        self._load = load
        self._page = page
        self._initialize: Members = {}
        """Arguments of the first request."""
        self._recorded: RecordedSession | None = None
        self._relay: Relay | None = None
        """The simulator to which the client has attached."""
        self._inbox: SimpleQueue[Members | None] = SimpleQueue()
        self._launch: Launch | None = None
        """The program that is to be booted, or runs."""
        self._request: Members = {}
        """The request that asked for it."""
        self._runner: ControllerRunner | None = None
        self._session: Session | None = None
        self._is_leaving = False
        """The client has disconnected."""
        self._boots_again = False
        self._is_configured = False
        self._is_driver = False

    def run(self) -> None:
        """Serve the client."""
        threading.Thread(target=self._read, name="dap client", daemon=True).start()
        while not self._is_leaving:
            self._take(self._inbox.get())
            while self._launch is not None and self._session is None and not self._is_leaving:
                self._debug(self._launch)
        if self._relay is not None:
            self._relay.close()
        if self._recorded is not None:
            self._recorded.close()

    # -- messages --------------------------------------------------------------------------------

    def _read(self) -> None:
        try:
            while True:
                try:
                    message = self._stream.read()
                except ContentError as error:
                    self._client.output(f"message ignored: {error}", "stderr")
                    continue
                if message is None:
                    break
                self._put(message)
        except FramingError as error:
            self._client.output(f"stream ended: {error}", "stderr")
        self._put(None)

    def _put(self, message: Members | None) -> None:
        self._inbox.put(message)
        runner = self._runner
        if runner is not None:
            runner.post(self._drain)

    def _drain(self) -> None:
        """Execute messages on the controller's thread, until one of them ends its run."""
        while not self._ends_run():
            try:
                self._take(self._inbox.get_nowait())
            except Empty:
                return

    def _ends_run(self) -> bool:
        return self._is_leaving or self._boots_again

    def _take(self, message: Members | None) -> None:
        if message is None:
            self._is_leaving = True
            return
        if self._relay is not None:
            self._relay.forward(message)
            return
        if message.get("type") != "request":
            return
        command, number = message.get("command"), message.get("seq")
        if not isinstance(command, str) or not isinstance(number, int):
            self._client.output("message ignored: a request has seq and command", "stderr")
            return
        try:
            self._perform(command, message, members(message, "arguments"))
        except RequestRefused as reason:
            self._client.refuse(message, str(reason))
        except DiagnosticError as fault:
            self._refuse_start(message, fault)

    def _refuse_start(self, request: Members, fault: DiagnosticError) -> None:
        first = fault.diagnostics[0]
        self._client.output(render(fault.diagnostics, colour=False), "stderr")
        code = int(first.code.removeprefix("RG"))
        more = len(fault.diagnostics) - 1
        reason = f"{first.code}: {first.message}" + (f" (and {more} more)" if more else "")
        self._client.refuse(request, reason, code=code, show=True)

    def _perform(self, command: str, request: Members, arguments: Members) -> None:
        match command:
            case "initialize":
                self._initialize = arguments
                self._client.initialise(arguments)
                self._client.respond(request, CAPABILITIES)
            case "launch":
                if self._launch is not None:
                    raise RequestRefused("a program has been launched already")
                # Read first: a wrong request leaves nothing behind.
                self._launch, self._request = read_launch(arguments), request
            case "attach":
                if self._launch is not None or self._recorded is not None:
                    raise RequestRefused("a program has been launched already")
                if "recording" in arguments:
                    self._open(request, text(arguments, "recording"))
                    return
                self._relay = Relay(self._client, self._initialize, arguments)
                self._relay.forward(request)
            case "configurationDone" if self._recorded is None:
                self._start(request)
            case "restart" if self._recorded is None:
                self._restart(request, members(arguments, "arguments"))
            case "disconnect" | "terminate":
                flag(arguments, "restart", default=False)
                self._client.respond(request, None)
                if command == "terminate":
                    self._client.event("terminated")
                self._is_leaving = command == "disconnect"
            case _:
                self._in_session(command, request, arguments)

    def _open(self, request: Members, path: str) -> None:
        """Begin a session on a recording; DiagnosticError."""
        from rapidgen.dap.recorded import CAPABILITIES as CHANGED
        from rapidgen.dap.recorded import RecordedSession

        try:
            from rapidgen.viewer.recording.reader import RecordingFile

            self._recorded = RecordedSession(RecordingFile(path), self._client)
        except (ModuleNotFoundError, OSError, ValueError) as fault:
            raise as_diagnostics(fault) from fault
        self._client.respond(request, None)
        self._client.event("capabilities", {"capabilities": CHANGED})
        self._client.event("initialized")

    def _in_session(self, command: str, request: Members, arguments: Members) -> None:
        if self._recorded is not None:
            self._client.respond(request, self._recorded.execute(command, arguments))
            self._recorded.report()
            return
        if self._session is None:
            raise RequestRefused(f"'{command}' needs a program that was launched")
        self._client.respond(request, self._session.execute(command, arguments))

    # -- program ---------------------------------------------------------------------------------

    def _start(self, request: Members) -> None:
        if self._session is None or self._launch is None:
            raise RequestRefused("nothing was launched")
        self._client.respond(request, None)
        if not self._is_configured:
            self._is_configured = True
            self._session.start(stop_on_entry=self._launch.stop_on_entry)

    def _restart(self, request: Members, arguments: Members) -> None:
        if self._session is None:
            raise RequestRefused("nothing was launched")
        if arguments:
            self._launch = read_launch(arguments)
        self._request, self._boots_again = request, True

    def _debug(self, launch: Launch) -> None:
        """Boot the program and let it run until the client leaves or restarts it."""
        from rapidgen.dap.session import Session

        request, again = self._request, self._boots_again
        self._boots_again = False
        with ExitStack() as stack:
            try:
                runner, target = self._boot(launch)
                stack.enter_context(runner)
                page = self._page if launch.page else None
                address = stack.enter_context(page(runner, target)) if page is not None else ""
            except (DiagnosticError, OSError, ModuleNotFoundError) as fault:
                self._launch = None
                self._refuse_start(request, as_diagnostics(fault))
                if again:
                    self._client.event("terminated")
                return
            session = self._session = Session(runner, self._client, ends=self._is_once(launch))
            self._runner = runner
            for note in runner.controller.diagnostics:
                self._client.output(render((note,), colour=False), "important")
            if address:
                self._client.event("rapidgen/page", {"url": address})
                self._client.output(f"page: {address}", "console")
            self._client.respond(request, None)
            # Breakpoints follow; a restarted client sends them again.
            self._is_configured = False
            self._client.event("initialized")
            self._drain()
            runner.run(self._ends_run, self._wait)
            self._runner = self._session = None
            session.close()

    def _wait(self) -> None:
        """Wait for a message where the virtual clock cannot go on."""
        self._take(self._inbox.get())

    def _boot(self, launch: Launch) -> "tuple[ControllerRunner, Bootable]":
        """Read and boot the program; DiagnosticError."""
        from rapidgen.controller.runner import ControllerRunner
        from rapidgen.machine.operator import read_answers

        notes = StringIO()
        try:
            with redirect_stderr(notes):
                target = self._load(launch)
        finally:
            if notes.getvalue():
                self._client.output(notes.getvalue(), "important")
        self._is_driver = target.driver
        runner = ControllerRunner.boot(
            target,
            clock="real" if launch.speed else "virtual",
            speed=launch.speed or 1.0,
            cycle="once" if self._is_once(launch) else "forever",
            answers=read_answers(launch.answers) if launch.answers is not None else None,
            autostart=False,
        )
        return runner, target

    def _is_once(self, launch: Launch) -> bool:
        return launch.cycle == "once" or (not launch.cycle and not self._is_driver)


def as_diagnostics(fault: Exception) -> DiagnosticError:
    """Return a fault of a launch as diagnostics: also of the system, and of a missing extra."""
    if isinstance(fault, DiagnosticError):
        return fault
    if isinstance(fault, OSError):
        place = fault.filename or "the program"
        return refusal("RG942", None, f"cannot read {place}: {fault.strerror or fault}")
    if isinstance(fault, ValueError):  # a zero byte in a path
        return refusal("RG942", None, f"not a path: {fault}")
    lacking = _extras.missing(fault) if isinstance(fault, ModuleNotFoundError) else None
    if lacking is None:
        raise fault  # a defect of rapidgen
    return DiagnosticError(lacking)
