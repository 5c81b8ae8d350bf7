"""Signals: Set to AliasIO, and the instructions that wait for a signal.

Sources: [manual] S4 reference (dionum is 0 or 1, pulses invert, time-outs and \\TimeFlag);
3HAC16581-1 names of the IRC5 additions. Ranges of \\SDelay and \\PLength: switch `signal_times`.
"""

from collections.abc import Callable

from rapidgen.machine.io import Relation, Signal, SignalCondition
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import AnySignal, SignalAlias
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

_TIMES = {"irc5": (0.001, 2000.0), "s4": (0.1, 32.0)}
_DEFAULT_PULSE = 0.2


def dionum(task: Task, value: float) -> int:
    """A digital value: anything but 0 and 1 is an error [S4 dionum], or counts as 1 (dialect)."""
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
    """`value`, which fits the signal. ERR_AO_LIM, ERR_GO_LIM, ERR_ARGVALERR: it does not."""
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
    """Turn a digital output over."""
    target = _writable(signal)
    task.controller.io.set(target, 1 - target.value)


@builtin("PulseDO")
def pulse_do(task: Task, high: bool | None, length: float | None, signal: AnySignal) -> None:
    """Invert a digital output for a while; the program goes on at once."""
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
    """Connect a declared signal with one of the configuration, given itself or by name."""
    given: str | AnySignal = source if isinstance(source, Signal | SignalAlias) else source.get()
    if isinstance(given, str) and not task.controller.dialect.alias_by_name:
        raise FatalError(40_214, "AliasIO takes a signal", f"'{given}' is a text")
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
    """Whether a signal is the configuration's (1), an alias of one (2), or none (0) [mem]; its
    name there."""
    if isinstance(signal, Signal):
        name.set(signal.name)
        return 1
    name.set(signal.target.name if signal.target is not None else "")
    return 2 if signal.target is not None else 0


@builtin("AliasIOReset")
def alias_io_reset(_task: Task, target: SignalAlias) -> None:
    """Take the connection of an alias away."""
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
