"""Answers of a controller that get lost, on real sockets and on the virtual clock.

What changes them is a function `alter(port, number, message)` of a message of the controller, the
`number`th on that port ("motion", "state" or "control"): the bytes that arrive instead, or CUT.
"""

import contextlib
import socket
import threading

from fake_controller import pieces

CUT = None
"""The client's connection ends, and the controller's stays."""


def wrong_type(message):
    return message[:4] + b"\x0e\x00\x00\x00" + message[8:]


def wrong_direction(message):
    return message[:8] + b"\x02\x00\x00\x00" + message[12:]


def wrong_length(message):
    return (len(message)).to_bytes(4, "little") + message[4:] + bytes(4)


def no_frame(message):
    return b"\xff\xff\xff\x7f" + message[4:]


def swallowed(message):
    return b""


def cut(message):
    return CUT


FAULTS = (cut, swallowed, wrong_type, wrong_direction, wrong_length, no_frame)


def once(port, fault, number=1, kind=None):
    """Harm one message of a port: the `number`th, or the `number`th of a message type."""
    seen = []

    def alter(which, _, message):
        if which == port and kind in (None, int.from_bytes(message[4:8], "little")):
            seen.append(message)
            if len(seen) == number:
                return fault(message)
        return message

    return alter


class Altered:
    """The messages of one connection, altered."""

    def __init__(self, port, alter):
        self._port, self._alter = port, alter
        self._buffer, self._number = b"", 0

    def feed(self, data):
        """Return the altered data, and whether the connection stays open."""
        result, self._buffer = pieces(self._buffer + data)
        out = b""
        for message in result:
            self._number += 1
            changed = self._alter(self._port, self._number, message)
            if changed is CUT:
                return out, False
            out += changed
        return out, True


def alter_loop(loop, ports, alter):
    """Let connections of an asyncio loop receive altered messages; `ports`: names by number. The
    transports of those that were cut are in the list that this returns."""
    connect = loop.create_connection
    open_ends = []

    async def create_connection(factory, host=None, port=None, **options):
        name = ports[port]

        def make():
            protocol = factory()
            altered, receive = Altered(name, alter), protocol.data_received
            lose = protocol.connection_lost

            def data_received(data):
                out, goes_on = altered.feed(data)
                if out:
                    receive(out)
                if not goes_on:
                    protocol.data_received = lambda data: None
                    protocol.eof_received = protocol.connection_lost = lambda *_: None
                    open_ends.append(protocol.transport)
                    lose(None)

            protocol.data_received = data_received
            return protocol

        return await connect(make, host, port, **options)

    loop.create_connection = create_connection
    return open_ends


class Proxy:
    """Between a client and a controller's three ports, on loopback."""

    def __init__(self, controller, alter):
        self._alter, self._controller = alter, controller
        self._sockets = []
        self._servers = {n: socket.create_server(("127.0.0.1", 0)) for n in controller.ports}
        for name in self._servers:
            threading.Thread(target=self._accept, args=(name,), daemon=True).start()

    @property
    def address(self):
        numbers = {name: server.getsockname()[1] for name, server in self._servers.items()}
        control = numbers["control"] if self._controller.script.control else 0
        return f"127.0.0.1:{numbers['motion']},{numbers['state']},{control}"

    def close(self):
        for one in (*self._servers.values(), *self._sockets):
            with contextlib.suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
            one.close()

    def _accept(self, name):
        while True:
            try:
                client, _ = self._servers[name].accept()
            except OSError:
                return
            there = socket.create_connection(("127.0.0.1", self._controller.ports[name]))
            self._sockets += [client, there]
            for ends in ((client, there, None), (there, client, Altered(name, self._alter))):
                threading.Thread(target=self._pump, args=ends, daemon=True).start()

    @staticmethod
    def _pump(source, sink, altered):
        with contextlib.suppress(OSError):
            while data := source.recv(65536):
                out, goes_on = (data, True) if altered is None else altered.feed(data)
                sink.sendall(out)
                if not goes_on:
                    sink.shutdown(socket.SHUT_RDWR)
                    return
            sink.shutdown(socket.SHUT_RDWR)
