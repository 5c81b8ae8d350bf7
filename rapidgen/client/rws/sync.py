"""`Controller`: Robot Web Services on the caller's thread."""

import os
import socket
import ssl
import threading
import time
import weakref
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from typing import TypeVar

import httpx2
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.sync.client import ClientConnection
from websockets.sync.client import connect as connect_socket

from rapidgen._compat import Self
from rapidgen.client.errors import ConnectionLost, RobotTimeout
from rapidgen.client.rws import flows
from rapidgen.client.rws.api import RESTART_TIMEOUT, ControllerApi
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import (
    DropConnections,
    Effect,
    Exchange,
    FetchCertificate,
    Flow,
    LogIn,
    Pause,
    Response,
    UseEndpoint,
    resume,
)
from rapidgen.client.rws.errors import Busy
from rapidgen.client.rws.flows.cfg import Mode
from rapidgen.client.rws.model import (
    BuildError,
    CfgInstance,
    Dialog,
    FileInfo,
    Identity,
    JointTarget,
    LogEvent,
    MastershipHolder,
    MechanicalUnit,
    Panel,
    ProgramPointer,
    ProgramState,
    QueueMessage,
    ResourceEvent,
    RobTarget,
    SignalState,
    SymbolInfo,
    TaskModule,
    TaskState,
)
from rapidgen.client.rws.topics import Topic
from rapidgen.client.rws.transport import (
    LOGOUT,
    LOGOUT_HEADERS,
    LOGOUT_TIMEOUT,
    RwsRunner,
    Session,
    auth_of,
    forked,
    no_verification,
    not_reached,
    response_of,
)
from rapidgen.client.rws.values import RapidValue
from rapidgen.client.unclosed import warn_unclosed

T = TypeVar("T")


@dataclass(slots=True, eq=False)
class _Session(Session[httpx2.Client]):
    """See Session."""

    def close_dropped(self) -> None:
        """Log out without waiting, with a warning: a session keeps its mastership for 5 min."""
        client, self.client = self.client, None
        if client is None:
            return
        if threading.main_thread().is_alive():
            name = f"rapidgen logout {self.where}"
            threading.Thread(target=self._log_out, args=(client,), name=name, daemon=True).start()
        else:
            # No thread starts while the interpreter ends.
            self._log_out(client)
        warn_unclosed(self.where)

    def _log_out(self, client: httpx2.Client) -> None:
        url = self.base + LOGOUT
        with suppress(httpx2.HTTPError):
            client.get(url, headers=LOGOUT_HEADERS, auth=self.auth, timeout=LOGOUT_TIMEOUT)
        client.close()


class RwsSyncRunner(RwsRunner[httpx2.Client]):
    """Runner of flows on the caller's thread, one request at a time."""

    _session: _Session

    def __init__(self, core: RwsCore, timeout: float) -> None:
        super().__init__(core, timeout, _Session(str(core.address)))
        self._lock = threading.RLock()
        weakref.finalize(self, self._session.close_dropped)

    def forked(self) -> None:
        """Drop the session in a forked process; it stays the parent's."""
        # A thread that the child does not have may hold the old locks.
        self._lock = threading.RLock()
        super().forked()

    def run(self, flow: Flow[T]) -> T:
        """Return the outcome of a flow.

        An exception of an effect is thrown into it.
        """
        with self._lock:
            try:
                return self._carry_out(flow)
            finally:
                if not self._core.connected:
                    self.close()

    def _carry_out(self, flow: Flow[T]) -> T:
        outcome: Response | None = None
        failure: BaseException | None = None
        while True:
            try:
                effect = resume(flow, outcome, failure)
            except StopIteration as end:
                value: T = end.value
                return value
            outcome, failure = Response(0), None
            try:
                outcome = self._perform(effect)
            except BaseException as raised:  # noqa: BLE001 - the flow cleans up and raises it
                failure = raised

    def _perform(self, effect: Effect) -> Response:
        match effect:
            case Exchange():
                return self._exchange(effect)
            case Pause():
                time.sleep(effect.seconds)
            case FetchCertificate():
                return self._look(effect.port)
            case UseEndpoint():
                self.close()
                self._use(effect, httpx2.Client)
            case LogIn():
                self._session.auth = auth_of(effect, self._core)
            case DropConnections():
                self._drop_cookies()
        return Response(0)

    def _exchange(self, effect: Exchange) -> Response:
        client = self._session.client
        assert client is not None
        time.sleep(self._limiter.reserve(time.monotonic()))
        for left in (1, 0):
            try:
                answer = client.request(**self._request(effect))
            except httpx2.HTTPError as error:
                if left and effect.repeat and not isinstance(error, httpx2.TimeoutException):
                    continue
                raise not_reached(self._core, error, self._timeout) from error
            return response_of(answer)
        raise AssertionError

    def _look(self, port: int) -> Response:
        try:
            with socket.create_connection((self._core.address.host, port), self._timeout) as raw:
                try:
                    with no_verification().wrap_socket(raw) as tls:
                        return Response(200, body=tls.getpeercert(True) or b"")
                except (ssl.SSLError, ConnectionResetError):
                    return Response(0)
        except OSError as error:
            raise not_reached(self._core, error, self._timeout) from error

    def open_socket(self, path: str, stack: ExitStack) -> ClientConnection:
        """Open a websocket of this session, closed with the stack.

        Pings are off: RWS 2.0 disconnects a client that sends.
        """
        address, options = self._websocket(path, threads=True)
        try:
            return stack.enter_context(
                connect_socket(address, **options, open_timeout=self._timeout)
            )
        except (OSError, WebSocketException) as error:
            raise not_reached(self._core, error, self._timeout) from error

    def close(self) -> None:
        """Close all connections."""
        if self._session.client is not None:
            self._session.client.close()
            self._session.client = None


class Subscription:
    """Events of topics, the current values first.

    Survives a restart of the controller. `with controller.subscribe(topics.execution()) as events:
    for event in events: ...`
    """

    def __init__(self, runner: RwsSyncRunner, core: RwsCore, chosen: tuple[Topic, ...]) -> None:
        self._runner = runner
        self._core = core
        self._topics = chosen
        self._waiting: deque[ResourceEvent] = deque()
        self._socket: ClientConnection | None = None
        self._group = ""
        self._stack = ExitStack()
        self._process = os.getpid()
        self._sockets: list[ClientConnection] = []
        """The open websocket, for the finalizer; its thread holds it, too."""
        weakref.finalize(self, _close_dropped, str(core.address), self._sockets)
        self._open(flows.subscriptions.subscribe(core, chosen))

    def _open(self, flow: Flow[flows.subscriptions.SubscriptionGroup]) -> None:
        opened = self._runner.run(flow)
        self._group = opened.group
        self._waiting.extend(opened.events)
        self._stack.close()
        self._socket = self._runner.open_socket(opened.path, self._stack)
        self._sockets[:] = [self._socket]

    def next(self, timeout: float | None = None) -> ResourceEvent:
        """Return the next event. Raises RobotTimeout (RG602)."""
        if os.getpid() != self._process:
            raise forked()
        until = None if timeout is None else time.monotonic() + timeout
        while not self._waiting:
            left = None if until is None else until - time.monotonic()
            assert self._socket is not None
            try:
                message = self._socket.recv(left)
            except TimeoutError as error:
                raise RobotTimeout.because("RG602", f"no event within {timeout:g} s") from error
            except (ConnectionClosed, OSError):
                self._again()
                continue
            data = message.encode() if isinstance(message, str) else message
            self._waiting.extend(
                self._runner.run(flows.subscriptions.events_of(self._core, self._topics, data))
            )
        return self._waiting.popleft()

    def _again(self) -> None:
        """Reopen the websocket until the restarted controller keeps it open."""
        until = time.monotonic() + RESTART_TIMEOUT
        while True:
            try:
                return self._open(
                    flows.subscriptions.again(self._core, self._topics, RESTART_TIMEOUT)
                )
            except (ConnectionLost, Busy):
                if time.monotonic() >= until:
                    raise
                self._runner.run(flows.subscriptions.unsubscribe(self._core, self._group))

    def close(self) -> None:
        """End the subscription."""
        self._sockets.clear()
        if os.getpid() != self._process:
            # The websocket is the parent's.
            self._socket = None
        if self._socket is not None:
            self._runner.run(flows.subscriptions.unsubscribe(self._core, self._group))
            self._stack.close()
            self._socket = None

    def __iter__(self) -> Iterator[ResourceEvent]:
        while self._socket is not None:
            yield self.next()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _close_dropped(where: str, sockets: list[ClientConnection]) -> None:
    for each in sockets:
        # The thread of the websocket ends; a closing handshake would wait for the controller.
        with suppress(OSError):
            each.socket.shutdown(socket.SHUT_RDWR)
        warn_unclosed(where)


class Controller(ControllerApi[RwsSyncRunner]):
    """A controller over Robot Web Services.

    `address` is `rws://HOST[:PORT]`, `rwss://HOST[:PORT]` or a bare host; the client detects the
    generation. It connects at the first call; `close()` or the end of a `with` block releases
    mastership and logs out. An unknown certificate is shown to `confirm(where, fingerprint)`, or
    must be `fingerprint`. All methods may be called from any thread.
    """

    _runner_type = RwsSyncRunner

    def _run(self, flow: Flow[T]) -> T:
        """Run a flow on a connected controller."""
        return self._runner.run(flows.connect.connected(self._core, flow))

    def connect(self) -> Self:
        """Connect and log in.

        Raises ConnectionFailed, LoginFailed (RG651, RG652), NotRws (RG653).
        """
        self._runner.run(flows.connect.connect(self._core))
        return self

    def close(self) -> None:
        """Release mastership, log out, and close."""
        self._runner.run(flows.connect.close(self._core))
        self._runner.close()

    @contextmanager
    def mastership(self, domain: str = "rapid", *, wait: float = 0.0) -> Iterator[Self]:
        """Hold mastership of `rapid`, `cfg` or `motion` for a block.

        Raises Held (RG654).
        """
        self.take_mastership(domain, wait=wait)
        try:
            yield self
        finally:
            self._runner.run(flows.mastership.give(self._core, domain))

    def subscribe(self, *topics: Topic) -> Subscription:
        """Subscribe to topics: an iterator of events.

        Topics are made by `rapidgen.client.rws.topics`. At most 64 signals and persistents; a
        second subscription is the last one of a session.
        """
        return Subscription(self._runner, self._core, topics)

    def __enter__(self) -> Self:
        return self.connect()

    def __exit__(self, *_: object) -> None:
        self.close()

    def identity(self) -> Identity:
        """Return the identity of the controller; one request."""
        return self._run(flows.panel.identity(self._core))

    def panel(self) -> Panel:
        """Motors, mode and speed: three requests."""
        return self._run(flows.panel.panel(self._core))

    def execution(self) -> ProgramState:
        """Return the state of the program's execution."""
        return self._run(flows.panel.execution(self._core))

    def motors(self, on: bool) -> None:
        """Switch motors on or off; return when they are.

        Raises RwsError (RG650), NotConfirmed (RG655): accepted without effect.
        """
        self._run(flows.panel.motors(self._core, on))

    def set_speed(self, percent: int) -> None:
        """Speed of all robots in percent, 0 to 100, in automatic mode; read back."""
        self._run(flows.panel.set_speed(self._core, percent))

    def pp_to_main(self) -> None:
        """Set program pointers of all tasks to main; the program must be stopped."""
        self._run(flows.panel.pp_to_main(self._core))

    def start(self, *, cycle: str = "asis") -> None:
        """Start the program of all selected tasks; return when it runs.

        `cycle`: once, forever, asis. THE ROBOT MAY MOVE. Motors have to be on. Raises NotReady
        (RG610): this session holds mastership, which prevents a start. NotConfirmed (RG655):
        accepted, and the program does not run.
        """
        self._run(flows.panel.start(self._core, cycle=cycle))

    def stop(self, *, everything: bool = False) -> None:
        """Stop the program; return when it has stopped.

        `everything`: also stop background tasks. Not a safety function.
        """
        self._run(flows.panel.stop(self._core, everything=everything))

    def take_mastership(self, domain: str = "rapid", *, wait: float = 0.0) -> None:
        """Take mastership of `rapid`, `cfg` or `motion`.

        Waits s while another client holds it. Each take needs a release. Mastership is never taken
        by force. Raises Held (RG654) with its holder.
        """
        self._run(flows.mastership.take(self._core, domain, wait=wait))

    def give_mastership(self, domain: str = "rapid") -> None:
        """Release mastership; harmless if it is not held."""
        self._run(flows.mastership.give(self._core, domain))

    def holder(self, domain: str = "rapid") -> MastershipHolder | None:
        """Return the holder of a domain's mastership; None if there is none."""
        return self._run(flows.mastership.holder(self._core, domain))

    def grants(self) -> frozenset[str]:
        """UAS names of this user's grants; empty if the controller reports none."""
        return self._run(flows.users.grants(self._core))

    def ask_rmmp(self, privilege: str = "modify", *, wait: float = 10.0) -> None:
        """Request remote writing (`modify`) or running (`exec`) in manual mode.

        Returns when the pendant's user grants it, and at once in automatic mode. It lasts until
        `cancel_rmmp`, the end of the session or another mode. Raises NotReady (RG661): it was
        denied, or not answered within s. NotSupported (RG659): RobotWare 8 has none that works.
        """
        self._run(flows.users.ask_rmmp(self._core, privilege, wait=wait))

    def cancel_rmmp(self) -> None:
        """Release remote writing in manual mode; harmless if there is none."""
        self._run(flows.users.cancel_rmmp(self._core))

    def tasks(self) -> tuple[TaskState, ...]:
        """All tasks: one request."""
        return self._run(flows.rapid.tasks(self._core))

    def select_task(self, task: str, selected: bool) -> None:
        """Select whether a NORMAL task starts with the program; read it back.

        This is the task selection panel. The program must be stopped. Raises NotConfirmed (RG655).
        """
        self._run(flows.rapid.select_task(self._core, task, selected))

    def modules(self, task: str) -> tuple[TaskModule, ...]:
        """Modules of a task."""
        return self._run(flows.rapid.modules(self._core, task))

    def module_text(self, task: str, module: str) -> str:
        """Source of a module, with initial values as they were written."""
        return self._run(flows.rapid.module_text(self._core, task, module))

    def load_module(self, task: str, path: str, *, replace: bool = False) -> None:
        """Load a module file (`HOME/folder/a.mod`) into a task.

        RAPID must be stopped in all tasks. `replace`: instead of a module of the same name.
        `build_errors` reports its errors, not this method.
        """
        self._run(flows.rapid.load_module(self._core, task, path, replace=replace))

    def unload_module(self, task: str, module: str) -> None:
        """Unload a module of a task. RAPID must be stopped in all tasks."""
        self._run(flows.rapid.unload_module(self._core, task, module))

    def save_module(self, task: str, module: str, name: str, volume: str = "TEMP") -> str:
        """Save a module with its current persistents; return its path.

        The path is on a volume.
        """
        return self._run(flows.rapid.save_module(self._core, task, module, name, volume))

    def build_errors(self, task: str) -> tuple[BuildError, ...]:
        """Return the build errors of a task's program."""
        return self._run(flows.rapid.build_errors(self._core, task))

    def pointer(self, task: str) -> ProgramPointer:
        """Return the program pointer of a task."""
        return self._run(flows.rapid.pointer(self._core, task))

    def set_pointer(self, task: str, module: str, routine: str) -> None:
        """Set one task's program pointer to a routine.

        Pointers of other tasks stay. The task must be stopped.
        """
        self._run(flows.rapid.set_pointer(self._core, task, module, routine))

    def symbol(self, path: str) -> RapidValue:
        """Return a datum as a Python value: bool, str or number.

        Records and arrays are tuples.
        """
        return self._run(flows.rapid.symbol(self._core, path))

    def symbol_text(self, path: str) -> str:
        """Return a datum as a RAPID literal; one request.

        Its path is `TASK/MODULE/NAME` (or `TASK/NAME`).
        """
        return self._run(flows.rapid.symbol_text(self._core, path))

    def set_symbol(self, path: str, value: RapidValue) -> None:
        """Set a datum and read it back.

        Raises NotConfirmed (RG655): it has another value.
        """
        self._run(flows.rapid.set_symbol(self._core, path, value))

    def symbols(
        self, task: str, *, module: str = "", kind: str = "any", pattern: str = ""
    ) -> tuple[SymbolInfo, ...]:
        """Return data of a task.

        `kind` is per, var, con or any; `pattern` a regular expression of the name.
        """
        return self._run(
            flows.rapid.symbols(self._core, task, module=module, kind=kind, pattern=pattern)
        )

    def mechanical_units(self) -> tuple[str, ...]:
        """Names of the mechanical units."""
        return self._run(flows.equipment.mechanical_units(self._core))

    def mechanical_unit(self, unit: str = "ROB_1") -> MechanicalUnit:
        """Return a robot's task, and the tool and load chosen for it; one request.

        They are the pendant's choice: a move instruction of a program can name others.
        """
        return self._run(flows.equipment.mechanical_unit(self._core, unit))

    def joint_target(self, unit: str = "ROB_1") -> JointTarget:
        """Return the axis positions of a unit, deg and mm; one request.

        9E9: the unit has no such axis.
        """
        return self._run(flows.equipment.joint_target(self._core, unit))

    def rob_target(
        self, unit: str = "ROB_1", *, tool: str = "tool0", wobj: str = "wobj0"
    ) -> RobTarget:
        """Return the TCP of a tool in a work object, mm and quaternion.

        One request.
        """
        return self._run(flows.equipment.rob_target(self._core, unit, tool=tool, wobj=wobj))

    def signals(self) -> tuple[SignalState, ...]:
        """All signals: one request in RWS 1.0, one for a hundred in 2.0."""
        return self._run(flows.equipment.signals(self._core))

    def signal(self, name: str) -> SignalState:
        """Return a signal by its name or as NETWORK/DEVICE/NAME; one request."""
        return self._run(flows.equipment.signal(self._core, name))

    def set_signal(self, name: str, value: float) -> SignalState:
        """Set a signal and read it back; two requests.

        Raises NotConfirmed (RG655): it has another value.
        """
        return self._run(flows.equipment.set_signal(self._core, name, value))

    def dialog(self) -> Dialog | None:
        """Return the open dialog with its parameters; None if there is none."""
        return self._run(flows.dialogs.dialog(self._core))

    def answer_dialog(self, value: RapidValue) -> None:
        """Answer the open dialog: number of a key or button, a num, or a text.

        Returns when it has closed. Raises RwsError (RG650; 404: no dialog is open), NotConfirmed
        (RG655): the answer was accepted, and the dialog is still open.
        """
        self._run(flows.dialogs.answer_dialog(self._core, value))

    def queues(self) -> tuple[str, ...]:
        """Return the names of the clients' queues."""
        return self._run(flows.queues.queues(self._core))

    def make_queue(self, name: str, *, size: int = 10, largest: int = 444) -> None:
        """Create a queue of `size` messages of `largest` bytes.

        It ends with the session.
        """
        self._run(flows.queues.make_queue(self._core, name, size=size, largest=largest))

    def delete_queue(self, name: str) -> None:
        """Delete a queue."""
        self._run(flows.queues.delete_queue(self._core, name))

    def send_message(self, queue: str, data: str, *, sender: str = "", user: int = 0) -> None:
        """Put a message into a queue.

        A message to a task (`RMQ_T_ROB1`) is `type;value`, as `num;42`, and the program answers
        `sender`, a queue of this session.
        """
        self._run(flows.queues.send_message(self._core, queue, data, sender=sender, user=user))

    def receive_message(self, queue: str, *, wait: float = 0.0) -> QueueMessage:
        """Remove and return the first message of a queue of this session.

        Waits s for one. Raises RobotTimeout (RG602): none arrived.
        """
        return self._run(flows.queues.receive_message(self._core, queue, wait=wait))

    def list_files(self, path: str = "HOME") -> tuple[FileInfo, ...]:
        """List the entries of a folder."""
        return self._run(flows.files.list_files(self._core, path))

    def read_file(self, path: str) -> bytes:
        """Return the content of a file."""
        return self._run(flows.files.read_file(self._core, path))

    def write_file(self, path: str, data: bytes) -> bool:
        """Write a whole file; return True if it is new.

        Its folder must exist.
        """
        return self._run(flows.files.write_file(self._core, path, data))

    def delete_file(self, path: str) -> bool:
        """Delete a file, or a folder with its content; False if it is missing."""
        return self._run(flows.files.delete_file(self._core, path))

    def make_folder(self, path: str) -> None:
        """Create a folder in an existing one."""
        self._run(flows.files.make_folder(self._core, path))

    def copy_file(self, path: str, name: str) -> None:
        """Copy a file to another name in its folder."""
        self._run(flows.files.copy_file(self._core, path, name))

    def rename_file(self, path: str, name: str) -> None:
        """Rename a file in its folder."""
        self._run(flows.files.rename_file(self._core, path, name))

    def cfg_domains(self) -> tuple[str, ...]:
        """Names of the domains."""
        return self._run(flows.cfg.cfg_domains(self._core))

    def cfg_types(self, domain: str) -> tuple[str, ...]:
        """Types of a domain."""
        return self._run(flows.cfg.cfg_types(self._core, domain))

    def cfg_instances(self, domain: str, type: str) -> tuple[CfgInstance, ...]:
        """Instances of a type with their attributes: one request for seventy."""
        return self._run(flows.cfg.cfg_instances(self._core, domain, type))

    def cfg_set(self, domain: str, type: str, instance: str, attributes: Mapping[str, str]) -> None:
        """Set attributes of an instance, effective after a restart."""
        self._run(flows.cfg.cfg_set(self._core, domain, type, instance, attributes))

    def cfg_create(self, domain: str, type: str, instance: str) -> None:
        """Create an instance with a name and default attributes."""
        self._run(flows.cfg.cfg_create(self._core, domain, type, instance))

    def cfg_delete(self, domain: str, type: str, instance: str) -> None:
        """Delete an instance."""
        self._run(flows.cfg.cfg_delete(self._core, domain, type, instance))

    def cfg_load(self, path: str, *, mode: Mode = "add") -> None:
        """Load a cfg file of a volume (`HOME/a.cfg`), effective after a restart.

        `add`: an existing instance rejects the whole file. `replace`: existing ones are
        overwritten. Raises RwsError (RG650).
        """
        self._run(flows.cfg.cfg_load(self._core, path, mode=mode))

    def cfg_save(self, domain: str, path: str) -> None:
        """Write a domain to a file on a volume."""
        self._run(flows.cfg.cfg_save(self._core, domain, path))

    def log(self, *, domain: int = 0, after: int = 0, count: int = 50) -> tuple[LogEvent, ...]:
        """Return the last `count` entries of a domain (0: all), oldest first.

        Only those newer than number `after`; at most fifty on RobotWare 7. One request.
        """
        return self._run(flows.equipment.log(self._core, domain=domain, after=after, count=count))

    def backup(self, name: str, *, volume_name: str = "BACKUP") -> str:
        """Make a backup in a new folder on the controller; return its path."""
        return self._run(flows.jobs.backup(self._core, name, volume_name=volume_name))

    def restore(self, path: str, *, wait: float = 180.0) -> None:
        """Restart with a backup on the controller (`BACKUP/name`).

        It replaces modules, cfg and HOME: call `backup` first. RAPID stops. Raises as `restart`;
        RwsError (RG650): not a backup.
        """
        self._run(flows.jobs.restore(self._core, path, wait=wait))

    def restart(self, *, wait: float = 180.0) -> None:
        """Warm-start the controller, and wait s until it serves again.

        RAPID stops. Returns when the controller is back and has tasks. Raises RobotTimeout (RG602),
        NotConfirmed (RG655): the restart was accepted and did not happen.
        """
        self._run(flows.jobs.restart(self._core, wait=wait))

    def wait_ready(self, *, wait: float = 180.0) -> None:
        """Wait s until the controller answers, accepts a login and has tasks.

        Raises RobotTimeout (RG602).
        """
        self._run(flows.jobs.wait_ready(self._core, wait=wait))
