"""Digits in the header line of a cfg file, by release and domain.

A controller rejects a file with other digits with event 120003 [real 6.03, MCUBE]. Between
RobotWare 5.15 and 5.61 the digits of EIO and SIO changed; 60 reads like the release that brought
it. The releases between count as the later one, which no controller has confirmed [mem].
"""

from typing import Literal

Domain = Literal["SYS", "EIO", "SIO", "MOC", "MMC", "PROC"]
DOMAINS: tuple[Domain, ...] = ("SYS", "EIO", "SIO", "MOC", "MMC", "PROC")
_CHANGED_IN_5 = 60
_OF_DEVICES: tuple[Domain, ...] = ("EIO", "SIO")


def header_digits(robotware: tuple[int, int], domain: Domain) -> tuple[int, int]:
    """Return the digits that a controller of this release requires.

    5.15: KRAKER; 5.61: MCUBE 2017-04-13; 6.03 to 6.14: all backups; 7.6: a GoFa's backup.
    """
    main, release = robotware
    if domain in _OF_DEVICES:
        if main == 5:
            return 5, 60 if release >= _CHANGED_IN_5 else 0
        if main == 6:
            return 6, 1
    return main, 0
