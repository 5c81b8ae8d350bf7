"""TCP client of a program under test, on the controller's own clock.

    client = Client(controller, 5000)
    client.send(b"MOVE 10\\n")
    assert client.receive(until=b"\\n") == b"OK\\n"

There are no threads: simulated time passes inside these calls, until the requested data is there.
"""

from collections.abc import Callable

from rapidgen.controller.controller import Deadlock, VirtualController
from rapidgen.machine.network.interface import BUFFER, NetworkFault

TIMEOUT = 10.0
"""Simulated seconds that a call waits."""


class Client:
    """A TCP client of a virtual controller on the virtual clock."""

    def __init__(
        self, controller: VirtualController, port: int, *, timeout: float = TIMEOUT
    ) -> None:
        """Connect as soon as the program listens.

        TimeoutError: it never does; the message gives the reason.
        """
        self._controller = controller
        self._timeout = timeout
        self._read = b""
        network = controller.network
        self._until(lambda: port in network.listeners, f"nothing listens on port {port}", timeout)
        self._endpoint = network.connect(network.address, port)
        self._until(lambda: self._endpoint.connected, f"port {port} does not answer", timeout)

    def send(self, data: bytes) -> None:
        """Send bytes.

        ConnectionError: the program has closed the connection.
        """
        _bytes("send", data)
        left = data
        while left:
            try:
                accepted = self._controller.network.send(self._endpoint, left)
            except NetworkFault as fault:
                raise ConnectionError(str(fault)) from fault
            left = left[accepted:]
            if left:
                self._controller.run_for(0.001)

    def receive(self, count: int = 0, *, until: bytes = b"", timeout: float | None = None) -> bytes:
        """Return `count` bytes, the bytes up to `until`, or the next bytes.

        `until` is included. Later bytes are kept. b"" when the program has closed the connection
        and nothing is left. TimeoutError, with the positions of the tasks, when the bytes do not
        arrive.
        """
        _bytes("receive until", until)
        finished = False

        def target() -> bool:
            nonlocal finished
            try:
                data = self._controller.network.receive(self._endpoint, BUFFER)
            except NetworkFault:
                data = b""
            if data is not None:
                finished = not data
                self._read += data
            if until:
                return until in self._read or finished
            return len(self._read) >= max(count, 1) or finished

        expected = repr(until) if until else f"{count or 'any'} bytes"
        seconds = self._timeout if timeout is None else timeout
        self._until(target, f"{expected} did not arrive, only {self._read!r}", seconds)
        size = count or len(self._read)
        if until and until in self._read:
            size = self._read.index(until) + len(until)
        result, self._read = self._read[:size], self._read[size:]
        return result

    def close(self) -> None:
        """End the connection."""
        self._controller.network.close(self._endpoint)

    def _until(self, condition: Callable[[], bool], why: str, timeout: float) -> None:
        controller = self._controller
        try:
            came = condition() or controller.run_until(condition, timeout=timeout)
        except Deadlock:
            came = False
        if not came:
            faults = [f"{t.name}: {t.fault}" for t in controller.tasks.values() if t.fault]
            raise TimeoutError("\n".join([why, *faults, *controller.where()]))


def _bytes(what: str, data: bytes) -> None:
    if isinstance(data, str):
        raise TypeError(f"{what} bytes, not a text: {data.encode()!r}")
