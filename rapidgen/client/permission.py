"""Permission to move a robot: automatic for loopback, else by name.

The first run of a trajectory on a real host is slow unless a speed was given. Trajectories that
have run there are stored by hash in the user's state folder.
"""

import os
from hashlib import sha256
from pathlib import Path

from rapidgen._reading import read_foreign
from rapidgen.client.address import Address
from rapidgen.client.errors import NotReady
from rapidgen.client.trajectory import Trajectory

_LARGEST = 100_000_000
"""Largest size of the stored list, bytes."""
FIRST_SPEED = 0.1
"""Share of the commanded speed for a trajectory new to a real host."""


def need_confirmation(address: Address, *, yes: bool, real_robot: str) -> bool:
    """True if the user must confirm the motion.

    Raises NotReady (RG640) if the host is not this machine and was not repeated.
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
    """FIRST_SPEED if this trajectory never ended on this host, else 1.

    None: a trajectory computed for this call.
    """
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
    """Record that this trajectory ran to its end on this host.

    Raises OSError.
    """
    path = _memory()
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="ascii") as file:
        file.write(_key(address, trajectory) + "\n")
