"""Run a foreign program in real time, with real sockets."""

import socket
import threading
from contextlib import contextmanager
from dataclasses import replace

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.system.model import System


@contextmanager
def served(system: System, robot: str, count: int = 1, *, units: tuple[str, ...] = ()):
    """Run a controller in real time; yield the ports of its listeners."""
    groups = groups_for(system, load_config(robot).groups)
    if units:
        groups = tuple(replace(group, external_units=units) for group in groups)
    with VirtualController(system, groups, clock="real", ports="auto", speed=20) as controller:
        listening = threading.Event()

        def look() -> None:
            if len(controller.network.listeners) >= count:
                listening.set()

        controller.network.listening.add(look)
        controller.start()
        assert listening.wait(10), [*controller.call(controller.where), *controller.log]
        ports = sorted(controller.network.listeners.items())
        try:
            yield controller, [real for _, (_, real, *_) in ports]
        except (AssertionError, OSError) as error:
            where = controller.call(lambda: [*controller.where(), *map(str, controller.log)])
            raise AssertionError("\n".join(where)) from error
        faults = [f"{t.name}: {t.fault}" for t in controller.tasks.values() if t.fault]
        assert not faults, faults


class Link:
    """A client that reads until a text arrives."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.stream = ""

    def __enter__(self) -> "Link":
        return self

    def __exit__(self, *_: object) -> None:
        self._socket.close()

    def send(self, text: str) -> None:
        """Send a text."""
        self._socket.sendall(text.encode("latin-1"))

    def until(self, end: str, times: int = 1) -> str:
        """Return the received text up to the `times`-th `end`; keep the rest."""
        while self.stream.count(end) < times:
            more = self._socket.recv(4096).decode("latin-1")
            assert more, f"closed after {self.stream!r}"
            self.stream += more
        parts = self.stream.split(end)
        self.stream = end.join(parts[times:])
        return end.join(parts[:times])
