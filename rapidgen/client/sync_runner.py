"""Runner of flows of the synchronous client.

The calling thread decides and writes, one thread a robot reads: a background loop between stop()
and the socket would cost milliseconds. Points are written so that a STOP fits between two frames at
any moment.
"""

import select
import selectors
import socket
import threading
import time
import weakref
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from inspect import GEN_CLOSED, getgeneratorstate
from typing import TypeVar

from rapidgen.client import flows
from rapidgen.client.address import Address
from rapidgen.client.core.motion import CommandedMotion
from rapidgen.client.core.robot import STOP_FRAME
from rapidgen.client.errors import (
    ConnectionLost,
    MotionStopped,
    RobotError,
    RobotTimeout,
    not_reached,
    os_reason,
)
from rapidgen.client.flows.effects import (
    Close,
    CloseAll,
    Effect,
    Flow,
    Open,
    Send,
    SendAtOnce,
    Wait,
)
from rapidgen.client.runner import FlowRunner, MakeCore, release_frames
from rapidgen.client.unclosed import warn_unclosed
from rapidgen.wire.simple_message.numpy_codec import FRAME_BYTES
from rapidgen.wire.simple_message.spec import Port

T = TypeVar("T")
_CHUNK = 64 * FRAME_BYTES
_RECEIVE = 65536
_BLOCKED = 0.05
"""s after which a blocked sender checks for a stop request."""


class Connection:
    """One TCP connection.

    `send` and `offer_after` may be called from different threads.
    """

    def __init__(self, address: Address, port: Port, timeout: float) -> None:
        number = address.port(port)
        name = port.name.lower()
        try:
            self.socket = socket.create_connection((address.host, number), timeout)
        except OSError as error:
            where = f"{address.host} port {number} ({name} port of {address})"
            raise not_reached(where, error, timeout) from error
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.setblocking(False)
        self.port = port
        self._lock = threading.Lock()
        self._rest = memoryview(b"")
        """The unsent rest of a frame that was sent in part."""
        self._is_offered = False
        """True if no other thread sends that rest."""

    def send(self, effect: Send) -> None:
        """Send whole frames.

        Raises MotionStopped between two of them once a stop was requested, RobotTimeout if the peer
        reads no byte for the effect's time-out, ConnectionLost.
        """
        view, motion = memoryview(effect.data), effect.motion
        at = 0
        waited = 0.0
        while at < len(view):
            with self._lock:
                if motion is not None and motion.stopping:
                    raise MotionStopped.because("RG631", "stopped before the trajectory was sent")
                if self._is_offered and self._rest:
                    # Frames that were offered earlier go out first.
                    sent = self._write(self._rest)
                    self._rest = self._rest[sent:]
                else:
                    sent = self._write(view[at : at + _CHUNK])
                    at += sent
                    end = -(-at // FRAME_BYTES) * FRAME_BYTES
                    self._rest = view[at : min(end, len(view))]
                    self._is_offered = False
            if sent:
                waited = 0.0
            elif waited >= effect.timeout:
                # The rest of a frame goes out before any other byte.
                self._is_offered = True
                raise RobotTimeout.because(
                    "RG603",
                    f"the controller read no byte for {effect.timeout:g} s",
                    "look at the controller",
                )
            else:
                self._wait_writable(_BLOCKED)
                waited += _BLOCKED

    def finish(self, timeout: float) -> None:
        """Wait until all offered frames are sent.

        Raises RobotTimeout if the peer reads no byte for `timeout` s, ConnectionLost.
        """
        waited = 0.0
        while True:
            with self._lock:
                if not (self._is_offered and self._rest):
                    return
                sent = self._write(self._rest)
                self._rest = self._rest[sent:]
            if sent:
                waited = 0.0
            elif waited >= timeout:
                raise RobotTimeout.because(
                    "RG603", f"the controller read no byte for {timeout:g} s"
                )
            else:
                self._wait_writable(_BLOCKED)
                waited += _BLOCKED

    def offer(self, frames: Callable[[], bytes | None]) -> None:
        """Send the frames of an iterable as far as the kernel accepts them.

        Does not block; the rest of a frame goes out with the next call. Raises ConnectionLost.
        """
        if not self._lock.acquire(blocking=False):
            return
        try:
            while True:
                if self._rest:
                    if not self._is_offered:
                        return
                    self._rest = self._rest[self._write(self._rest) :]
                    if self._rest:
                        return
                data = frames()
                if data is None:
                    return
                self._rest = memoryview(data)
                self._is_offered = True
        finally:
            self._lock.release()

    def offer_after(self, data: bytes) -> None:
        """Send after the frame that was sent in part, without blocking.

        The rest goes out with the next call of any method. Raises ConnectionLost.
        """
        # No thread waits for the network while it holds the lock.
        with self._lock:
            self._rest = memoryview(bytes(self._rest) + data)
            self._is_offered = True
            self._rest = self._rest[self._write(self._rest) :]

    def _write(self, view: memoryview) -> int:
        try:
            return self.socket.send(view)
        except BlockingIOError:
            return 0
        except OSError as error:
            raise self._lost(error) from error

    def _wait_writable(self, seconds: float) -> None:
        number = self.socket.fileno()
        # Another thread has closed the socket: the next write reports it.
        if number < 0:
            return
        if hasattr(select, "poll"):  # Windows has none; `select` takes no high numbers elsewhere
            waiter = select.poll()
            waiter.register(number, select.POLLOUT)
            waiter.poll(seconds * 1000)
        else:
            select.select((), (number,), (), seconds)

    def _lost(self, error: OSError) -> ConnectionLost:
        name = self.port.name.lower()
        reason = os_reason(error)
        return ConnectionLost.because(
            "RG602",
            f"the connection to the {name} port was lost: {reason}",
            "look at the controller",
        )

    def close(self) -> None:
        """Close the connection; a second call does nothing."""
        self.socket.close()


class Reader:
    """The one thread that reads all connections of a robot.

    It holds its owner weakly, so that a dropped one is finalized, which calls `abandon`.
    """

    def __init__(self, owner: "SyncFlowRunner", name: str) -> None:
        self._owner = weakref.ref(owner)
        self._selector = selectors.DefaultSelector()
        self._wake, self._waker = socket.socketpair()
        self._wake.setblocking(False)
        self._selector.register(self._wake, selectors.EVENT_READ)
        # Reentrant: a garbage collection in a locked section may call `abandon`.
        self._lock = threading.RLock()
        self._coming: list[Connection] = []
        self._going: list[Connection] = []
        self._ended = False
        self._thread = threading.Thread(target=self._loop, name=f"rapidgen {name}", daemon=True)
        self._thread.start()

    def add(self, connection: Connection) -> None:
        """Read this connection from now on."""
        with self._lock:
            self._coming.append(connection)
        self._waker.send(b".")

    def remove(self, connection: Connection) -> None:
        """Stop reading this connection and close it."""
        with self._lock:
            self._going.append(connection)
        self._waker.send(b".")

    def abandon(self) -> None:
        """End the thread without waiting for it; it closes every connection."""
        with self._lock:
            self._ended = True
            self._waker.send(b".")

    def close(self) -> None:
        """End the thread; every connection is closed."""
        self.abandon()
        # The owner may be dropped while this thread calls it.
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def forked(self) -> None:
        """Close the descriptors in a forked process, where the thread does not run."""
        self._selector.close()
        self._wake.close()
        self._waker.close()

    def _interval(self) -> float | None:
        """Return the s until the next check of the clock; None: none is needed."""
        owner = self._owner()
        return owner.core.tick if owner is not None and owner.core.is_busy else None

    def _tick(self) -> None:
        owner = self._owner()
        if owner is not None:
            owner.tick()

    def _lost(self, connection: Connection, why: str) -> None:
        owner = self._owner()
        if owner is not None:
            owner.lost(connection, why)

    def _received(self, connection: Connection, data: bytes) -> None:
        owner = self._owner()
        if owner is not None:
            owner.received(connection, data)

    def _loop(self) -> None:
        while not self._ended:
            events = self._selector.select(self._interval())
            if not events:
                self._tick()
            for key, _ in events:
                if key.fileobj is self._wake:
                    self._change()
                elif key.data in self._registered():
                    self._read(key.data)
        for connection in self._registered():
            self._forget(connection)
        with self._lock:
            coming, self._coming = self._coming, []
            self._wake.close()
            self._waker.close()
        for connection in coming:
            # Data and end of file arrived together since the last check.
            connection.close()
        self._selector.close()

    def _registered(self) -> list[Connection]:
        return [key.data for key in self._selector.get_map().values() if key.data is not None]

    def _change(self) -> None:
        try:
            self._wake.recv(4096)
        except BlockingIOError:
            return
        with self._lock:
            coming, self._coming = self._coming, []
            going, self._going = self._going, []
        for connection in coming:
            self._selector.register(connection.socket, selectors.EVENT_READ, connection)
        for connection in going:
            if connection in self._registered():
                self._forget(connection)

    def _read(self, connection: Connection) -> None:
        try:
            data = connection.socket.recv(_RECEIVE)
        except BlockingIOError:
            return
        except OSError as error:
            self._forget(connection)
            self._lost(connection, os_reason(error))
            return
        if data:
            self._received(connection, data)
        else:
            self._forget(connection)
            self._lost(connection, "the controller closed it")

    def _forget(self, connection: Connection) -> None:
        self._selector.unregister(connection.socket)
        connection.close()


@dataclass(slots=True, eq=False)
class Connections:
    """Connections of one robot, apart from the runner that its user may drop."""

    where: str
    by_port: dict[Port, Connection] = field(default_factory=dict)
    reader: Reader | None = None
    may_move: bool = False
    """True if a motion of this client may move the robot."""

    def close_dropped(self, stop: bytes) -> None:
        """Close without waiting, with a warning; `stop` goes out during a motion.

        It may run on any thread, at any moment at which Python collects garbage.
        """
        if self.reader is None:
            return
        if self.may_move:
            for port, connection in self.by_port.items():
                if port is not Port.STATE:
                    with suppress(ConnectionLost):
                        connection.offer_after(stop)
        self.reader.abandon()
        warn_unclosed(self.where, stopped=self.may_move)

    def forked(self) -> None:
        """Close the descriptors of a forked process; the connections stay the parent's."""
        for connection in self.by_port.values():
            connection.close()
        self.by_port.clear()
        if self.reader is not None:
            self.reader.forked()
        self.reader = None
        self.may_move = False


class SyncFlowRunner(FlowRunner):
    """Runner of flows: the caller's thread decides and writes, another reads."""

    guard: threading.Condition

    def __init__(self, address: Address, make_core: MakeCore) -> None:
        super().__init__(address, make_core(time.monotonic), threading.Condition())
        self._connections = Connections(str(address))
        self._by_port = self._connections.by_port
        weakref.finalize(self, self._connections.close_dropped, STOP_FRAME)

    def forked(self) -> None:
        """Drop the connections in a forked process."""
        # A thread that the child does not have may hold the old lock.
        self.guard = threading.Condition()
        self._connections.forked()
        super().forked()

    def run(self, flow: Flow[T]) -> T:
        """Run a flow: effects without the lock, its own steps with it.

        Ctrl-C may arrive anywhere here, and the flow must receive it to stop the robot.
        """
        try:
            return self._run(flow)
        except (RobotError, KeyboardInterrupt) as error:
            release_frames(error)
            raise

    def _run(self, flow: Flow[T]) -> T:
        outcome: bool | None = None
        failure: BaseException | None = None
        before = self.core.motion
        while True:
            error, failure = failure, None
            try:
                try:
                    with self.guard:
                        try:
                            effect = flow.send(outcome) if error is None else flow.throw(error)
                        finally:
                            self._pump()
                except StopIteration as end:
                    value: T = end.value
                    return value
                outcome = self._perform(effect)
            except (RobotError, KeyboardInterrupt) as raised:
                if getgeneratorstate(flow) == GEN_CLOSED:
                    self._stop_unnoticed(raised, before)
                    raise
                failure = raised

    def _stop_unnoticed(
        self, raised: RobotError | KeyboardInterrupt, before: CommandedMotion | None
    ) -> None:
        """Stop a motion that Ctrl-C hides from the caller.

        It arrived after the last step of the flow that started the motion, before the caller got
        it.
        """
        motion = self.core.motion
        if isinstance(raised, KeyboardInterrupt) and motion not in (None, before):
            assert motion is not None
            if not motion.is_over or motion.needs_stop:
                self.run(flows.stop.stop(self.core))

    def _pump(self) -> None:
        """Send due frames as far as possible without waiting.

        The lock is held.
        """
        core = self.core
        self._connections.may_move = core.may_move
        stops = core.unmonitored_stops()
        for port, connection in self._by_port.items():
            try:
                if port in stops:
                    connection.offer_after(STOP_FRAME)
                connection.offer(partial(core.due, port))
            except RobotError as error:
                # The reader receives it too.
                core.state_port.note(str(error))

    def tick(self) -> None:
        """Check the clock and send what is due."""
        with self.guard:
            self.core.poll()
            self._pump()
            self.guard.notify_all()

    def _perform(self, effect: Effect) -> bool:
        if isinstance(effect, Wait):
            return self._wait(effect)
        if isinstance(effect, Close):
            self._close(effect.port)
            return True
        if isinstance(effect, Open):
            self._open(effect)
            return True
        if isinstance(effect, CloseAll):
            self._close_all()
            return True
        if isinstance(effect, SendAtOnce):
            self._send_at_once(effect)
            return True
        connection = self._by_port.get(effect.port)
        if connection is None:
            raise self.core.disconnected()
        try:
            connection.send(effect)
        except ConnectionLost as error:
            with self.guard:
                # The reader was faster and knows the cause better.
                if self._by_port.get(effect.port) is not connection:
                    raise self.core.disconnected() from error
            raise
        return True

    def _send_at_once(self, effect: SendAtOnce) -> None:
        connections = {port: self._by_port.get(port) for port in effect.ports}
        # Write to all connections before waiting for a blocked one.
        steps: tuple[Callable[[Connection], None], ...] = (
            lambda connection: connection.offer_after(effect.data),
            lambda connection: connection.finish(effect.timeout),
        )
        for step in steps:
            for port, connection in connections.items():
                if port in effect.failures:
                    continue
                if connection is None:
                    effect.failures[port] = self.core.disconnected()
                    continue
                try:
                    step(connection)
                except (ConnectionLost, RobotTimeout) as error:
                    effect.failures[port] = error

    def _wait(self, effect: Wait) -> bool:
        deadline = time.monotonic() + effect.timeout
        with self.guard:
            while not effect.until():
                left = deadline - time.monotonic()
                if left <= 0:
                    return False
                self.guard.wait(min(left, self.core.tick))
                self.core.poll()
                self._pump()
            return True

    def _close(self, port: Port) -> None:
        with self.guard:
            connection = self._by_port.pop(port, None)
            self.core.dropped(port)
            if connection is not None and self._connections.reader is not None:
                self._connections.reader.remove(connection)

    def _open(self, effect: Open) -> None:
        connection = Connection(self.address, effect.port, effect.timeout)
        with self.guard:
            reader = self._connections.reader
            if reader is None:
                reader = self._connections.reader = Reader(self, str(self.address))
            old = self._by_port.get(effect.port)
            if old is not None:
                reader.remove(old)
            self._by_port[effect.port] = connection
            self.core.opened(effect.port)
            reader.add(connection)

    def received(self, connection: Connection, data: bytes) -> None:
        """Process bytes of a connection."""
        with self.guard:
            if self._by_port.get(connection.port) is connection:
                if not self.core.received(connection.port, data):
                    del self._by_port[connection.port]
                    assert self._connections.reader is not None
                    self._connections.reader.remove(connection)
                self._pump()
                self.guard.notify_all()

    def lost(self, connection: Connection, why: str) -> None:
        """Record that the peer closed a connection."""
        with self.guard:
            if self._by_port.get(connection.port) is connection:
                del self._by_port[connection.port]
                self.core.lost(connection.port, why)
                self._pump()
                self.guard.notify_all()

    def _close_all(self) -> None:
        with self.guard:
            self.core.closed()
            connections = list(self._by_port.values())
            self._by_port.clear()
            reader, self._connections.reader = self._connections.reader, None
        if reader is not None:
            for connection in connections:
                reader.remove(connection)
            reader.close()
