"""Free ports for programs that need a port number in advance."""

import random
import socket

GIVEN_AWAY = 32_768
"""First port that Linux assigns for port 0 and outgoing connections (ip_local_port_range)."""


def own_address() -> str:
    """An unused loopback address, for a server to which thousands of connections are made.

    One that is closed keeps its port, at its address, for a minute: at 127.0.0.1 three runs of
    tests/deploy side by side had 26,000 of the 28,000.
    """
    return f"127.{random.randrange(1, 255)}.{random.randrange(256)}.{random.randrange(1, 255)}"


def free_port(adjacent: int = 0) -> int:
    """Return a free loopback port that the system does not assign; so are the next
    `adjacent` ones.

    One that was bound to 0 and let go can be another test's a moment later: its server then
    answers in place of the one that is awaited.
    """
    while True:
        port = random.randrange(15_000, GIVEN_AWAY - adjacent)
        if all(_is_free(each) for each in range(port, port + adjacent + 1)):
            return port


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True
