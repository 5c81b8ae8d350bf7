"""Arguments of type anytype: what a built-in may take from one, or put into it."""

from rapidgen.machine.io import Signal
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.signals import SignalAlias
from rapidgen.runtime.values import NUM, PersistentCell, Ref, Type, Value


def value_of(argument: object) -> tuple[Value, Type]:
    """Value and type; a signal counts as its num [K §2.16]. FatalError: it is no value."""
    if isinstance(argument, Ref | PersistentCell):
        return argument.get(), argument.type
    if isinstance(argument, Signal | SignalAlias):
        return single(argument.value), NUM
    raise _no_value(argument)


def target_of(argument: object) -> Ref | PersistentCell:
    """Where a value can be put. FatalError: the argument is of no value type."""
    if isinstance(argument, Ref | PersistentCell):
        return argument
    raise _no_value(argument)


def _no_value(argument: object) -> FatalError:
    return FatalError(40_001, "Argument is no value", type(argument).__name__)
