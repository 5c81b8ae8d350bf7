"""Events that a robot writes by itself. Numbers from 195900 on are ours: ABB's are not public."""

from rapidgen.machine.event_log import EventLog
from rapidgen.motion.moves import Move

CORNER_PATH_FAILURE = 50_024
TIME_NOT_MET = 195_901
OVERLOAD = 195_902


def corner_failure(log: EventLog, name: str, move: Move) -> None:
    """Event 50024: the end of a move of a group is a stop point although it has a zone."""
    where = move.place() if move.place is not None else None
    log.warning(
        CORNER_PATH_FAILURE,
        "Corner path failure",
        f"{name}: the corner is executed as a stop point" + (f" ({where})" if where else ""),
        "the next move was not planned in time",
    )


def overload(log: EventLog, name: str, text: str, where: object) -> None:
    """Event 195902: a group carries more than its payload."""
    place = f" ({where})" if where else ""
    log.warning(OVERLOAD, "Load above the payload of the robot", f"{name}: {text}{place}")
