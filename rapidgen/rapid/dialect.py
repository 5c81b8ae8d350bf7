"""RobotWare version of a text, and the encoding of its file."""

from dataclasses import dataclass

from rapidgen.system.releases import UNKNOWN_ROBOTWARE


@dataclass(frozen=True, slots=True)
class Dialect:
    """The RobotWare version that decides what exists: (major, minor)."""

    robotware: tuple[int, int] = UNKNOWN_ROBOTWARE
    some: bool = False
    """Any release of that number, as of a backup without an exact version."""
    encoding: str = "latin-1"
    """Encoding of files that are not UTF-8; of a file that it does not fit: Latin-1."""

    @property
    def is_known(self) -> bool:
        """True if the release is known.

        With an unknown release, features of other releases are not errors.
        """
        return self.robotware != UNKNOWN_ROBOTWARE and not self.some

    @property
    def has_radix(self) -> bool:
        """True for 0x, 0o and 0b numbers: not in K (RobotWare 5.0)."""
        return self.robotware >= (6, 0)

    @property
    def has_dnum(self) -> bool:
        """True for the type dnum, which RobotWare 5 introduced."""
        return self.some or self.robotware >= (5, 12)
