"""Signals: values, delays, pulses, cross connections, system signals.

A signal without a device is virtual, and here all signals are: inputs keep the value of a test, a
control socket or a cross connection. Sources: the S4 user's guide (pulses, delays, cross
connections); abb_driver's documentation for its seven system outputs.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Final, Literal

from rapidgen.machine.event_log import EventLog
from rapidgen.machine.scheduler import S, Scheduler, Timer, WaitSet
from rapidgen.system.model import CrossConnection, SignalSpec, SignalType, System

# Spelling of statuses in SYSSIG_OUT. First in each row: the name in `report`. Public cfg files
# contain "Error" and "TaskExecuting". The other spellings are remembered or from the FlexPendant;
# all are accepted.
_STATUS_ROWS: Final = """
    MotorOn MotOn MotorsOn MotOnState MotorsOnState
    MotorOff MotOff MotorsOff MotOffState MotorsOffState
    AutoOn
    CycleOn
    EmStop EmergencyStop
    ExecError ExecutionError
    Error
    RunchOk RunchainOk
    TaskExecuting
    MechUnitNotMoving MechanicalUnitNotMoving
    MechUnitActive MechanicalUnitActive
    TCPSpeed
    TCPSpeedRef TCPSpeedReference
    PowerFailError
    SimMode SimulatedIO
    ProdExecError ProductionExecutionError
    PathReturnRegionError
    MotSupOn MotionSupervisionOn
    MotSupTrigg MotionSupervisionTriggered
"""
STATUSES: Final[dict[str, str]] = {
    spelling.lower(): row.split()[0]
    for row in _STATUS_ROWS.strip().splitlines()
    for spelling in row.split()
}
Relation = Literal["=", "<>", "<", ">", "<=", ">="]
# Without an argument, such a status requires all sources; any other status requires one.
_FOR_ALL: Final = frozenset({"MechUnitNotMoving", "MechUnitActive"})


def status_name(spelling: str) -> str | None:
    """Return the internal name of a SYSSIG_OUT status, None if unknown."""
    return STATUSES.get(spelling.replace(" ", "").replace("_", "").lower())


class Signal:
    """A signal: int for digital and group signals, float for analogue ones."""

    __slots__ = ("changed", "crossed", "pending", "sharers", "spec", "value")

    def __init__(self, spec: SignalSpec) -> None:
        self.spec = spec
        self.value: float = 0
        self.changed = WaitSet()
        self.crossed: list[CrossConnection] = []
        """Cross connections that this signal is an actor of."""
        self.pending: list[Timer] = []
        """Changes ordered for later."""
        self.sharers: list[Signal] = []
        """Signals that are mapped to some of the same bits."""

    @property
    def name(self) -> str:
        """Name in EIO.cfg."""
        return self.spec.name

    @property
    def signal(self) -> "Signal":
        """The signal itself, so that an alias is usable in its place."""
        return self

    @property
    def largest(self) -> float:
        """Largest value; infinite for an unlimited analogue signal."""
        if self.spec.type in ("AI", "AO"):
            return self.spec.high if self.spec.low or self.spec.high else math.inf
        return 2**self.spec.size - 1 if self.spec.type in ("GI", "GO") else 1

    def fit(self, value: float) -> float:
        """Return `value` as this signal represents it, or raise ValueError."""
        if self.spec.type in ("AI", "AO"):
            low, high = self.spec.low, self.spec.high
            if not math.isfinite(value):
                raise ValueError(f"{value} is no value for {self.name}")
            if (low or high) and not low <= value <= high:
                raise ValueError(f"{value:g} does not fit {self.name} ({low:g} to {high:g})")
            return float(value)
        if not math.isfinite(value) or value != int(value) or not 0 <= value <= self.largest:
            raise ValueError(f"{value:g} does not fit {self.name} (0 to {self.largest:g})")
        return int(value)


@dataclass(frozen=True, slots=True)
class SignalCondition:
    """A condition that a program waits for: a signal relation."""

    signal: Signal
    relation: Relation
    value: float

    def holds(self) -> bool:
        """Return True if the condition is true now."""
        now, value = self.signal.value, self.value
        match self.relation:
            case "=":
                return now == value
            case "<>":
                return now != value
            case "<":
                return now < value
            case ">":
                return now > value
            case "<=":
                return now <= value
            case ">=":
                return now >= value

    def fulfilling(self) -> float | None:
        """Return a possible value that makes it true, None without one."""
        match self.relation:
            case "=" | "<=" | ">=":
                tries = [self.value]
            case "<":
                tries = [self.value - 1]
            case ">":
                tries = [self.value + 1]
            case "<>":
                tries = [self.value + 1, self.value - 1]
        for value in tries:
            try:
                return self.signal.fit(value)
            except ValueError:
                continue
        return None

    def __str__(self) -> str:
        now = f"{self.signal.name} is {self.signal.value:g}"
        return f"{self.signal.name} {self.relation} {self.value:g}; {now}"


_GROUP_BITS: Final = 32
"""Of a group signal that is made up."""


@dataclass(frozen=True, slots=True)
class _Output:
    status: str
    argument: str
    signal: Signal


class IOSystem:
    """All signals of one controller; names compare without case."""

    def __init__(
        self, scheduler: Scheduler, log: EventLog, system: System, *, lowest_first: bool = True
    ) -> None:
        """`lowest_first` puts the lowest bit of a group first in its map.

        The switch `bit_order` sets it.
        """
        self._scheduler = scheduler
        self._log = log
        self.signals: dict[str, Signal] = {}
        for spec in system.signals:
            bits = spec.bits if lowest_first else spec.bits[::-1]
            self.signals.setdefault(spec.name.lower(), Signal(replace(spec, bits=bits)))
        self.on_action: Callable[[str, str], None] | None = None
        """Called with (action, argument) when the signal of a system input rises."""
        self.on_end: Callable[[str], None] | None = None
        """Called with the action when it falls."""
        self.on_awaited: Callable[[SignalCondition], None] | None = None
        """Called when a program begins to wait for a condition."""
        self._units = {spec.device.casefold() for spec in system.signals} - {""}
        self.disabled: set[str] = set()
        """Units that programs have switched off, folded."""
        self.any_unit = False
        """True in an inferred cell: every named unit exists."""
        self.divisors: frozenset[str] = frozenset()
        """Divisors in programs, lower case: inferred signals with such a name start at 1."""
        self._states: dict[str, dict[str, float]] = {}
        self._outputs = [*self._system_outputs(system)]
        self._actions: dict[int, list[tuple[str, str]]] = {}
        for entry in system.inputs:
            signal = self._configured(entry.signal, f"system input {entry.action}")
            if signal is not None:
                actions = self._actions.setdefault(id(signal), [])
                actions.append((entry.action, entry.argument))
        self._share()
        self._connect(system.cross)
        for signal in self.signals.values():
            if signal.spec.default:
                self._store(signal, signal.spec.default)
        self._settle(system.cross)

    # -- reading and finding ----------------------------------------------------------------

    def is_unit(self, name: str) -> bool:
        """Return True if a signal is on the unit of that name."""
        return self.any_unit or name.casefold() in self._units

    def get(self, name: str) -> Signal | None:
        """Return the signal of a name, or None."""
        return self.signals.get(name.lower())

    def made_up(self, name: str, kind: SignalType) -> Signal | None:
        """Return a signal that a program names by text.

        It exists in an inferred cell only; otherwise None.
        """
        if not self.any_unit or not name:
            return None
        made = Signal(SignalSpec(name, kind, size=_GROUP_BITS if kind[0] == "G" else 1))
        if name.casefold().startswith(tuple(self.divisors)):
            self._store(made, 1)
        return self.signals.setdefault(name.lower(), made)

    def __getitem__(self, name: str) -> Signal:
        return self.signals[name.lower()]

    def await_value(self, awaited: SignalCondition) -> None:
        """Report a condition that a program is going to wait for."""
        if self.on_awaited is not None and not awaited.holds():
            self.on_awaited(awaited)

    # -- changing ---------------------------------------------------------------------------

    def set(self, signal: Signal, value: float, *, delay: float = 0.0) -> None:
        """Set a value, at once or after `delay` s.

        Later orders cancel pending earlier ones. ValueError: the signal cannot represent the value.
        """
        fitting = signal.fit(value)
        self._drop_pending(signal)
        if delay > 0:
            timer = self._scheduler.after(round(delay * S), lambda: self._later(signal, fitting))
            signal.pending.append(timer)
        else:
            self._store(signal, fitting)

    def pulse(self, signal: Signal, length: float, *, high: bool = False) -> None:
        """Invert a digital signal for `length` s.

        `high`: set it to 1 in any case, then to 0.
        """
        back = 0.0 if high else signal.value
        self._drop_pending(signal)
        self._store(signal, 1 if high else 1 - signal.value, spread=False)
        timer = self._scheduler.after(
            round(length * S), lambda: self._later(signal, back, spread=False)
        )
        signal.pending.append(timer)

    def power_up(self) -> None:
        """Set outputs to their defaults and cancel pending changes."""
        for signal in self.signals.values():
            self._drop_pending(signal)
            if signal.spec.type[1] == "O":
                self._store(signal, signal.spec.default)
        for output in self._outputs:
            self._show(output)

    def _later(self, signal: Signal, value: float, *, spread: bool = True) -> None:
        signal.pending.clear()
        self._store(signal, value, spread=spread)

    @staticmethod
    def _drop_pending(signal: Signal) -> None:
        for timer in signal.pending:
            timer.cancel()
        signal.pending.clear()

    def _store(self, signal: Signal, value: float, *, spread: bool = True) -> None:
        before = signal.value
        if value == before:
            return
        self._take(signal, value)
        # A pulse of an actor does not travel on [S4 user's guide].
        changed = [signal, *self._follow(signal)]
        if spread:
            for one in changed:
                for connection in one.crossed:
                    self._apply(connection)

    def _take(self, signal: Signal, value: float) -> None:
        before, signal.value = signal.value, value
        signal.changed.notify()
        if bool(value) is bool(before):
            return
        for action, argument in self._actions.get(id(signal), ()):
            if value and self.on_action is not None:
                self.on_action(action, argument)
            elif not value and self.on_end is not None:
                self.on_end(action)

    # -- shared bits ------------------------------------------------------------------------

    def _share(self) -> None:
        """Find signals of one device and direction with common bits."""
        users: dict[tuple[str, str, int], list[Signal]] = {}
        for signal in self.signals.values():
            if signal.spec.device and signal.spec.type[0] != "A":
                for bit in signal.spec.bits:
                    users.setdefault((signal.spec.device, signal.spec.type[1], bit), []).append(
                        signal
                    )
        for together in users.values():
            for signal in together:
                signal.sharers += [
                    s for s in together if s is not signal and s not in signal.sharers
                ]

    def _follow(self, signal: Signal) -> list[Signal]:
        """Copy the bits of a signal to those that share them.

        Returns the changed signals.
        """
        changed = []
        for other in signal.sharers:
            value = int(other.value)
            for place, bit in enumerate(other.spec.bits):
                if bit in signal.spec.bits:
                    own = int(signal.value) >> signal.spec.bits.index(bit) & 1
                    value = value & ~(1 << place) | own << place
            if value != other.value:
                self._take(other, value)
                changed.append(other)
        return changed

    # -- cross connections ------------------------------------------------------------------

    def _connect(self, connections: Iterable[CrossConnection]) -> None:
        targets: dict[str, set[str]] = {}
        for connection in connections:
            names = (connection.result, *(name for name, _ in connection.actors))
            found = [self._configured(n, f"cross connection {connection.name}") for n in names]
            if any(signal is None for signal in found):
                continue
            result = connection.result.lower()
            actors = {name.lower() for name, _ in connection.actors}
            if result in actors or actors & _reachable(result, targets):
                self._log.record(197_100, connection.name)
                continue
            for actor in actors:
                targets.setdefault(actor, set()).add(result)
                self.signals[actor].crossed.append(connection)

    def _apply(self, connection: CrossConnection) -> None:
        values = [bool(self[name].value) != inverted for name, inverted in connection.actors]
        outcome = values[0]
        for operator, value in zip(connection.operators, values[1:], strict=False):
            outcome = outcome and value if operator == "AND" else outcome or value
        result = self[connection.result]
        self._drop_pending(result)
        self._store(result, int(outcome))

    def _settle(self, connections: Iterable[CrossConnection]) -> None:
        for connection in connections:
            first = self.get(connection.actors[0][0]) if connection.actors else None
            if first is not None and connection in first.crossed:
                self._apply(connection)

    # -- system outputs ---------------------------------------------------------------------

    def report(self, status: str, value: float, argument: str = "") -> None:
        """Set a status of the controller to `value`.

        `argument` is a task or a unit, if the status has one. `status` is a name from `STATUSES`.
        """
        states = self._states.setdefault(status, {})
        if states.get(argument.lower()) == value:
            return
        states[argument.lower()] = value
        for output in self._outputs:
            if output.status == status:
                self._show(output)

    def _system_outputs(self, system: System) -> Iterable[_Output]:
        for entry in system.outputs:
            signal = self._configured(entry.signal, f"system output {entry.status}")
            status = status_name(entry.status)
            if status is None:
                self._log.record(197_101, entry.status, entry.signal)
            elif signal is not None:
                yield _Output(status, (entry.unit or entry.task).lower(), signal)

    def _show(self, output: _Output) -> None:
        states = self._states.get(output.status)
        if states is None:
            return
        if output.argument:
            value = states.get(output.argument)
            if value is None:
                value = states.get("", 0)
        elif output.status in _FOR_ALL:
            value = min(states.values())
        else:
            value = max(states.values())
        if output.signal.spec.type in ("DI", "DO"):
            value = int(bool(value))
        self._drop_pending(output.signal)
        self._store(output.signal, value)

    def _configured(self, name: str, user: str) -> Signal | None:
        signal = self.get(name)
        if signal is None:
            self._log.record(197_102, user, f"'{name}'")
        return signal


def _reachable(start: str, targets: dict[str, set[str]]) -> set[str]:
    seen: set[str] = set()
    front = [start]
    while front:
        for target in targets.get(front.pop(), ()):
            if target not in seen:
                seen.add(target)
                front.append(target)
    return seen
