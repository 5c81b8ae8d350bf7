"""Signals as RAPID variables: those that a program declares and AliasIO connects."""

from functools import partial
from typing import TypeAlias, get_args

from rapidgen.machine.io import Signal
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import register_type
from rapidgen.system.model import SignalType


class SignalAlias:
    """A signal that a program declares: nothing until AliasIO connects it."""

    __slots__ = ("target", "type")

    def __init__(self, type: SignalType) -> None:
        self.type = type
        self.target: Signal | None = None

    @property
    def signal(self) -> Signal:
        """The signal behind the alias; ERR_NO_ALIASIO_DEF when there is none."""
        if self.target is None:
            raise RapidError("ERR_NO_ALIASIO_DEF")
        return self.target

    @property
    def value(self) -> float:
        """Its value, for expressions such as `IF di1 = 1`."""
        return self.signal.value


AnySignal: TypeAlias = Signal | SignalAlias
"""What a VAR signalxx argument is: both have `.signal` and `.value`."""

for _type in get_args(SignalType):
    register_type(f"signal{_type}", partial(SignalAlias, _type), "semivalue")
