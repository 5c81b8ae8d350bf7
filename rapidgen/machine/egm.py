"""Externally guided motion as far as a controller has it whose partner is silent.

Identities, and the sessions behind them. No datagram is sent or read, and no position corrected.
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
    """What stands behind an identity, from EGMGetId to EGMReset."""

    task: str
    guidance: Guidance | None = None
    """What it was set up for; None: for streaming alone, or not at all."""
    device: UdpDevice | None = None
    patience: float | None = None
    """Seconds without a datagram after which there is no communication; None: never."""
    active: Guidance | None = None
    """What it was activated for."""
    streaming: bool = False
    """Positions would go out."""
    guided: bool = False
    """Positions would come in: from EGMRunJoint or EGMRunPose on."""
    changed: WaitSet = field(default_factory=WaitSet)
    limit: Timer | None = None
    """Of a run that the program does not wait for."""

    @property
    def running(self) -> bool:
        """EGM_STATE_RUNNING; else it is connected."""
        return self.streaming or self.guided

    @property
    def partner(self) -> str:
        """Who would have to answer."""
        return str(self.device)

    def end(self) -> None:
        """Guiding and streaming are over, as after EGMStop and at the end of EGMRunJoint."""
        self.streaming = self.guided = False
        if self.limit is not None:
            self.limit.cancel()
            self.limit = None
        self.changed.notify()


class EgmSessions:
    """The identities of a controller. `devices` None: its configuration is not known."""

    def __init__(self, devices: tuple[UdpDevice, ...] | None) -> None:
        self._devices = devices
        self._sessions: list[EgmSession] = []

    def device(self, name: str) -> UdpDevice | None:
        """A device by its name, behind which programs may write a colon; None: there is none."""
        expected = name.removesuffix(":")
        if self._devices is None:
            return UdpDevice(expected)
        return next((d for d in self._devices if d.name.lower() == expected.lower()), None)

    def take(self, task: str) -> EgmSession | None:
        """A new session; None: all identities are in use."""
        if len(self._sessions) >= MAX_IDENTITIES:
            return None
        self._sessions.append(EgmSession(task))
        return self._sessions[-1]

    def free(self, session: EgmSession) -> None:
        """Its identity can be taken again."""
        session.end()
        if session in self._sessions:
            self._sessions.remove(session)

    def close_task(self, task: str) -> None:
        """Those of a task are free: its variables begin anew."""
        for session in [s for s in self._sessions if s.task == task]:
            self.free(session)
