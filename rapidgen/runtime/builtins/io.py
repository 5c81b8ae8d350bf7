"""signal of the configuration, 2: alias of one, 0: not connected [mem]."""

from collections.abc import Callable, Iterator
from typing import Final

from rapidgen.machine.io import Relation, Signal, SignalCondition
from rapidgen.rapid.numbers import single
from rapidgen.runtime.compiler.support import Condition
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import MOST, AnySignal, CyclicBool, CyclicBools, SignalAlias, follower
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

# -- Signals ---------------------------------------------------------------------------------------
#
# Signals: Set to AliasIO, and the instructions that wait for a signal.
#
# Sources: [manual] S4 reference (dionum is 0 or 1, pulses invert, time-outs and \TimeFlag);
# 3HAC16581-1 names of the IRC5 additions. Ranges of \SDelay and \PLength: switch `signal_times`.


_TIMES = {"irc5": (0.001, 2000.0), "s4": (0.1, 32.0)}
_DEFAULT_PULSE = 0.2


def dionum(task: Task, value: float) -> int:
    """Return a digital value of 0 or 1.

    Other values raise an error [S4 dionum], or count as 1 (dialect).
    """
    if value not in (0, 1):
        if task.controller.dialect.dionum == "nonzero":
            return 1
        raise RapidError("ERR_ARGVALERR", f"{value:g} is no dionum")
    return int(value)


def _writable(target: AnySignal) -> Signal:
    signal = target.signal
    if signal.spec.access.lower() == "readonly":
        raise RapidError("ERR_SIG_NOT_VALID", f"{signal.name} is read only")
    return signal


_BEYOND = {"A": "ERR_AO_LIM", "G": "ERR_GO_LIM"}


def fitting(signal: Signal, value: float) -> float:
    """Return `value` if the signal can represent it.

    Raises ERR_AO_LIM, ERR_GO_LIM or ERR_ARGVALERR.
    """
    try:
        signal.fit(value)
    except ValueError as error:
        raise RapidError(_BEYOND.get(signal.spec.type[0], "ERR_ARGVALERR"), str(error)) from error
    return value


def _duration(task: Task, seconds: float, name: str) -> float:
    shortest, longest = _TIMES[task.controller.dialect.signal_times]
    if not shortest * (1 - 1e-6) <= seconds <= longest:
        raise RapidError("ERR_ARGVALERR", f"\\{name}:={seconds:g}")
    return seconds


def _delay(task: Task, seconds: float | None) -> float:
    return 0.0 if not seconds else _duration(task, seconds, "SDelay")


# -- writing ------------------------------------------------------------------------------------


@builtin("SetDO")
def set_do(
    task: Task, delay: float | None, _sync: bool | None, signal: AnySignal, value: float
) -> None:
    """Set a digital output, at once or after \\SDelay."""
    task.controller.io.set(_writable(signal), dionum(task, value), delay=_delay(task, delay))


_WRITING: dict[str, Callable[..., Value]] = {
    "Set": lambda task, signal: task.controller.io.set(_writable(signal), 1),
    "Reset": lambda task, signal: task.controller.io.set(_writable(signal), 0),
}
builtins(_WRITING)


@builtin("InvertDO")
def invert_do(task: Task, signal: AnySignal) -> None:
    """Invert a digital output."""
    target = _writable(signal)
    task.controller.io.set(target, 1 - target.value)


@builtin("PulseDO")
def pulse_do(task: Task, high: bool | None, length: float | None, signal: AnySignal) -> None:
    """Invert a digital output for a time; do not wait."""
    seconds = _DEFAULT_PULSE if length is None else _duration(task, length, "PLength")
    task.controller.io.pulse(_writable(signal), seconds, high=bool(high))


@builtin("SetAO")
def set_ao(task: Task, signal: AnySignal, value: float) -> None:
    """Set an analogue output, in programmed units."""
    try:
        task.controller.io.set(_writable(signal), value)
    except ValueError as error:
        raise RapidError("ERR_AO_LIM", str(error)) from error


@builtin("SetGO")
def set_go(
    task: Task,
    delay: float | None,
    signal: AnySignal,
    value: float | None,
    dnum_value: float | None,
) -> None:
    """Set a group of outputs to a whole number."""
    number = value if value is not None else dnum_value
    assert number is not None
    try:
        task.controller.io.set(_writable(signal), number, delay=_delay(task, delay))
    except ValueError as error:
        raise RapidError("ERR_GO_LIM", str(error)) from error


# -- reading ------------------------------------------------------------------------------------


_READING: dict[str, Callable[..., Value]] = {
    "TestDI": lambda _, signal: signal.value == 1,
    "GOutputDnum": lambda _, signal: signal.value,
    "GInputDnum": lambda _, signal: signal.value,
    "ValidIO": lambda _, signal: isinstance(signal, Signal) or signal.target is not None,
}
builtins(_READING)
for _name in ("DOutput", "DInput", "AOutput", "AInput", "GOutput", "GInput"):
    builtin(_name)(lambda _task, signal: single(signal.value))


# -- aliases ------------------------------------------------------------------------------------


@builtin("AliasIO")
def alias_io(task: Task, source: Ref | AnySignal, target: SignalAlias) -> None:
    """Connect a declared signal with a signal of the configuration.

    The program names the signal by itself or by its name.
    """
    given: str | AnySignal = source if isinstance(source, Signal | SignalAlias) else source.get()
    if isinstance(given, str) and not task.controller.dialect.alias_by_name:
        raise FatalError(194_214, "AliasIO takes a signal", f"'{given}' is a text")
    match = task.controller.io.get(given) if isinstance(given, str) else given.signal
    if match is None and isinstance(given, str) and isinstance(target, SignalAlias):
        match = task.controller.io.made_up(given, target.type)
    if match is None:
        raise RapidError("ERR_ALIASIO_DEF", f"no signal '{given}'")
    if not isinstance(target, SignalAlias):
        raise RapidError("ERR_ALIASIO_DEF", "a signal of the configuration is no alias")
    if match.spec.type != target.type:
        raise RapidError("ERR_ALIASIO_TYPE", f"{match.name} is a {match.spec.type}")
    target.target = match


@builtin("GetSignalOrigin")
def get_signal_origin(_task: Task, signal: AnySignal, name: Ref) -> int:
    """Return the origin of a signal and its configured name."""
    if isinstance(signal, Signal):
        name.set(signal.name)
        return 1
    name.set(signal.target.name if signal.target is not None else "")
    return 2 if signal.target is not None else 0


@builtin("AliasIOReset")
def alias_io_reset(_task: Task, target: SignalAlias) -> None:
    """Remove the connection of an alias."""
    if isinstance(target, SignalAlias):
        target.target = None


# -- waiting ------------------------------------------------------------------------------------


def _wait(
    task: Task,
    awaited: SignalCondition,
    max_time: float | None,
    time_flag: Ref | None = None,
    at_timeout: Ref | None = None,
) -> None:
    signal = awaited.signal
    task.controller.io.await_value(awaited)
    there = task.wait_for(
        awaited.holds, on=(signal.changed,), timeout=max_time, why=lambda: f"waits for {awaited}"
    )
    if max_time is None:
        return
    if time_flag is not None:
        time_flag.set(not there)
    elif not there:
        if at_timeout is not None:
            at_timeout.set(signal.value)
        raise RapidError("ERR_WAIT_MAXTIME", signal.name)


def _wait_digital(name: str) -> None:
    @builtin(name)
    def wait(
        task: Task,
        target: AnySignal,
        value: float,
        max_time: float | None,
        time_flag: Ref | None,
        *_visual: object,
    ) -> None:
        _wait(task, SignalCondition(target.signal, "=", dionum(task, value)), max_time, time_flag)


_wait_digital("WaitDI")
_wait_digital("WaitDO")


def _wait_analogue(name: str) -> None:
    @builtin(name)
    def wait(
        task: Task,
        target: AnySignal,
        less: bool | None,
        greater: bool | None,
        value: float,
        max_time: float | None,
        at_timeout: Ref | None,
        *_visual: object,
    ) -> None:
        awaited = SignalCondition(target.signal, _relation(less=less, greater=greater), value)
        _wait(task, awaited, max_time, at_timeout=at_timeout)


_wait_analogue("WaitAI")
_wait_analogue("WaitAO")


def _wait_group(name: str) -> None:
    @builtin(name)
    def wait(
        task: Task,
        target: AnySignal,
        different: bool | None,
        less: bool | None,
        greater: bool | None,
        value: float | None,
        dnum_value: float | None,
        max_time: float | None,
        at_timeout: Ref | None,
        dnum_at_timeout: Ref | None,
        *_visual: object,
    ) -> None:
        expected = value if value is not None else dnum_value
        assert expected is not None
        relation = _relation(different=different, less=less, greater=greater)
        place = at_timeout if at_timeout is not None else dnum_at_timeout
        _wait(task, SignalCondition(target.signal, relation, expected), max_time, at_timeout=place)


_wait_group("WaitGI")
_wait_group("WaitGO")


def _relation(
    *, different: bool | None = None, less: bool | None = None, greater: bool | None = None
) -> Relation:
    return "<>" if different else "<" if less else ">" if greater else "="


# -- I/O units -------------------------------------------------------------------------------------
#
# Source: S4 datasys 2-IODisable, 2-IOEnable, 3HAC16581-1 IOUnitState [manual]; numbers of the
# states from installed modules [code].
#
# A unit runs unless a program has disabled it. Signals of a disabled unit remain usable, because no
# bus exists that could fail.


_STATES: Final = {
    "Phys": (20.0, 21.0),
    "Logic": (10.0, 11.0),
    "": (3.0, 1.0),
}
"""iounit_state of a disabled unit and of one that runs: IOUNIT_PHYS_STATE_DEACTIVATED and _RUNNING,
IOUNIT_LOG_STATE_DISABLED and _ENABLED; IOUNIT_DISABLE and IOUNIT_RUNNING without a switch."""


def _known(task: Task, name: str) -> str:
    """Return the configured name of a unit, or raise ERR_NAME_INVALID."""
    io = task.controller.io
    if not io.is_unit(name):
        raise RapidError("ERR_NAME_INVALID", f"no I/O unit '{name}'")
    return name.casefold()


@builtin("IOEnable")
def io_enable(task: Task, name: str, _max_time: float) -> None:
    """Enable a unit."""
    task.controller.io.disabled.discard(_known(task, name))


@builtin("IODisable")
def io_disable(task: Task, name: str, _max_time: float) -> None:
    """Disable a unit."""
    task.controller.io.disabled.add(_known(task, name))


@builtin("IOUnitState")
def io_unit_state(task: Task, name: str, phys: bool | None, logic: bool | None) -> float:
    """Return the state of a unit."""
    disabled, running = _STATES["Phys" if phys else "Logic" if logic else ""]
    return disabled if _known(task, name) in task.controller.io.disabled else running


# -- Cyclic conditions -----------------------------------------------------------------------------
#
# SetupCyclicBool to IsCyclicBool. See `rapidgen/runtime/signals.py` for sources.


@builtin("SetupCyclicBool")
def setup_cyclic_bool(
    task: Task, flag: Ref, condition: Condition, signal: AnySignal | None
) -> None:
    """Evaluate a condition on signals and persistents cyclically.

    ERR_ARGVALERR: the condition calls a function of the program, or 60 conditions exist.
    """
    if condition.calls:
        raise RapidError("ERR_ARGVALERR", "the condition calls a function of the program")
    others = sum(name != flag.name.lower() for every in _all(task) for name in every.known)
    if others >= MOST:
        raise RapidError("ERR_ARGVALERR", f"there are {MOST} cyclic bools")
    follow = follower(signal.signal if signal is not None else None, task.controller.io.set)
    made = CyclicBool(task.scheduler, flag, condition.look, condition.watched, follow)
    task.cyclic.put(flag.name, made)


@builtin("RemoveCyclicBool")
def remove_cyclic_bool(task: Task, flag: Ref | None, name: str | None) -> None:
    """Remove the condition of a persistent, which keeps its value.

    ERR_ARGVALERR: the persistent has no condition in this task.
    """
    expected = _condition_name(flag, name)
    if not task.cyclic.remove(expected):
        raise RapidError("ERR_ARGVALERR", f"{expected} is no cyclic bool")


@builtin("RemoveAllCyclicBool")
def remove_all_cyclic_bool(task: Task, all_tasks: bool | None) -> None:
    """Remove the conditions of this task, or of all tasks."""
    for every in _all(task) if all_tasks else (task.cyclic,):
        every.clear()


@builtin("GetMaxNumberOfCyclicBool")
def get_max_number_of_cyclic_bool(_task: Task) -> int:
    """Return the maximum number of conditions in all tasks."""
    return MOST


@builtin("GetNumberOfCyclicBool")
def get_number_of_cyclic_bool(task: Task) -> int:
    """Return the number of conditions in all tasks."""
    return sum(len(every.known) for every in _all(task))


@builtin("GetNextCyclicBool")
def get_next_cyclic_bool(task: Task, place: Ref, name: Ref) -> bool:
    """Return the next condition after a position that starts at 0.

    Returns FALSE after the last one.
    """
    names = [c.flag.name for every in _all(task) for c in every.known.values()]
    at = int(place.get())
    if not 0 <= at < len(names):
        return False
    name.set(names[at])
    place.set(at + 1)
    return True


@builtin("IsCyclicBool")
def is_cyclic_bool(
    task: Task, flag: Ref | None, name: str | None, reference: Value, task_name: str | None
) -> bool:
    """Return True if a persistent has a condition.

    The task is this one or a named one. Raises ERR_TASKNAME.
    """
    expected = task_name if task_name is not None else reference.value if reference else task.name
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == str(expected).lower():
            return _condition_name(flag, name).lower() in other.cyclic.known
    raise RapidError("ERR_TASKNAME", str(expected))


def _condition_name(flag: Ref | None, name: str | None) -> str:
    return str(name) if flag is None else flag.name


def _all(task: RapidTask) -> Iterator[CyclicBools]:
    for other in task.controller.rapid_tasks.values():
        yield other.cyclic
