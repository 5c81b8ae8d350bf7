"""Which RobotWare a text is for."""

from dataclasses import dataclass

from rapidgen.system.releases import UNKNOWN_ROBOTWARE


@dataclass(frozen=True, slots=True)
class Dialect:
    """The RobotWare version that decides what exists: (major, minor)."""

    robotware: tuple[int, int] = UNKNOWN_ROBOTWARE
    some: bool = False
    """Some release of that number, as of a backup that does not say which."""

    @property
    def told(self) -> bool:
        """Whether the release is known. Where it is not, what another one brings is no fault."""
        return self.robotware != UNKNOWN_ROBOTWARE and not self.some

    @property
    def has_radix(self) -> bool:
        """0x, 0o and 0b numbers: not in K (RobotWare 5.0)."""
        return self.robotware >= (6, 0)

    @property
    def has_dnum(self) -> bool:
        """The type dnum came within RobotWare 5."""
        return self.some or self.robotware >= (5, 12)
