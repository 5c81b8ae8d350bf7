"""Where a robot is: `HOST`, `HOST:MOTION,STATE[,CONTROL]` or a configuration's ports."""

import ipaddress
import re
from dataclasses import dataclass

from rapidgen.client.errors import ConnectionFailed, InvalidTarget
from rapidgen.config.model import Ports
from rapidgen.wire.simple_message.spec import Port

_FORM = re.compile(
    # An IPv6 address, or a name whose parts are as long as names may be.
    r"(?P<host>\[[0-9A-Fa-f:.%\w-]+\]|(?=[^:]{1,253}(?::|$))\w[\w-]{0,62}(?:\.\w[\w-]{0,62})*)"
    r"(?::(?P<motion>\d{1,5})(?:,(?P<state>\d{1,5})(?:,(?P<control>\d{1,5}))?)?)?",
    re.ASCII,
)
LOOPBACK = "127.0.0.1"


@dataclass(frozen=True, slots=True)
class Address:
    """A host with the ports of one motion group; `control` 0: none, or nobody knows which."""

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
        """The number of a port of this group. Raises ConnectionFailed where nobody knows it."""
        number = {Port.MOTION: self.motion, Port.STATE: self.state, Port.CONTROL: self.control}[
            which
        ]
        if not number:
            raise ConnectionFailed.because(
                "RG601",
                f"nobody knows the {which.name.lower()} port of {self}",
                "tell it too: HOST:MOTION,STATE,CONTROL",
            )
        return number

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
    """`HOST[:MOTION[,STATE[,CONTROL]]]`; what is not said is taken from `ports`.

    A lone motion port is followed by the state port two above it, as 11000 by 11002. The control
    port moves along with the others: where they are moved alike it is too, else it is not known.
    Raises InvalidTarget (RG607).
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
        f"'{text}' is no address of a robot",
        "HOST, HOST:MOTION, HOST:MOTION,STATE or HOST:MOTION,STATE,CONTROL, for example "
        "192.168.125.1:11000,11002",
        exit_code=2,
    )


def _control(own: Ports, motion: int, state: int) -> int:
    """The control port behind a motion and a state port, 0: nobody knows."""
    moved = motion - own.motion
    if not own.control or state - own.state != moved:
        return 0
    control = own.control + moved
    return control if 0 < control < 65536 else 0
