"""Partners of externally guided motion over UDP: each exchange in a process of its own.

The controller is the UDP client: it sends first, and its partner answers to the port from which the
datagram came. A process of its own keeps the period of 4 ms while the controller executes RAPID
(next to a busy thread of the same process a period was up to 71 ms late). Controller and process
exchange orders, the state of the robot and results over a socket pair.
"""

import os
import select
import socket
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from multiprocessing.connection import Connection
from time import monotonic, sleep
from typing import TYPE_CHECKING, Final

from rapidgen.motion.egm.exchange import Exchange, Inputs, Order, Result
from rapidgen.motion.egm.law import CYCLE
from rapidgen.motion.egm.sessions import Loop
from rapidgen.system.model import UdpDevice

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController

DEFAULT_PORT: Final = 6510
Address = tuple[str, int]
_NOT_REAL_TIME: Final = 194_914
_IP_RECVERR: Final = 11
"""Of <linux/in.h>: errors of ICMP reach a socket without a peer."""


class UdpLink:
    """Datagrams with a partner; those of other addresses are dropped, as by a controller."""

    def __init__(self, address: Address) -> None:
        self._address = address
        self._refused = False
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        self._socket.setsockopt(socket.IPPROTO_IP, _IP_RECVERR, 1)
        # Other computers reach the port only if the partner is one of them.
        self._socket.bind(("127.0.0.1" if address[0].startswith("127.") else "", 0))

    def send(self, data: bytes) -> None:
        """Send a datagram.

        ConnectionRefusedError: nothing listens there, which the answer to an earlier one showed.
        """
        if self._refused:
            raise ConnectionRefusedError(*self._address)
        try:
            self._socket.sendto(data, self._address)
        except BlockingIOError:
            return  # As on a network, a datagram that finds no place is lost.

    def receive(self) -> bytes | None:
        """Return the oldest datagram of the partner."""
        while True:
            try:
                data, source = self._socket.recvfrom(65_536)
            except BlockingIOError:
                return None
            except ConnectionRefusedError:
                self._refused = True
                return None
            if source[0] == self._address[0]:
                return data

    def close(self) -> None:
        """Close the port."""
        self._socket.close()


class ProcessLoop:
    """An exchange in another process."""

    def __init__(self, exchange: Exchange, address: Address, now: float) -> None:
        ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "rapidgen.servers.egm_process", str(theirs.fileno())],
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )
        self._pipe = Connection(ours.detach())
        # The process needs some time to start; its clock is this one nevertheless.
        self._pipe.send((exchange, address, now - monotonic()))

    def execute(self, order: Order) -> None:
        """Send an order."""
        self._post(order)

    def cycle(self, inputs: Inputs, now: float) -> Sequence[Result]:
        """Send the state of the robot; return what has happened since the last call."""
        # Only the newest inputs count. A process that starts, or that is behind, reads none: a pipe
        # that is full would let the whole controller wait.
        if select.select([], [self._pipe], [], 0)[1]:
            self._post(inputs)
        results = []
        try:
            while self._pipe.poll():
                results.append(self._pipe.recv())
        except (EOFError, ConnectionResetError):
            results.append(Result(outcome="unreachable", reason="the process of EGM has ended"))
        return results

    def _post(self, item: Order | Inputs) -> None:
        # A process that has ended is noticed by `cycle`.
        try:
            self._pipe.send(item)
        except BrokenPipeError:
            return

    def close(self) -> None:
        """End the process."""
        self._pipe.close()
        self._process.wait()


def serve_egm(
    controller: "VirtualController", partners: Mapping[str, Address]
) -> Callable[[], None]:
    """Let a controller on the real clock exchange datagrams with its partners.

    Args:
        controller: On the real clock, at speed 1; other sessions get no datagrams and a warning.
        partners: Addresses by device, lower case. Others are on 127.0.0.1, at the port of the
            configuration, or at 6510.

    Returns:
        Ends all sessions.
    """

    def opened(device: UdpDevice, exchange: Exchange) -> Loop | None:
        scheduler = controller.scheduler
        if scheduler.clock != "real" or scheduler.speed != 1:
            controller.log.record(_NOT_REAL_TIME, str(device))
            return None
        address = partners.get(device.name.lower(), ("127.0.0.1", device.port or DEFAULT_PORT))
        return ProcessLoop(exchange, address, scheduler.now * 1e-9)

    controller.egm.open_loop = opened
    return controller.egm.close


def run_exchange(pipe: Connection, exchange: Exchange, link: UdpLink, offset: float) -> None:
    """Execute cycles until the controller closes the pipe.

    `offset` is the time of the controller minus that of the monotonic clock, s.
    """
    due = monotonic()
    waiting: list[Result] = []
    inputs: Inputs | None = None
    while True:
        try:
            while pipe.poll():
                item = pipe.recv()
                if isinstance(item, Inputs):
                    inputs = item
                else:
                    exchange.execute(item)
        except (EOFError, ConnectionResetError):
            return
        now = monotonic()
        if inputs is not None and (exchange.running or exchange.has_ended):
            waiting.append(exchange.cycle(link, inputs, offset + now))
            # A controller that is behind must not make this process late.
            if select.select([], [pipe], [], 0)[1]:
                try:
                    for result in waiting:
                        pipe.send(result)
                except BrokenPipeError:
                    return
                waiting.clear()
        due += CYCLE
        left = due - monotonic()
        if left > 0:
            sleep(left)
        elif left < -CYCLE:
            due = monotonic()
