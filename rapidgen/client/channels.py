"""Blocking sockets of the sync client.

The calling thread writes, one thread reads: a background loop between stop() and the socket would
cost milliseconds. Points are written so that a STOP fits between two frames at any moment.
"""

import selectors
import socket
import threading
import weakref
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from select import POLLOUT, poll
from typing import Protocol

from rapidgen.client.address import Address
from rapidgen.client.errors import ConnectionLost, RobotTimeout, not_reached, os_reason
from rapidgen.client.unclosed import warn_unclosed
from rapidgen.wire.simple_message.numpy_codec import FRAME_BYTES
from rapidgen.wire.simple_message.spec import Port

_CHUNK = 64 * FRAME_BYTES
_RECEIVE = 65536
_SLICE = 0.05
"""s after which a blocked sender checks for a stop request."""
_TICK = 0.1
"""s between two checks of the clock while no data arrives."""


class Channel:
    """One TCP connection.

    `send` and `offer_after` may be called from different threads.
    """

    def __init__(self, address: Address, port: Port, timeout: float) -> None:
        number = address.port(port)
        name = port.name.lower()
        try:
            self.socket = socket.create_connection((address.host, number), timeout)
        except OSError as error:
            where = f"{address.host} port {number} ({name})"
            raise not_reached(where, error, timeout) from error
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.setblocking(False)
        self.port = port
        self._lock = threading.Lock()
        self._rest = memoryview(b"")
        """The unsent rest of a frame that was sent in part."""
        self._is_offered = False
        """True if no other thread sends that rest."""

    def send(self, data: bytes, timeout: float, stopping: Callable[[], bool]) -> bool:
        """Send whole frames; False if `stopping` interrupted it between two.

        Raises RobotTimeout if the peer reads no byte for `timeout` s, ConnectionLost.
        """
        view = memoryview(data)
        at = 0
        waited = 0.0
        while at < len(view):
            if stopping():
                return False
            with self._lock:
                # Checked again: a STOP may have arrived between the test and the lock.
                if stopping():
                    return False
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
            elif waited >= timeout:
                # The rest of a frame goes out before any other byte.
                self._is_offered = True
                raise RobotTimeout.because(
                    "RG603",
                    f"the controller read no byte for {timeout:g} s",
                    "look at the controller",
                )
            else:
                self._wait_writable(_SLICE)
                waited += _SLICE
        return True

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
                self._wait_writable(_SLICE)
                waited += _SLICE

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
        if number >= 0:
            waiter = poll()
            waiter.register(number, POLLOUT)
            waiter.poll(seconds * 1000)

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


class ReaderOwner(Protocol):
    """Receiver of what a reader reads."""

    @property
    def is_busy(self) -> bool:
        """True if `tick` must be called regularly."""

    def received(self, channel: Channel, data: bytes) -> None:
        """Process bytes of a channel."""

    def lost(self, channel: Channel, why: str) -> None:
        """Record that the peer closed a channel."""

    def tick(self) -> None:
        """Check the clock."""


class Reader:
    """The one thread that reads all connections of a robot.

    It holds its owner weakly, so that a dropped one is finalized, which calls `abandon`.
    """

    def __init__(self, owner: ReaderOwner, name: str) -> None:
        self._owner = weakref.ref(owner)
        self._selector = selectors.DefaultSelector()
        self._wake, self._waker = socket.socketpair()
        self._wake.setblocking(False)
        self._selector.register(self._wake, selectors.EVENT_READ)
        # Reentrant: a garbage collection in a locked section may call `abandon`.
        self._lock = threading.RLock()
        self._coming: list[Channel] = []
        self._going: list[Channel] = []
        self._ended = False
        self._thread = threading.Thread(target=self._loop, name=f"rapidgen {name}", daemon=True)
        self._thread.start()

    def add(self, channel: Channel) -> None:
        """Read this channel from now on."""
        with self._lock:
            self._coming.append(channel)
        self._waker.send(b".")

    def remove(self, channel: Channel) -> None:
        """Stop reading this channel and close it."""
        with self._lock:
            self._going.append(channel)
        self._waker.send(b".")

    def abandon(self) -> None:
        """End the thread without waiting for it; it closes every channel."""
        with self._lock:
            self._ended = True
            self._waker.send(b".")

    def close(self) -> None:
        """End the thread; every channel is closed."""
        self.abandon()
        # The owner may be dropped while this thread calls it.
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def forked(self) -> None:
        """Close the descriptors in a forked process, where the thread does not run."""
        self._selector.close()
        self._wake.close()
        self._waker.close()

    def _is_busy(self) -> bool:
        owner = self._owner()
        return owner is not None and owner.is_busy

    def _tick(self) -> None:
        owner = self._owner()
        if owner is not None:
            owner.tick()

    def _lost(self, channel: Channel, why: str) -> None:
        owner = self._owner()
        if owner is not None:
            owner.lost(channel, why)

    def _received(self, channel: Channel, data: bytes) -> None:
        owner = self._owner()
        if owner is not None:
            owner.received(channel, data)

    def _loop(self) -> None:
        while not self._ended:
            events = self._selector.select(_TICK if self._is_busy() else None)
            if not events:
                self._tick()
            for key, _ in events:
                if key.fileobj is self._wake:
                    self._change()
                elif key.data in self._selector_channels():
                    self._read(key.data)
        for channel in self._selector_channels():
            self._forget(channel)
        with self._lock:
            coming, self._coming = self._coming, []
            self._wake.close()
            self._waker.close()
        for channel in coming:
            # Data and end of file arrived together since the last check.
            channel.close()
        self._selector.close()

    def _selector_channels(self) -> list[Channel]:
        return [key.data for key in self._selector.get_map().values() if key.data is not None]

    def _change(self) -> None:
        try:
            self._wake.recv(4096)
        except BlockingIOError:
            return
        with self._lock:
            coming, self._coming = self._coming, []
            going, self._going = self._going, []
        for channel in coming:
            self._selector.register(channel.socket, selectors.EVENT_READ, channel)
        for channel in going:
            if channel in self._selector_channels():
                self._forget(channel)

    def _read(self, channel: Channel) -> None:
        try:
            data = channel.socket.recv(_RECEIVE)
        except BlockingIOError:
            return
        except OSError as error:
            self._forget(channel)
            self._lost(channel, os_reason(error))
            return
        if data:
            self._received(channel, data)
        else:
            self._forget(channel)
            self._lost(channel, "the controller closed it")

    def _forget(self, channel: Channel) -> None:
        self._selector.unregister(channel.socket)
        channel.close()


@dataclass(slots=True, eq=False)
class Connections:
    """Connections of one robot, apart from the runner that its user may drop."""

    where: str
    channels: dict[Port, Channel] = field(default_factory=dict)
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
            for port, channel in self.channels.items():
                if port is not Port.STATE:
                    with suppress(ConnectionLost):
                        channel.offer_after(stop)
        self.reader.abandon()
        warn_unclosed(self.where, stopped=self.may_move)

    def forked(self) -> None:
        """Close the descriptors of a forked process; the connections stay the parent's."""
        for channel in self.channels.values():
            channel.close()
        self.channels.clear()
        if self.reader is not None:
            self.reader.forked()
        self.reader = None
        self.may_move = False
