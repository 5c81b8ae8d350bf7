"""Built-ins without compiled RAPID: Python functions act as tasks."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest

from rapidgen.machine.event_log import EventLog
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.operator import Operator
from rapidgen.machine.scheduler import Scheduler
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.link import Shared
from rapidgen.runtime.registry import bound
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import BOOL, DNUM, NUM, STRING, Type, ValueRef
from rapidgen.system.model import System, TaskSpec

_TYPES = {bool: BOOL, str: STRING}


def box(value: Any, type_: Type | None = None, dims: tuple[int, ...] = ()) -> ValueRef:
    """Return a variable; numbers are num by default."""
    return ValueRef(value, type_ or _TYPES.get(type(value), NUM), dims)


def dnum(value: float) -> ValueRef:
    """A dnum variable."""
    return ValueRef(value, DNUM)


class Bench:
    """A controller's parts, and tasks that are Python functions of a `Task`."""

    def __init__(self, system: System | None = None, *, clock: Any = "virtual", **parts: Any):
        self.scheduler = Scheduler(clock=clock, seed=1)
        log = EventLog(self.scheduler)
        network = parts.pop("network", MemoryNetwork)(self.scheduler)
        self.controller = SimpleNamespace(
            scheduler=self.scheduler,
            log=log,
            network=network,
            sockets=SocketTable(network),
            io=IOSystem(self.scheduler, log, system or System("test", ())),
            dialect=Switches(),
            options=Options(),
            operator=Operator(self.scheduler, parts.pop("answers", None)),
            files=parts.pop("files", None) or FileSystem(),
        )

    def close(self) -> None:
        self.controller.network.shut_down()
        self.controller.files.close()
        self.scheduler.close()

    def run(self, *bodies: Callable[[Task], Any], until: float | None = None) -> list[Any]:
        """Run tasks until all have returned (or until `until` s).

        Returns their results; raises an exception of a task.
        """
        results: dict[int, Any] = {}

        def start(i: int, body: Callable[[Task], Any], task: Task) -> None:
            task.launch(lambda: results.update({i: body(task)}))

        for i, body in enumerate(bodies):
            spec = TaskSpec(f"T{i + 1}")
            start(i, body, Task(self.scheduler, spec, self.controller, Shared()))
        self.scheduler.advance(
            until=None if until is None else round(until * 1e9),
            stop=lambda: len(results) == len(bodies),
        )
        return [results.get(i) for i in range(len(bodies))]

    @property
    def now(self) -> float:
        """Simulated seconds."""
        return self.scheduler.now * 1e-9

    def call(self, task: Task, name: str, *required: Any, **optional: Any) -> Any:
        """Call a built-in in a task."""
        return call(task, name, *required, **optional)

    def __call__(self, name: str, *required: Any, **optional: Any) -> Any:
        """Call a built-in in a task of its own and let it finish."""
        return self.run(lambda task: call(task, name, *required, **optional))[0]

    box = staticmethod(box)
    dnum = staticmethod(dnum)


def call(task: Task, name: str, *required: Any, **optional: Any) -> Any:
    """Call a built-in as the compiler does: by its signature, in order."""
    signature = signatures.routine(name)
    builtin = bound(name)
    assert signature is not None
    assert builtin is not None
    given = {key.lower(): value for key, value in optional.items()}
    values, remaining, group = [], list(required), -1
    for parameter in signature.parameters:
        if parameter.optional or parameter.name.lower() in given:
            values.append(given.pop(parameter.name.lower(), None))
        elif parameter.group >= 0 and parameter.group == group:
            values.append(None)
        else:
            values.append(remaining.pop(0))
        group = parameter.group if not parameter.optional else -1
    assert not remaining, f"{name}: too many arguments"
    assert not given, f"{name} has no {', '.join(given)}"
    return builtin.function(task, *values)


@pytest.fixture
def bench() -> Iterator[Bench]:
    """A virtual-clock bench."""
    made = Bench()
    yield made
    made.close()


@pytest.fixture
def make_bench() -> Iterator[Callable[..., Bench]]:
    """Makes benches with other parts, and closes them."""
    made: list[Bench] = []

    def make(*args: Any, **kwargs: Any) -> Bench:
        made.append(Bench(*args, **kwargs))
        return made[-1]

    yield make
    for one in made:
        one.close()
