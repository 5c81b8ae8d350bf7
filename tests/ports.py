"""Ports for programs that have to be told one, before anybody listens there."""

import random
import socket

GIVEN_AWAY = 32_768
"""Where Linux begins to give ports away to whoever binds 0 or connects (ip_local_port_range)."""


def free_port() -> int:
    """A port of loopback that nobody has, and that the system gives to nobody.

    One that was bound to 0 and let go can be another test's a moment later: its server then
    answers in place of the one that is awaited.
    """
    while True:
        port = random.randrange(15_000, GIVEN_AWAY)
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
