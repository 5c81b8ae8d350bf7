"""A controller for tests and users: tasks with data, signals by name."""

from collections.abc import Iterator, Mapping, Sequence

from rapidgen.controller.operation import Operation
from rapidgen.diagnostics import suggest
from rapidgen.machine.io import IOSystem, Signal
from rapidgen.runtime.compiler.symbols import Data, LoadedModule
from rapidgen.runtime.errors import FatalError, Location
from rapidgen.runtime.host import TaskState
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import PersistentCell, Type, Value, misfit

_SHOWN = 6
"""Names that an error lists."""


def unknown(kind: str, name: str, known: Sequence[str]) -> KeyError:
    """Return a KeyError for a name that is not among `known`."""
    few = ", ".join(known[:_SHOWN]) + (", ..." if len(known) > _SHOWN else "")
    help = suggest(name, known) or (f"there are {few}" if known else "there is none")
    return KeyError(f"there is no {kind} '{name}': {help}")


class Signals(Mapping[str, float]):
    """Values of the signals by name; an assignment sets one."""

    def __init__(self, io: IOSystem) -> None:
        self._io = io

    def __getitem__(self, name: str) -> float:
        return self._signal(name).value

    def __setitem__(self, name: str, value: float) -> None:
        self._io.set(self._signal(name), value)

    def _signal(self, name: str) -> Signal:
        match = self._io.get(name)
        if match is None:
            raise unknown("signal", name, list(self))
        return match

    def __iter__(self) -> Iterator[str]:
        return iter([s.name for s in self._io.signals.values()])

    def __len__(self) -> int:
        return len(self._io.signals)


class TaskView:
    """A task for tests: `task["Module:name"]` is a raw value (deg, mm)."""

    def __init__(self, task: Task, operation: Operation) -> None:
        self.rapid = task
        self._operation = operation

    @property
    def name(self) -> str:
        """Name of the task."""
        return self.rapid.name

    @property
    def state(self) -> TaskState:
        """`ready`, `running`, `stopped`, `finished`, `error` or `empty`."""
        return self.rapid.state

    @property
    def fault(self) -> FatalError | None:
        """The error that stopped the task."""
        return self.rapid.fault

    @property
    def stack(self) -> tuple[Location, ...]:
        """Call stack, outermost routine first."""
        return self.rapid.stack()

    def _data(self, name: str) -> tuple[Data, Value]:
        program = self.rapid.program
        where, colon, key = name.lower().rpartition(":")
        module = program.modules.get(where) if colon else None
        if colon and module is None:
            raise unknown(f"module in {self.name} called", where, [m.name for m in self._modules()])
        data = program.find_data(module, key)
        if data is None:
            raise unknown(f"data in {self.name} called", name, self._names())
        return data, program.space.get(data.code)

    def _modules(self) -> list[LoadedModule]:
        return [m for m in self.rapid.program.modules.values() if not m.installed]

    def _names(self) -> list[str]:
        return [f"{m.name}:{d.name}" for m in self._modules() for d in m.declarations.values()]

    def __getitem__(self, name: str) -> Value:
        data, persisted = self._data(name)
        if data.storage == "inline":
            return data.value
        return persisted.v if data.storage == "cell" else persisted

    def __setitem__(self, name: str, value: Value) -> None:
        data, persisted = self._data(name)
        if data.readonly:
            raise KeyError(f"{name} is a constant")
        if wrong := misfit(value, data.type, data.dims):
            raise TypeError(f"{name} takes {wrong}")
        if data.type.kind == "bool" and not data.dims:
            value = bool(value)
        if data.storage == "cell":
            persisted.set(value)
        else:
            program = self.rapid.program
            program.space[program.global_ref(data)].set(value)

    def type_of(self, name: str) -> tuple[Type, tuple[int, ...]]:
        """Return type and dimensions of a datum, or raise KeyError."""
        data, _ = self._data(name)
        return data.type, data.dims

    def cell(self, name: str) -> PersistentCell | None:
        """Return the cell of a persistent, None for other data.

        Raises KeyError. The cell notifies of changes.
        """
        data, persisted = self._data(name)
        return persisted if data.storage == "cell" else None

    def start(self) -> None:
        """Start or continue."""
        self.rapid.start()

    def stop(self) -> None:
        """Stop the program."""
        self.rapid.stop()

    def step(self, *, back: bool = False, over: bool = False) -> None:
        """Execute one statement; `over`: calls as a whole.

        Time has to pass for it; afterwards the task is `stopped`. CannotStep explains why not.
        """
        self._operation.step_program(self.rapid, back=back, over=over)

    @property
    def place(self) -> Location | None:
        """Next statement of a stopped task, None if unknown."""
        return self.rapid.pointer.next_statement()

    def pp_to_routine(self, name: str) -> None:
        """Set the program pointer to a procedure without parameters.

        CannotStep: no such procedure.
        """
        self.rapid.pp_to_routine(name)
        self._operation.drop_paths()

    def pp_to_statement(self, line: int) -> None:
        """Set PP to another statement of the routine (PP to cursor).

        Data and interrupts stay, the path is discarded. CannotStep: execution cannot continue
        there.
        """
        self.rapid.pp_to_statement(line)
        self._operation.drop_paths()

    def call_service(self, name: str) -> None:
        """Execute a service routine of a stopped task.

        CannotStep: the task runs, or the routine does not exist.
        """
        self.rapid.call_service(name)

    def pp_to_main(self) -> None:
        """Set the program pointer to main."""
        self.rapid.pp_to_main()
