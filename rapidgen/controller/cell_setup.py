"""The cell of a controller."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Protocol

from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, error, suggest
from rapidgen.generate.context import data_of_another
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem, SignalCondition
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.operator import Operator
from rapidgen.machine.scheduler import S, Scheduler, SyncPoints
from rapidgen.machine.sensors import Camera, Measured, Seen
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid import parse
from rapidgen.runtime.compiler.link import predefined_value
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec

if TYPE_CHECKING:
    from rapidgen.config.cell import CellDescription, ReactionKeys
    from rapidgen.controller.inference.answers import Answer, PolledData, PolledSignals
    from rapidgen.controller.inference.names import DefaultedPersistent
    from rapidgen.controller.inference.peers import ExpectedMessages
    from rapidgen.controller.views import TaskView


# -- Objects of the customer -----------------------------------------------------------------------
#
# What stands around a controller and is in none of its generated files.
#
# A configuration exposes signals of the cell to clients. They are the customer's: his own EIO.cfg
# defines them, with units and bits, so that a generated one must not. Whoever boots a driver here
# gets them as virtual signals of the types that the configuration names. So with a tool, a work
# object or a load that a module of his declares.
#
# With `main: own` the customer has a `main` that calls the driver. Where his is not there, one that
# does nothing else stands in for it.


GROUP_BITS = 32
"""Bits of an exposed group signal; the configuration does not tell how many there are."""
_MAIN = ModuleFile(
    "own_main",
    "own_main.mod",
    b"MODULE own_main\n    PROC main()\n        ROS_run;\n    ENDPROC\nENDMODULE\n",
)


def in_its_cell(system: System, config: RobotConfig) -> System:
    """`system` with what `config` leaves to the customer: signals and, where it is own, `main`.

    What the system has already stays as it is.
    """
    known = {signal.name.lower() for signal in system.signals}
    exposed = tuple(
        SignalSpec(signal.name, signal.kind, size=GROUP_BITS if signal.kind[0] == "G" else 1)
        for signal in config.signals
        if signal.name.lower() not in known
    )
    tasks = system.tasks if config.call_main else tuple(_with_main(t) for t in system.tasks)
    tasks = tuple(_with_data(task, config) for task in tasks)
    return replace(system, tasks=tasks, signals=(*system.signals, *exposed))


def _with_main(task: TaskSpec) -> TaskSpec:
    if not task.motion or any(_has_main(module) for module in task.modules):
        return task
    return replace(task, modules=(*task.modules, _MAIN))


def _with_data(task: TaskSpec, config: RobotConfig) -> TaskSpec:
    """A task with the data that its modules take from another module, unless one declares them."""
    group = next((g for g in config.groups if g.task == task.name), None)
    data = data_of_another(group) if group is not None and task.motion else []
    if not data:
        return task
    known = {d.name.casefold() for m in task.modules for d in parse(m.data, path=m.path).data}
    expected = [
        f"    PERS {kind} {name} := {value};\n"
        for kind, name, value in data
        if name.casefold() not in known
    ]
    if not expected:
        return task
    text = f"MODULE own_data\n{''.join(expected)}ENDMODULE\n".encode("ascii")
    return replace(task, modules=(*task.modules, ModuleFile("own_data", "own_data.mod", text)))


def _has_main(module: ModuleFile) -> bool:
    return any(r.name.casefold() == "main" for r in parse(module.data, path=module.path).routines)


# -- Set-up ----------------------------------------------------------------------------------------
#
# What the description of a cell does to a controller: signals and data that its programs find,
# where its robots stand at first, and devices that answer signals.


GUESSED = 49_910
"""Event: an input that nobody drives became what a program waits for. The number is ours."""
_PATIENCE = 0.5
"""Seconds that a program waits for a guessed input."""
Posture = tuple[float, ...]
"""Controller axes, rad and m, wire order."""


@dataclass(frozen=True, slots=True)
class CellSetup:
    """What a controller is booted into, beside its system and robots."""

    starts: Mapping[str, Posture] = field(default_factory=dict)
    """Where the robots stand, by motion group; others stand at 0."""
    reactions: "Sequence[ReactionKeys]" = ()
    guessed: frozenset[str] = frozenset()
    """Signals that nobody drives, lower case: they become what somebody waits for."""
    polled: "tuple[PolledSignals, ...]" = ()
    """Where programs look for them in loops."""
    flags: "tuple[PolledData, ...]" = ()
    """Data that programs look at and do not set."""
    heard: "ExpectedMessages | None" = None
    """What programs listen for at sockets that nobody else is at."""
    cameras: Mapping[str, Camera] = field(default_factory=dict)
    """What cameras see, by lower-case name."""
    force: Measured = field(default_factory=Measured)
    """What force sensors measure."""
    divisors: frozenset[str] = frozenset()
    """What programs divide by, lower case."""
    blank: "tuple[DefaultedPersistent, ...]" = ()
    """Data that a predefined one stands in for."""
    is_guess: bool = False
    """Whether dialogs are answered that nobody else is there for, and I/O units are as named."""
    is_any_robot: bool = False
    """Whether the robots are a guess: places that they do not reach do not stop the program."""


@dataclass(frozen=True, slots=True)
class InferenceLog:
    """What happened because a cell is a guess; all grow while programs run."""

    is_guess: bool = False
    answered: "list[Answer]" = field(default_factory=list)
    """Signals and dialogs, and what they became because a program waited for it."""
    missed: "list[Answer]" = field(default_factory=list)
    """Places of moves to where the robot does not come as programmed, and how it went there."""
    stopped: "list[Answer]" = field(default_factory=list)
    """Where a program stopped behind an answer and was started from main again, and why."""


class Booted(Protocol):
    """A controller that is put into its surroundings."""

    @property
    def log(self) -> EventLog:
        """Its event log."""

    io: IOSystem
    operator: Operator
    motion: MotionSystem
    network: Network
    sockets: SocketTable
    meetings: SyncPoints
    scheduler: Scheduler
    rapid_tasks: dict[str, Task]

    def task(self, name: str) -> "TaskView":
        """One task."""


def apply_cell(
    system: System,
    cell: "CellDescription",
    data: Iterable[tuple[str, str, str]] = (),
    routines: str = "",
) -> System:
    """`system` with the signals and the data of `cell` that it does not have itself, with further
    `data` (kind and type, name, initial value or nothing) and the declarations of `routines`.

    They are those of an installed module: a program's own hide them. Raises DiagnosticError
    RG434 for a device that names a signal which nobody has.
    """
    known = {signal.name.casefold() for signal in system.signals}
    signals = tuple(
        SignalSpec(
            name,
            keys.kind,
            default=keys.value,
            size=keys.size if keys.kind[0] == "G" else 1,
        )
        for name, keys in cell.signals.items()
        if name.casefold() not in known
    )
    seen = {name.casefold() for name in system.cameras}
    cameras = (*system.cameras, *(name for name in cell.cameras if name.casefold() not in seen))
    system = replace(system, signals=(*system.signals, *signals), cameras=cameras)
    faults = list(_nameless(system, cell))
    if faults:
        raise DiagnosticError(faults)
    text = "".join(
        f"    TASK PERS {kind} {name} := {value};\n" for kind, name, value in _data(cell)
    )
    text += "".join(
        f"    {kind} {name}{' := ' if value else ''}{value};\n" for kind, name, value in data
    )
    text += routines
    if not text:
        return system
    module = ModuleFile(
        "cell_data",
        "cell_data.sys",
        f"MODULE cell_data(SYSMODULE)\n{text}ENDMODULE\n".encode("ascii"),
        installed=True,
    )
    tasks = (replace(task, modules=(module, *task.modules)) for task in system.tasks)
    return replace(system, tasks=tuple(tasks))


def cameras_of(cell: "CellDescription", *, is_guess: bool) -> dict[str, Camera]:
    """The cameras of a cell, by lower-case name; a new set for each controller."""
    return {
        name.casefold(): Camera(
            name,
            [
                [
                    Seen(
                        one.name,
                        (one.position[0], one.position[1], one.position[2]),
                        one.angle,
                        one.type,
                        tuple(one.values),
                        tuple(one.texts),
                    )
                    for one in image
                ]
                for image in keys.images
            ],
            {parameter.casefold(): value for parameter, value in keys.parameters.items()},
            is_guess,
        )
        for name, keys in cell.cameras.items()
    }


def force_of(cell: "CellDescription") -> Measured:
    """What the force sensors of a cell measure."""
    keys = cell.force
    if keys is None:
        return Measured()
    return Measured([tuple(row) for row in keys.readings], keys.mass, tuple(keys.center))


def _data(cell: "CellDescription") -> Iterator[tuple[str, str, str]]:
    from rapidgen.generate.context import load_literal, tool_literal, work_object_literal

    for tool in cell.tools:
        yield "tooldata", tool.name, tool_literal(tool)
    for wobj in cell.work_objects:
        yield "wobjdata", wobj.name, work_object_literal(wobj)
    for name, load in cell.loads.items():
        yield "loaddata", name, load_literal(load)


def _nameless(system: System, cell: "CellDescription") -> Iterator[Diagnostic]:
    names = {signal.name.casefold(): signal.name for signal in system.signals}
    for device, reactions in cell.devices.items():
        for reaction in reactions:
            for name in (*reaction.when, *reaction.then):
                if name.casefold() not in names:
                    yield error(
                        "RG434",
                        None,
                        f"device '{device}' of the cell names '{name}', which is no signal",
                        suggest(name, list(names.values())) or "declare it under `signals:`",
                    )


def place_robots(controller: Booted, around: CellSetup) -> InferenceLog:
    """Put the robots where they start, let devices watch their signals, and guessed inputs become
    what a program waits for."""
    guessed = InferenceLog(around.is_guess)
    answered = guessed.answered
    for name, posture in around.starts.items():
        controller.motion.group(name).jump(posture)
    for reaction in around.reactions:
        _watch(controller, reaction)

    def answer(awaited: SignalCondition) -> None:
        signal, value = awaited.signal, awaited.fulfilling()

        def give() -> None:
            if value is not None and not awaited.holds():
                answered.append((signal.name, value))
                controller.log.info(GUESSED, "Guessed input", f"{signal.name} becomes {value:g}")
                controller.io.set(signal, value)

        if signal.name.casefold() in around.guessed:
            controller.scheduler.after(round(_PATIENCE * S), give)

    for row in around.blank:
        controller.task(row.task)[f"{row.module}:{row.name}"] = predefined_value(row.stands)
    if around.guessed:
        controller.io.on_awaited = answer
    if around.polled:
        from rapidgen.controller.inference.answers import InputSetter

        InputSetter(controller, around.polled, answered)
    if around.flags and controller.scheduler.clock == "virtual":
        from rapidgen.controller.inference.answers import DataSetter

        DataSetter(controller, around.flags, answered)
    controller.io.divisors = around.divisors
    controller.io.any_unit = controller.meetings.any_task = around.is_guess
    if around.is_any_robot:
        controller.motion.on_missed = lambda place, how: guessed.missed.append((place, how))
    # Beside a real clock a person sits, who answers by the control port.
    if (
        around.is_guess
        and not controller.operator.present
        and controller.scheduler.clock == "virtual"
    ):
        from rapidgen.controller.inference.answers import DialogResponder

        DialogResponder(controller.operator, controller.scheduler, answered)
    if around.heard is not None and isinstance(controller.network, MemoryNetwork):
        from rapidgen.controller.inference.peers import SocketPeer

        SocketPeer(controller, around.heard, answered)
    return guessed


def _watch(controller: Booted, reaction: "ReactionKeys") -> None:
    io = controller.io
    held = False

    def follow() -> None:
        for name, value in reaction.then.items():
            io.set(io[name], value)

    def look() -> None:
        nonlocal held
        holds = all(io[name].value == value for name, value in reaction.when.items())
        if holds and not held:
            controller.scheduler.after(round(reaction.after * S), follow)
        held = holds

    for name in reaction.when:
        io[name].changed.add(look)
    look()
