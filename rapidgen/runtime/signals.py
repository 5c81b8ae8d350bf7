"""Signals, arguments of type anytype and cyclic conditions."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import TypeAlias, get_args

from rapidgen.machine.io import Signal
from rapidgen.machine.scheduler import Scheduler, WaitSet
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.values import NUM, PersistentCell, Ref, Type, Value, register_type
from rapidgen.system.model import SignalType

# -- Signals ---------------------------------------------------------------------------------------
#
# Signals as RAPID variables: those that a program declares and AliasIO connects.


class SignalAlias:
    """A signal declared by a program, without effect before AliasIO."""

    __slots__ = ("target", "type")

    def __init__(self, type: SignalType) -> None:
        self.type = type
        self.target: Signal | None = None

    @property
    def signal(self) -> Signal:
        """The connected signal; ERR_NO_ALIASIO_DEF without one."""
        if self.target is None:
            raise RapidError("ERR_NO_ALIASIO_DEF")
        return self.target

    @property
    def value(self) -> float:
        """The value, for expressions such as `IF di1 = 1`."""
        return self.signal.value


AnySignal: TypeAlias = Signal | SignalAlias
"""A VAR signalxx argument: both classes have `.signal` and `.value`."""

for _type in get_args(SignalType):
    register_type(f"signal{_type}", partial(SignalAlias, _type), "semivalue")


# -- Arguments of type anytype ---------------------------------------------------------------------
#
# Arguments of type anytype: what a built-in may take from one, or put into it.


def value_of(argument: object) -> tuple[Value, Type]:
    """Return value and type; a signal counts as num [K §2.16].

    FatalError: the argument has no value.
    """
    if isinstance(argument, Ref | PersistentCell):
        return argument.get(), argument.type
    if isinstance(argument, Signal | SignalAlias):
        return single(argument.value), NUM
    raise _no_value(argument)


def target_of(argument: object) -> Ref | PersistentCell:
    """Return the reference to write to.

    FatalError: the argument has no value type.
    """
    if isinstance(argument, Ref | PersistentCell):
        return argument
    raise _no_value(argument)


def _no_value(argument: object) -> FatalError:
    return FatalError(194_001, "Argument is no value", type(argument).__name__)


# -- Cyclic conditions -----------------------------------------------------------------------------
#
# Cyclic bools: conditions that the controller evaluates by itself, each into a persistent.
#
# Sources: 3HAC050917 SetupCyclicBool to IsCyclicBool [manual] for what there is; the cycle of 12
# ms, 60 of them in all tasks, and that PP to main removes them [mem].


CYCLE_NS = 12_000_000
MOST = 60


@dataclass(slots=True, eq=False)
class CyclicBool:
    """A condition and the target of its value."""

    scheduler: Scheduler
    flag: Value
    """Reference to the persistent."""
    look: Callable[[], bool]
    watched: tuple[WaitSet, ...]
    follow: Callable[[bool], None]
    """Writes the signal with the same value, if there is one."""
    _due: bool = False
    _gone: bool = False

    def start(self) -> None:
        """Evaluate now, and in the cycle after each change."""
        for changing in self.watched:
            changing.add(self._changed)
        self._evaluate()

    def stop(self) -> None:
        """Stop; persistent and signal keep their values."""
        self._gone = True
        for changing in self.watched:
            changing.remove(self._changed)

    def _changed(self) -> None:
        if not self._due:
            self._due = True
            now = self.scheduler.now
            self.scheduler.after(CYCLE_NS - now % CYCLE_NS, self._evaluate)

    def _evaluate(self) -> None:
        self._due = False
        if not self._gone:
            value = bool(self.look())
            if self.flag.get() != value:
                self.flag.set(value)
            self.follow(value)


@dataclass(slots=True)
class CyclicBools:
    """Cyclic conditions of one task, by lower-case persistent name."""

    known: dict[str, CyclicBool] = field(default_factory=dict)

    def put(self, name: str, condition: CyclicBool) -> None:
        """Set up a condition in place of the persistent's former one."""
        self.remove(name)
        self.known[name.lower()] = condition
        condition.start()

    def remove(self, name: str) -> bool:
        """Remove the condition of a persistent; False without one."""
        result = self.known.pop(name.lower(), None)
        if result is not None:
            result.stop()
        return result is not None

    def clear(self) -> None:
        """Remove all."""
        for name in tuple(self.known):
            self.remove(name)


def follower(
    signal: Signal | None, set_signal: Callable[[Signal, float], None]
) -> Callable[[bool], None]:
    """Return a function that writes a condition's value to a signal."""

    def follow(value: bool) -> None:
        if signal is not None:
            set_signal(signal, float(value))

    return follow
