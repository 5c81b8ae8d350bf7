"""Externally guided motion of a controller without a partner.

It covers identities and their sessions. No datagram is sent or read, and no position corrected.
"""

from dataclasses import dataclass, field
from typing import Final, Literal, TypeAlias

from rapidgen.machine.scheduler import Timer, WaitSet
from rapidgen.system.model import UdpDevice

MAX_IDENTITIES: Final = 4
"""At a time [manual 3HAC073318 5.2]."""
Guidance: TypeAlias = Literal["Joint", "Pose", "PathCorr"]


@dataclass(slots=True, eq=False)
class EgmSession:
    """Session of an identity, from EGMGetId to EGMReset."""

    task: str
    guidance: Guidance | None = None
    """Guidance of the set-up; None: streaming alone, or no set-up."""
    device: UdpDevice | None = None
    comm_timeout: float | None = None
    """Seconds without a datagram after which there is no communication; None: never."""
    active: Guidance | None = None
    """Guidance of the activation."""
    streaming: bool = False
    """Positions would go out."""
    guided: bool = False
    """Positions would come in: from EGMRunJoint or EGMRunPose on."""
    changed: WaitSet = field(default_factory=WaitSet)
    limit: Timer | None = None
    """Of a run that the program does not wait for."""

    @property
    def running(self) -> bool:
        """True in EGM_STATE_RUNNING; otherwise connected."""
        return self.streaming or self.guided

    @property
    def partner(self) -> str:
        """Name of the expected partner."""
        return str(self.device)

    def end(self) -> None:
        """End guidance and streaming.

        EGMStop and the end of EGMRunJoint have this effect.
        """
        self.streaming = self.guided = False
        if self.limit is not None:
            self.limit.cancel()
            self.limit = None
        self.changed.notify()


class EgmSessions:
    """Identities of a controller; `devices` None: unknown configuration."""

    def __init__(self, devices: tuple[UdpDevice, ...] | None) -> None:
        self._devices = devices
        self._sessions: list[EgmSession] = []

    def device(self, name: str) -> UdpDevice | None:
        """Return a device by name, None if unknown.

        Programs may append a colon.
        """
        expected = name.removesuffix(":")
        if self._devices is None:
            return UdpDevice(expected)
        return next((d for d in self._devices if d.name.lower() == expected.lower()), None)

    def take(self, task: str) -> EgmSession | None:
        """Return a new session, None if all identities are in use."""
        if len(self._sessions) >= MAX_IDENTITIES:
            return None
        self._sessions.append(EgmSession(task))
        return self._sessions[-1]

    def free(self, session: EgmSession) -> None:
        """Release the identity of a session."""
        session.end()
        if session in self._sessions:
            self._sessions.remove(session)

    def close_task(self, task: str) -> None:
        """Release all identities of a task."""
        for session in [s for s in self._sessions if s.task == task]:
            self.free(session)
