"""May this program move that robot? Loopback is a simulation; anything else is said by name.

A first run of a trajectory on a real host is slow unless a speed was told: what has run there
before is remembered by hash in the user's state folder.
"""

import os
from hashlib import sha256
from pathlib import Path

from rapidgen._reading import read_foreign
from rapidgen.client.address import Address
from rapidgen.client.errors import NotReady
from rapidgen.client.trajectory import Trajectory

_LARGEST = 100_000_000
"""Bytes of what is remembered."""
FIRST_SPEED = 0.1
"""Share of the asked speed for a trajectory that never ran on a real host."""


def need_confirmation(address: Address, *, yes: bool, real_robot: str) -> bool:
    """Whether somebody must still be asked.

    Raises NotReady (RG640) when the host is not this machine and was not repeated.
    """
    if address.is_loopback:
        return not yes
    if real_robot != address.host:
        message = f", not {real_robot}" if real_robot else ""
        raise NotReady.because(
            "RG640",
            f"{address.host} may be a real robot{message}: nothing was sent",
            f"when the area is clear: --move-real-robot {address.host}",
            "--yes answers on this machine only",
            exit_code=2,
        )
    return False


def _memory() -> Path:
    base = os.environ.get("XDG_STATE_HOME") or str(Path.home() / ".local" / "state")
    return Path(base) / "rapidgen" / "moved"


def _key(address: Address, trajectory: Trajectory) -> str:
    content = sha256(f"{address.host}\n{','.join(trajectory.names)}\n".encode())
    content.update(trajectory.times.tobytes())
    content.update(trajectory.positions.tobytes())
    return content.hexdigest()[:32]


def first_speed(address: Address, trajectory: Trajectory | None) -> float:
    """FIRST_SPEED when this trajectory never ran to its end on this host, 1 otherwise; None: one
    that is made on the spot."""
    if address.is_loopback:
        return 1.0
    if trajectory is None:
        return FIRST_SPEED
    try:
        known = read_foreign(_memory(), _LARGEST).decode("ascii").split()
    except (OSError, UnicodeDecodeError):
        known = []
    return 1.0 if _key(address, trajectory) in known else FIRST_SPEED


def remember(address: Address, trajectory: Trajectory) -> None:
    """This trajectory ran to its end on this host. Raises OSError."""
    path = _memory()
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="ascii") as file:
        file.write(_key(address, trajectory) + "\n")
