"""Where a robot is: `HOST`, `HOST:MOTION,STATE` or a configuration's ports."""

import ipaddress
import re
from dataclasses import dataclass

from rapidgen.client.errors import fault
from rapidgen.config.model import Ports
from rapidgen.diagnostics import DiagnosticError
from rapidgen.protocol.spec import Port

_FORM = re.compile(r"(?P<host>\[[^\]]+\]|[^:\[\],]+)(?::(?P<motion>\d+)(?:,(?P<state>\d+))?)?")
LOOPBACK = "127.0.0.1"


@dataclass(frozen=True, slots=True)
class Address:
    """A host with the ports of one motion group."""

    host: str
    motion: int = int(Port.MOTION)
    state: int = int(Port.STATE)
    control: int = int(Port.CONTROL)

    def __str__(self) -> str:
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{host}:{self.motion},{self.state}"

    def port(self, which: Port) -> int:
        """The number of a port of this group."""
        return {Port.MOTION: self.motion, Port.STATE: self.state, Port.CONTROL: self.control}[which]

    @property
    def is_loopback(self) -> bool:
        """Whether the host is this machine for certain: no name is looked up but `localhost`."""
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False


def parse_address(text: str, ports: Ports | None = None) -> Address:
    """`HOST[:MOTION[,STATE]]`; what is not said is taken from `ports`.

    A lone motion port is followed by the state port two above it, as 11000 by 11002. Raises
    DiagnosticError (RG607).
    """
    found = _FORM.fullmatch(text.strip())
    own = ports or Ports()
    if found:
        host = found["host"].strip("[]")
        motion = int(found["motion"] or own.motion)
        state = int(found["state"] or (motion + 2 if found["motion"] else own.state))
        control = own.control if not found["motion"] else motion + 1
        if all(0 < port < 65536 for port in (motion, state)):
            return Address(host, motion, state, min(control, 65535))
    raise DiagnosticError(
        fault(
            "RG607",
            f"'{text}' is no address of a robot",
            "HOST, HOST:MOTION or HOST:MOTION,STATE, for example 192.168.125.1:11000,11002",
        )
    )
