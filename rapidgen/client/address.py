"""Address of a robot: `HOST`, `HOST:MOTION,STATE[,CONTROL]`.

Ports that the address does not name come from the configuration.
"""

import ipaddress
import re
from dataclasses import dataclass

from rapidgen.client.errors import ConnectionFailed, InvalidTarget
from rapidgen.config.model import Ports
from rapidgen.wire.simple_message.spec import Port

_FORM = re.compile(
    # An IPv6 address, or a host name with labels of at most the permitted length.
    r"(?P<host>\[[0-9A-Fa-f:.%\w-]+\]|(?=[^:]{1,253}(?::|$))\w[\w-]{0,62}(?:\.\w[\w-]{0,62})*)"
    r"(?::(?P<motion>\d{1,5})(?:,(?P<state>\d{1,5})(?:,(?P<control>\d{1,5}))?)?)?",
    re.ASCII,
)
LOOPBACK = "127.0.0.1"


@dataclass(frozen=True, slots=True)
class Address:
    """A host with the ports of one motion group.

    `control` is 0 if there is no control port or its number is unknown.
    """

    host: str
    motion: int = int(Port.MOTION)
    state: int = int(Port.STATE)
    control: int = int(Port.CONTROL)

    def __str__(self) -> str:
        host = f"[{self.host}]" if ":" in self.host else self.host
        usual = self.motion + 1 if self.state == self.motion + 2 else 0
        control = "" if self.control == usual else f",{self.control}"
        return f"{host}:{self.motion},{self.state}{control}"

    def port(self, which: Port) -> int:
        """Return a port of this group. Raises ConnectionFailed if it is unknown."""
        number = {Port.MOTION: self.motion, Port.STATE: self.state, Port.CONTROL: self.control}[
            which
        ]
        if not number:
            raise ConnectionFailed.because(
                "RG601",
                f"the {which.name.lower()} port of {self} is unknown",
                "give its number: HOST:MOTION,STATE,CONTROL",
            )
        return number

    @property
    def is_loopback(self) -> bool:
        """True if the host is certainly this machine.

        Resolves no host name; `localhost` is recognised by its text.
        """
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False


def parse_address(text: str, ports: Ports | None = None) -> Address:
    """Parse `HOST[:MOTION[,STATE[,CONTROL]]]`; `ports` fills the gaps.

    A single motion port is followed by the state port two above it, as 11000 by 11002. The control
    port moves with the others if both have moved by the same amount, else it is unknown. Raises
    InvalidTarget (RG607).
    """
    match = _FORM.fullmatch(text.strip())
    own = ports or Ports()
    if match:
        host = match["host"].strip("[]")
        motion = int(match["motion"] or own.motion)
        state = int(match["state"] or (motion + 2 if match["motion"] else own.state))
        control = _control(own, motion, state) if match["control"] is None else match["control"]
        if all(0 < port < 65536 for port in (motion, state)) and 0 <= int(control) < 65536:
            return Address(host, motion, state, int(control))
    raise InvalidTarget.because(
        "RG607",
        f"'{text}' is not an address of a robot",
        "HOST, HOST:MOTION, HOST:MOTION,STATE or HOST:MOTION,STATE,CONTROL, for example "
        "192.168.125.1:11000,11002",
        exit_code=2,
    )


def _control(own: Ports, motion: int, state: int) -> int:
    """Infer the control port from motion and state port; 0 if unknown."""
    moved = motion - own.motion
    if not own.control or state - own.state != moved:
        return 0
    control = own.control + moved
    return control if 0 < control < 65536 else 0
