"""The controller's date and time of day.

On the real clock it is the machine's. On the virtual clock it is a fixed day plus the simulated
time, so that a run is the same every time.
"""

from datetime import datetime, timedelta

from rapidgen.virtual.kernel import Kernel

FIRST_DAY = datetime(2026, 1, 1, 8)


def date_time(kernel: Kernel) -> datetime:
    """Now, as the controller shows it."""
    if kernel.clock == "real":
        return datetime.now()
    return FIRST_DAY + timedelta(microseconds=kernel.now // 1000)
