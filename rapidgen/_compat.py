"""Names of `enum` and `typing` from Python 3.11, also for 3.10.

3.10 is Python of Ubuntu 22.04 with ROS 2 Humble. Only cheap imports: STOP has to be sent before any
other module is loaded.
"""

import sys

if sys.version_info >= (3, 11):
    from enum import StrEnum
    from typing import Never, Self, Unpack
else:
    from enum import Enum

    from typing_extensions import Never, Self, Unpack

    class StrEnum(str, Enum):
        """Members are their text, printed and formatted too."""

        __str__ = str.__str__

        def __format__(self, format_spec: str) -> str:
            return str.__format__(self, format_spec)


__all__ = ["Never", "Self", "StrEnum", "Unpack"]
