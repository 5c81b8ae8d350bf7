"""What `enum` and `typing` gained in Python 3.11, on 3.10 too (Ubuntu 22.04, ROS 2 Humble).

Only what costs nothing to import: STOP has to be on the wire before anything else is loaded.
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
