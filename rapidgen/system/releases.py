"""What the first line of a cfg file says for a release of RobotWare: the digits of its domain.

A file whose digits are not those of the controller is refused with event 120003 (log of a
controller with RobotWare 6.03). Sources: backups of 5.15, 5.61 and 6.03 to 6.14, files that ABB
ships for RobotWare 7.
"""

from collections.abc import Mapping

from rapidgen.diagnostics import refusal

UNTOLD = (6, 0)
"""Some RobotWare 6; nobody has said which."""
ANY_MINOR = 99
"""Of a release: all of its line."""
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
"""Domains that begin alike in every release of a number that was seen."""
_SEEN: Mapping[tuple[int, int, str], tuple[int, int]] = {
    (5, 15, "EIO"): (5, 0),
    (5, 15, "SIO"): (5, 0),
    (5, 61, "EIO"): (5, 60),
    (5, 61, "SIO"): (5, 60),
}
"""Domains in which releases of one number differ."""


def known_digits(domain: str, robotware: tuple[int, int]) -> tuple[int, int] | None:
    """The digits in the header of a domain's file, or None where no such file was seen."""
    major, minor = robotware
    return _SAME.get((major, domain)) or _SEEN.get((major, minor, domain))


def digits(domain: str, robotware: tuple[int, int]) -> tuple[int, int]:
    """The same for text that no controller loads: what is not known is taken as the plain one."""
    return known_digits(domain, robotware) or (robotware[0], 0)


def release(text: str) -> tuple[int, int]:
    """A release as people write it: 6.15, or 6, which means all of that line (minor 99).

    Raises DiagnosticError RG901.
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
