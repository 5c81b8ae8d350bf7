"""Events that a robot writes by itself. Numbers from 195900 on are ours: ABB's are not public."""

from rapidgen.machine.event_log import EventLog
from rapidgen.motion.moves import Move, Place

CORNER_PATH_FAILURE = 50_024
TIME_NOT_MET = 195_901
OVERLOAD = 195_902


def corner_failure(log: EventLog, task: str, move: Move) -> None:
    """Event 50024: the end of a move is a stop point although it has a zone.

    Its arguments are those of saved logs: the task and the place.
    """
    where = move.place() if move.place is not None else None
    log.record(
        CORNER_PATH_FAILURE,
        task,
        where.reference if where is not None else "",
        task=task,
        span=where.span if where is not None else None,
    )


def overload(log: EventLog, name: str, text: str, where: Place | None) -> None:
    """Event 195902: a group carries more than its payload."""
    log.record(
        OVERLOAD,
        f"{name}: {text}",
        span=where.span if where is not None else None,
        texts=(where.reference,) if where is not None else (),
    )
