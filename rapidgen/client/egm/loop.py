"""The caller's end of the process that answers frames."""

import contextlib
import os
import socket
import subprocess
import sys
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Protocol

from rapidgen.client.errors import ConnectionFailed

if TYPE_CHECKING:
    from rapidgen.client.egm.exchange import EgmState, Order, PartnerExchange


class Loop(Protocol):
    """Answers frames, wherever it runs."""

    port: int
    """UDP port; 0: none."""

    def post(self, order: "Order") -> None:
        """Send an order. OSError: the loop has ended."""

    def wait_started(self) -> None:
        """Wait until it can answer a frame at once, or has ended."""

    def close(self) -> None:
        """End it, and wait for its end."""


class LoopProcess:
    """A process of its own that answers the frames of a UDP port.

    Args:
        exchange: What it answers.
        host, port: Address; port 0: any free one.
        receive: Called with each state, on a thread.
        receive_end: Called once when the process has ended.

    ConnectionFailed: the port cannot be opened.
    """

    def __init__(
        self,
        exchange: "PartnerExchange",
        host: str,
        port: int,
        receive: Callable[["EgmState"], None],
        receive_end: Callable[[], None],
    ) -> None:
        opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            opened.bind((host, port))
        except OSError as fault:
            opened.close()
            raise ConnectionFailed.because(
                "RG681",
                f"cannot listen on {host}:{port}: {fault.strerror}",
                "end the program that uses the port, or give an address of this computer",
            ) from fault
        self.port: int = opened.getsockname()[1]
        ours, theirs = socket.socketpair()
        with theirs, opened:
            numbers = (theirs.fileno(), opened.fileno())
            self._process = subprocess.Popen(
                [sys.executable, "-m", "rapidgen.client.egm.process", *map(str, numbers)],
                pass_fds=numbers,
                stdin=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )
        self._pipe = Connection(ours.detach())
        self._pipe.send(exchange)
        self._started = threading.Event()
        self._thread = threading.Thread(
            target=self._read, args=(receive, receive_end), name="EGM states", daemon=True
        )
        self._thread.start()

    def _read(self, receive: Callable[["EgmState"], None], receive_end: Callable[[], None]) -> None:
        try:
            # The first message says that the loop has begun.
            self._pipe.recv()
            self._started.set()
            while True:
                receive(self._pipe.recv())
        except (EOFError, OSError):
            self._started.set()
            receive_end()

    def post(self, order: "Order") -> None:
        """Send an order. OSError: the process has ended."""
        self._pipe.send(order)

    def wait_started(self) -> None:
        """Wait until the process can answer a frame at once, or has ended.

        Its start takes about as long as the time-out of EGMSetupUC.
        """
        self._started.wait()

    def close(self) -> None:
        """End the process; a second call does nothing."""
        if self._pipe.closed:
            return
        # It may have ended already.
        with contextlib.suppress(OSError):
            self._pipe.send(None)
        self._process.wait()
        self._thread.join()
        self._pipe.close()
