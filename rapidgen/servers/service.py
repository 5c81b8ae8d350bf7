"""Parts common to the servers: the caller's handle, the loopback rule."""

import ipaddress
import logging
from collections.abc import Callable
from dataclasses import dataclass, field

from rapidgen.diagnostics import DiagnosticError, refusal

_LOG = logging.getLogger("rapidgen.servers")


@dataclass(frozen=True, slots=True)
class Service:
    """A running server.

    `host_key` is the `known_hosts` line of an SFTP server, else empty.
    """

    host: str
    port: int
    user: str
    password: str = field(repr=False)
    host_key: str
    _stop: Callable[[], None] = field(repr=False)

    def __post_init__(self) -> None:
        _LOG.info("%s:%d is served to %s", self.host, self.port, self.user)

    def close(self) -> None:
        """Close the port and every connection; a second call does nothing."""
        self._stop()


def loopback(host: str) -> str:
    """Return `host` as a numeric loopback address.

    Raises DiagnosticError RG560: a virtual controller's files are never offered to a network.
    """
    name = "127.0.0.1" if host == "localhost" else host
    try:
        address = ipaddress.ip_address(name)
    except ValueError:
        address = None
    if address is None or not address.is_loopback:
        raise refusal(
            "RG560",
            None,
            f"the servers of a virtual controller listen on loopback only, not on {host}",
            "use --host 127.0.0.1, or leave out --ftp and --sftp; --rws wants a RAPIDGEN_PASSWORD",
        )
    return name


def in_use(host: str, port: int, error: OSError) -> DiagnosticError:
    """Return RG561: the port is not available."""
    return refusal(
        "RG561",
        None,
        f"cannot serve files at {host}:{port}: {error.strerror or error}",
        "name another port, or 0 for any free one",
        exit_code=1,
    )
