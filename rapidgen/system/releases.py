"""Header digits of a cfg file, by release of RobotWare and domain.

A controller rejects a file with other digits with event 120003 (log of a controller with RobotWare
6.03). Sources: backups of 5.15, 5.61 and 6.03 to 6.14, files that ABB ships for RobotWare 7.
"""

from collections.abc import Mapping

from rapidgen.diagnostics import refusal

UNKNOWN_ROBOTWARE = (6, 0)
"""Some RobotWare 6 of unknown minor version."""
ANY_MINOR = 99
"""Minor version that means all of a release line."""
_SAME: Mapping[tuple[int, str], tuple[int, int]] = {
    (5, "SYS"): (5, 0),
    (5, "MOC"): (5, 0),
    (6, "SYS"): (6, 0),
    (6, "EIO"): (6, 1),
    (6, "SIO"): (6, 1),
    (6, "MOC"): (6, 0),
    (7, "SYS"): (7, 0),
    (7, "EIO"): (7, 0),
    (7, "SIO"): (7, 0),
    (7, "MOC"): (7, 0),
}
"""Domains with the same digits in every known release of a number."""
_SEEN: Mapping[tuple[int, int, str], tuple[int, int]] = {
    (5, 15, "EIO"): (5, 0),
    (5, 15, "SIO"): (5, 0),
    (5, 61, "EIO"): (5, 60),
    (5, 61, "SIO"): (5, 60),
}
"""Domains whose digits differ between releases of one number."""


def known_digits(domain: str, robotware: tuple[int, int]) -> tuple[int, int] | None:
    """Return the header digits of a domain, or None if not known."""
    major, minor = robotware
    return _SAME.get((major, domain)) or _SEEN.get((major, minor, domain))


def digits(domain: str, robotware: tuple[int, int]) -> tuple[int, int]:
    """Return the header digits, with a default for unknown ones.

    For text that no controller loads.
    """
    return known_digits(domain, robotware) or (robotware[0], 0)


def release(text: str) -> tuple[int, int]:
    """Parse a release: 6.15, or 6, which means all of that line.

    The minor version is 99 then. Raises DiagnosticError RG901.
    """
    major, dot, minor = text.partition(".")
    numbers = major.isdecimal() and (minor.isdecimal() or not dot)
    if not numbers or not 5 <= int(major) <= 8:
        raise refusal(
            "RG901",
            None,
            f"'{text}' is not a RobotWare version",
            "give 5, 6, 7 or 8, with a minor version if it matters: 6.15",
        )
    return int(major), int(minor) if minor else ANY_MINOR
