"""Topics of subscriptions: `topics.signal("doGrip")`, `topics.log()`, ..."""

from dataclasses import dataclass, field

from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.operations import RwsOperation


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic. `priority` is 0 (every 5 s), 1 (every 200 ms) or 2 (at once)."""

    name: str
    operation: RwsOperation
    names: dict[str, str] = field(default_factory=dict)
    suffix: str = ""
    priority: int = 1

    def resource(self, generation: Generation) -> str:
        """Return the resource in a generation's spelling."""
        route = self.operation.route(generation)
        assert route is not None
        return route.fill(self.names) + (f";{self.suffix}" if self.suffix else "")


def ctrl_state() -> Topic:
    """Motors, emergency stop, system failure."""
    return Topic("ctrlstate", ops.CTRL_STATE)


def mode() -> Topic:
    """The operating mode."""
    return Topic("opmode", ops.OPMODE)


def speed() -> Topic:
    """The speed in percent."""
    return Topic("speedratio", ops.SPEED)


def execution() -> Topic:
    """`running` or `stopped`."""
    return Topic("execution", ops.EXECUTION, suffix="ctrlexecstate")


def task(name: str) -> Topic:
    """The execution state of a task."""
    return Topic(name, ops.TASK, {"task": name}, "excstate")


def signal(name: str) -> Topic:
    """A signal's value, at once."""
    return Topic(name, ops.SIGNAL, {"signal": name}, "state", 2)


def symbol(path: str) -> Topic:
    """The value of a persistent `TASK/MODULE/NAME`, at once."""
    return Topic(path, ops.SYMBOL, {"symbol": path}, "value", 2)


_QUEUE = RwsOperation("GET /rw/dipc/{queue}", "GET /rw/dipc/{queue}")
_DIALOGS = RwsOperation("GET /rw/rapid/uiinstr", "GET /rw/rapid/uiinstr")


def queue(name: str) -> Topic:
    """Messages of a queue of this session; receiving removes them."""
    return Topic(name, _QUEUE, {"queue": name})


def dialogs() -> Topic:
    """Dialogs of programs: the instruction of the open one."""
    return Topic("dialogs", _DIALOGS, suffix="uievent")


def log(domain: int = 0) -> Topic:
    """Numbers of new entries in the event log."""
    return Topic(f"log {domain}", ops.ELOG, {"domain": str(domain)})
