"""SearchL and SearchC: a move that watches a signal.

Source: S4 datasys 2-SearchL. \\Stop brakes hard, \\PStop and \\SStop on the path as a normal
stop, without a switch and with \\Sup the robot goes on to its target. The move ends in a stop
point, the point of the hit is where the TCP was when the signal changed.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from rapidgen.virtual.errors import RapidError
from rapidgen.virtual.io import AnySignal
from rapidgen.virtual.kernel import WaitSet
from rapidgen.virtual.motion.group import MotionGroup
from rapidgen.virtual.motion.moves import Move, Posture
from rapidgen.virtual.motion.request import Request
from rapidgen.virtual.motion.targets import rob_target
from rapidgen.virtual.registry import builtin
from rapidgen.virtual.task import Task
from rapidgen.virtual.values import Ref

Data: TypeAlias = Any
_REASON = "search"


@dataclass(frozen=True, slots=True)
class _Edges:
    """Which changes count."""

    rising: bool
    falling: bool
    level: bool | None = None
    """A value that counts as a hit already at the start."""
    supervised: bool = False
    """A signal that is already 1 at the start is an error."""


@dataclass(slots=True)
class _Hits:
    group: MotionGroup
    edges: _Edges
    read: Callable[[], bool]
    halt: Callable[[], None] | None
    last: bool = False
    found: list[Posture] = field(default_factory=list)

    def changed(self) -> None:
        """The watched thing has changed."""
        now = self.read()
        before, self.last = self.last, now
        if (now and not before and self.edges.rising) or (
            before and not now and self.edges.falling
        ):
            self.hit()

    def hit(self) -> None:
        """Keep the place, and stop when that is wanted."""
        self.found.append(self.group.positions())
        if self.halt is not None and len(self.found) == 1:
            self.halt()


def _edges(
    both: bool | None,
    rising: bool | None,
    falling: bool | None,
    high: bool | None,
    low: bool | None,
) -> _Edges:
    if both:
        return _Edges(True, True)
    if rising:
        return _Edges(True, False)
    if falling:
        return _Edges(False, True)
    if high:
        return _Edges(True, False, level=True)
    if low:
        return _Edges(False, True, level=False)
    return _Edges(True, False, supervised=True)


def _source(signal: AnySignal | None, flag: Ref | None) -> tuple[WaitSet, Callable[[], bool]]:
    """What to watch, and how to read it."""
    if signal is not None:
        source = signal.signal
        return source.changed, lambda: bool(source.value)
    if flag is None or flag.cell is None:
        raise RapidError("ERR_ARGNOTPER", "PersBool")
    cell = flag.cell
    return cell, lambda: bool(cell.v)


def _search(
    task: Task,
    group: MotionGroup,
    move: Move,
    watched: tuple[AnySignal | None, Ref | None],
    edges: _Edges,
    stops: tuple[bool | None, bool | None, bool | None, bool | None],
    point: Ref,
) -> None:
    hard, on_path, soft, supervised = stops
    signal, flag = watched
    change, read = _source(signal, flag)
    halting = bool(hard or on_path or soft)
    hits = _Hits(
        group,
        edges,
        read,
        (lambda: group.stop(_REASON, quick=bool(hard))) if halting else None,
        read(),
    )
    if edges.supervised and hits.last:
        raise RapidError("ERR_SIGSUPSEARCH")
    leg = group.enqueue(move)
    if edges.level is not None and hits.last == edges.level:
        hits.hit()
    change.add(hits.changed)
    try:
        if leg is not None:
            group.wait(
                task,
                leg,
                lambda: (
                    (leg.finished and group.is_settled)
                    or (halting and bool(hits.found) and group.is_settled)
                ),
            )
    finally:
        change.remove(hits.changed)
        if halting and hits.found:
            group.clear_path()
        group.start(_REASON)
    if not hits.found or (supervised and len(hits.found) > 1):
        raise RapidError("ERR_WHLSEARCH", f"{len(hits.found)} hits")
    point.set(rob_target(group, hits.found[0], move.carrier))


@builtin("SearchL", cost="move")
def search_l(
    task: Task,
    hard: bool | None,
    on_path: bool | None,
    soft: bool | None,
    supervised: bool | None,
    signal: AnySignal | None,
    flag: Ref | None,
    both: bool | None,
    rising: bool | None,
    falling: bool | None,
    high: bool | None,
    low: bool | None,
    point: Ref,
    to: Data,
    _identity: float | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    tool: Ref,
    work_object: Ref | None,
    _correction: bool | None,
    _load: Ref | None,
) -> None:
    """Searches along a line."""
    request = Request(
        speed=speed, tool=tool, work_object=work_object, tcp_speed=tcp_speed, time=time
    )
    group, move = request.cartesian(task, to)
    edges = _edges(both, rising, falling, high, low)
    stops = (hard, on_path, soft, supervised)
    _search(task, group, move, (signal, flag), edges, stops, point)


@builtin("SearchC", cost="move")
def search_c(
    task: Task,
    hard: bool | None,
    on_path: bool | None,
    soft: bool | None,
    supervised: bool | None,
    signal: AnySignal | None,
    flag: Ref | None,
    both: bool | None,
    rising: bool | None,
    falling: bool | None,
    high: bool | None,
    low: bool | None,
    point: Ref,
    via: Data,
    to: Data,
    _identity: float | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    tool: Ref,
    work_object: Ref | None,
    _correction: bool | None,
    _load: Ref | None,
) -> None:
    """Searches along a circle."""
    request = Request(
        speed=speed, tool=tool, work_object=work_object, tcp_speed=tcp_speed, time=time
    )
    group, move = request.cartesian(task, to, via)
    edges = _edges(both, rising, falling, high, low)
    stops = (hard, on_path, soft, supervised)
    _search(task, group, move, (signal, flag), edges, stops, point)
