"""Instructions that order interrupts.

Sources: K §8; S4 datasys 2-ISignalDI, 2-ITimer, 2-IDisable; 1A/184 IPers.
"""

from collections.abc import Callable

from rapidgen.machine.event_log import Event
from rapidgen.rapid.numbers import single as as_num
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.signals import AnySignal
from rapidgen.runtime.task.interrupts import Interrupt
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import PersistentCell, Ref, copy_value, register_type

SHORTEST_TIMER = 0.1
SHORTEST_SINGLE_TIMER = 0.01
"""Seconds; a shorter one is an error (switch `shortest_timer`)."""
_FINEST_TIMER = 0.001
"""Seconds that a clock of the controller resolves."""
EDGE = 2


class TrapData:
    """The result of GetTrapData."""

    __slots__ = ("event",)

    def __init__(self) -> None:
        self.event: Event | None = None


register_type("trapdata", TrapData)


@builtin("ISleep")
def i_sleep(task: Task, interrupt: Ref) -> None:
    """ISleep: ignore events until IWatch.

    Not permitted for safe interrupts.
    """
    match = task.interrupts.find(interrupt.get())
    if match.safe:
        raise RapidError("ERR_INOISSAFE")
    match.asleep = True


@builtin("IWatch")
def i_watch(task: Task, interrupt: Ref) -> None:
    """IWatch: stop ignoring events."""
    task.interrupts.find(interrupt.get()).asleep = False


@builtin("IDelete")
def i_delete(task: Task, interrupt: Ref) -> None:
    """IDelete: remove an interrupt's order and connection.

    Does nothing for a number that is not connected.
    """
    task.interrupts.delete(interrupt.get())
    interrupt.set(0)


@builtin("IDisable")
def i_disable(task: Task) -> None:
    """IDisable: queue the events of the task."""
    task.interrupts.disabled = True


@builtin("IEnable")
def i_enable(task: Task) -> None:
    """IEnable: execute the queued events at once, in order."""
    task.interrupts.disabled = False
    task.process_pending()


@builtin("ITimer")
def i_timer(
    task: Task, single: bool | None, safe: bool | None, seconds: float, interrupt: Ref
) -> None:
    """ITimer: order an interrupt after a period.

    Later periods count from the previous event, not from the trap.
    """
    shortest = SHORTEST_SINGLE_TIMER if single or safe else SHORTEST_TIMER
    if task.controller.dialect.shortest_timer == "any":
        shortest = _FINEST_TIMER
    # 0.01 as a num is a little less.
    if not seconds >= min(shortest, as_num(shortest)):
        raise RapidError("ERR_ARGVALERR", f"the shortest time is {shortest} s")
    order = _order(task, interrupt, single, safe)
    scheduler = task.scheduler
    period = round(seconds * 1e9)
    timer = None

    def tick() -> None:
        nonlocal timer
        if not order.single:
            timer = scheduler.at(scheduler.now + period, tick)
        task.interrupts.happen(order)

    timer = scheduler.after(period, tick)

    def cancel() -> None:
        timer.cancel()

    order.cancel.append(cancel)


@builtin("IPers")
def i_pers(task: Task, single: bool | None, safe: bool | None, name: Ref, interrupt: Ref) -> None:
    """IPers: order an interrupt for each change of a persistent.

    A write of the same value is not a change. The writing task does not matter.
    """
    cell = name.cell
    if cell is None or not name.whole:
        raise FatalError(194_303, "IPers takes a whole persistent", name.name)
    order = _order(task, interrupt, single, safe)
    _watch(cell, order, lambda: task.interrupts.happen(order))


def _watch(cell: PersistentCell, order: Interrupt, fire: Callable[[], None]) -> None:
    seen = copy_value(cell.v)

    def look() -> None:
        nonlocal seen
        if cell.v != seen:
            seen = copy_value(cell.v)
            fire()

    cell.add(look)
    order.cancel.append(lambda: cell.remove(look))


@builtin("ISignalDI")
@builtin("ISignalDO")
def i_signal_digital(
    task: Task,
    single: bool | None,
    safe: bool | None,
    signal: AnySignal,
    value: float,
    interrupt: Ref,
) -> None:
    """Order an interrupt for the edge to 0, to 1 or both (2 = edge).

    A level is not an edge.
    """
    if value not in (0, 1, EDGE):
        raise RapidError("ERR_ARGVALERR")
    order = _order(task, interrupt, single, safe)
    _on_change(task, signal, order, lambda now: value in (EDGE, now))


@builtin("ISignalGI")
@builtin("ISignalGO")
def i_signal_group(
    task: Task, single: bool | None, safe: bool | None, signal: AnySignal, interrupt: Ref
) -> None:
    """Order an interrupt for every change of a group signal."""
    order = _order(task, interrupt, single, safe)
    _on_change(task, signal, order, lambda _: True)


def _on_change(
    task: Task, signal: AnySignal, order: Interrupt, expected: Callable[[float], bool]
) -> None:
    source = signal.signal
    seen = source.value

    def look() -> None:
        nonlocal seen
        if source.value != seen:
            seen = source.value
            if expected(seen):
                task.interrupts.happen(order)

    source.changed.add(look)
    order.cancel.append(lambda: source.changed.remove(look))


@builtin("ISignalAI")
@builtin("ISignalAO")
def i_signal_analogue(
    task: Task,
    single: bool | None,
    safe: bool | None,
    signal: AnySignal,
    condition: float,
    high: float,
    low: float,
    delta: float,
    upwards: bool | None,
    downwards: bool | None,
    interrupt: Ref,
) -> None:
    """Order interrupts for changes of an analogue signal.

    While the condition is true, each change by more than the delta is an event. If the condition is
    already true, the first event occurs at once.
    """
    order = _order(task, interrupt, single, safe)
    source = signal.signal

    def holds(value: float) -> bool:
        above, below = value > high, value < low
        return {
            1: above,
            2: not above,
            3: not below,
            4: below,
            5: not above and not below,
            6: above or below,
            7: True,
        }.get(int(condition), False)

    last: float | None = None

    def look() -> None:
        nonlocal last
        value = source.value
        moved = (
            last is None
            or (value - last > delta and not downwards)
            or (last - value > delta and not upwards)
        )
        if holds(value):
            if moved:
                last = value
                task.interrupts.happen(order)
        else:
            last = None

    source.changed.add(look)
    order.cancel.append(lambda: source.changed.remove(look))
    look()


@builtin("IError")
def i_error(task: Task, domain: float, number: float | None, kind: float, interrupt: Ref) -> None:
    """IError: order an interrupt for logged events.

    Domain 0 and type 0 mean all.
    """
    order = _order(task, interrupt, None, None)

    def look(event: Event) -> None:
        if domain not in (0, event.domain) or kind not in (0, event.type):
            return
        if task.controller.dialect.error_reach == "own" and event.task != task.name:
            return
        if number is not None and event.number != number:
            return
        task.interrupts.happen(order, event)

    order.cancel.append(task.controller.log.subscribe(look))


@builtin("GetTrapData")
def get_trap_data(task: Task, data: TrapData) -> None:
    """GetTrapData: read the data of the current trap."""
    if not task.in_trap:
        raise FatalError(194_304, "GetTrapData is permitted only in a trap")
    data.event = task.interrupts.trap_data


@builtin("ReadErrData")
def read_err_data(
    task: Task,
    data: TrapData,
    domain: Ref,
    number: Ref,
    kind: Ref,
    title: Ref | None,
    *texts: Ref | None,
) -> None:
    """ReadErrData: read the event that caused the trap."""
    event = data.event
    if event is None:
        raise FatalError(194_305, "There is no error in the trap data")
    domain.set(int(event.domain))
    number.set(event.number)
    kind.set(int(event.type))
    if title is not None:
        title.set(event.title[:80])
    for i, text in enumerate(texts):
        if text is not None:
            text.set(event.texts[i][:80] if i < len(event.texts) else "")


def _order(task: Task, interrupt: Ref, single: bool | None, safe: bool | None) -> Interrupt:
    return task.interrupts.order(interrupt.get(), single=bool(single), safe=bool(safe))
