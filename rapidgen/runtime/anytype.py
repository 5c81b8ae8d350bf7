"""Arguments of type anytype: what a built-in may take from one, or put into it."""

from typing import Any

from rapidgen.machine.io import Signal
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.signals import SignalAlias
from rapidgen.runtime.values import NUM, PersistentCell, Ref, Type, single


def value_of(datum: object) -> tuple[Any, Type]:
    """Value and type; a signal counts as its num [K §2.16]. FatalError: it is no value."""
    if isinstance(datum, Ref | PersistentCell):
        return datum.get(), datum.type
    if isinstance(datum, Signal | SignalAlias):
        return single(datum.value), NUM
    raise _no_value(datum)


def target_of(datum: object) -> Ref | PersistentCell:
    """Where a value can be put. FatalError: the argument is of no value type."""
    if isinstance(datum, Ref | PersistentCell):
        return datum
    raise _no_value(datum)


def _no_value(datum: object) -> FatalError:
    return FatalError(40_001, "Argument is no value", type(datum).__name__)
