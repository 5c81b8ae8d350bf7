"""The controller's date and time of day.

On the real clock it is the machine's. On the virtual clock it is a fixed day plus the simulated
time, so that a run is the same every time.
"""

from datetime import datetime, timedelta

from rapidgen.machine.scheduler import Scheduler

FIRST_DAY = datetime(2026, 1, 1, 8)


def date_time(scheduler: Scheduler) -> datetime:
    """Now, as the controller shows it."""
    if scheduler.clock == "real":
        return datetime.now()
    return FIRST_DAY + timedelta(microseconds=scheduler.now // 1000)
