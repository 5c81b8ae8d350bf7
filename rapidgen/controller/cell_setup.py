"""The cell of a controller: signals, data, start positions, devices."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Protocol

from rapidgen.diagnostics import Diagnostic, DiagnosticError, error, suggest
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem, SignalCondition
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.operator import Operator
from rapidgen.machine.scheduler import S, Scheduler, SyncPoints
from rapidgen.machine.sensors import Camera, Measured, Seen
from rapidgen.motion.system import MotionSystem
from rapidgen.runtime.compiler.link import predefined_value
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import ModuleFile, SignalSpec, System

if TYPE_CHECKING:
    from rapidgen.config.cell import CellDescription, ReactionKeys
    from rapidgen.controller.inference.answers import Answer, PolledData, PolledSignals
    from rapidgen.controller.inference.names import DefaultedPersistent
    from rapidgen.controller.inference.peers import ExpectedMessages
    from rapidgen.controller.views import TaskView


# -- Set-up ----------------------------------------------------------------------------------------
#
# Effects of a cell description on a controller: signals and data of programs, start positions of
# robots, and devices that answer signals.


INFERRED_INPUT = 191_910
"""Event: an input without a source received the awaited value. The number is ours."""
_INPUT_DELAY = 0.5
"""Seconds that a program waits for an inferred input."""
Posture = tuple[float, ...]
"""Controller axes, rad and m, wire order."""


@dataclass(frozen=True, slots=True)
class CellSetup:
    """Surroundings of a controller, in addition to system and robots."""

    starts: Mapping[str, Posture] = field(default_factory=dict)
    """Start postures of robots by motion group; others start at 0."""
    reactions: "Sequence[ReactionKeys]" = ()
    guessed: frozenset[str] = frozenset()
    """Signals without a source, lower case: they receive the values that programs wait for."""
    polled: "tuple[PolledSignals, ...]" = ()
    """Where programs look for them in loops."""
    flags: "tuple[PolledData, ...]" = ()
    """Data that programs look at and do not set."""
    expected_messages: "ExpectedMessages | None" = None
    """Expected messages of programs at sockets without a peer."""
    cameras: Mapping[str, Camera] = field(default_factory=dict)
    """Results of cameras, by lower-case name."""
    force: Measured = field(default_factory=Measured)
    """Readings of force sensors."""
    divisors: frozenset[str] = frozenset()
    """Divisors in programs, lower case."""
    blank: "tuple[DefaultedPersistent, ...]" = ()
    """Data replaced by a predefined datum."""
    is_guess: bool = False
    """True if the cell is inferred: dialogs without an operator are answered, and all named I/O
    units exist."""
    is_any_robot: bool = False
    """True if the robots are inferred: unreachable targets do not stop the program."""
    placed: frozenset[str] = frozenset()
    """Groups whose start position the user chose."""
    partners: Mapping[str, tuple[str, int]] = field(default_factory=dict)
    """Partners of externally guided motion by device, lower case."""


@dataclass(frozen=True, slots=True)
class InferenceLog:
    """Events caused by an inferred cell; all lists grow during a run."""

    is_guess: bool = False
    answered: "list[Answer]" = field(default_factory=list)
    """Signals and dialogs, and what they became because a program waited for it."""
    missed: "list[Answer]" = field(default_factory=list)
    """Places of moves to where the robot does not come as programmed, and how it went there."""
    stopped: "list[Answer]" = field(default_factory=list)
    """Places where a program stopped after an answer and was restarted from main, with reasons."""
    disks: list[str] = field(default_factory=list)
    """Disks outside the controller that a program accessed, each an empty folder."""


class Booted(Protocol):
    """A controller that receives its surroundings."""

    @property
    def log(self) -> EventLog:
        """Event log of the controller."""

    io: IOSystem
    files: FileSystem
    operator: Operator
    motion: MotionSystem
    network: Network
    sockets: SocketTable
    meetings: SyncPoints
    scheduler: Scheduler
    rapid_tasks: dict[str, Task]

    def task(self, name: str) -> "TaskView":
        """Return a task."""


def apply_cell(
    system: System,
    cell: "CellDescription",
    data: Iterable[tuple[str, str, str]] = (),
    routines: str = "",
) -> System:
    """Return `system` with missing signals and data of `cell`.

    It also adds `data` (kind and type, name, initial value or nothing) and the declarations of
    `routines`. They are in an installed module, so declarations of a program hide them.
    DiagnosticError RG434: a device names an unknown signal.
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
    """Return new cameras of a cell, by lower-case name."""
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
    """Return the readings of the cell's force sensors."""
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
    for name in {name for grip in cell.attach for name in grip.when}:
        if name.casefold() not in names:
            yield error(
                "RG434",
                None,
                f"`attach` of the cell names '{name}', which is no signal",
                suggest(name, list(names.values())) or "declare it under `signals:`",
            )


def place_robots(controller: Booted, around: CellSetup) -> InferenceLog:
    """Set start positions and connect devices and inferred inputs.

    Devices observe their signals; inferred inputs receive the values that a program waits for.
    """
    guessed = InferenceLog(around.is_guess)
    answered = guessed.answered
    if around.is_guess:
        controller.files.inferred = guessed.disks
    for name, posture in around.starts.items():
        controller.motion.group(name).jump(posture)
    for reaction in around.reactions:
        _watch(controller, reaction)

    def answer(awaited: SignalCondition) -> None:
        signal, value = awaited.signal, awaited.fulfilling()

        def give() -> None:
            if value is not None and not awaited.holds():
                answered.append((signal.name, value))
                controller.log.info(
                    INFERRED_INPUT, "Guessed input", f"{signal.name} becomes {value:g}"
                )
                controller.io.set(signal, value)

        if signal.name.casefold() in around.guessed:
            controller.scheduler.after(round(_INPUT_DELAY * S), give)

    for row in around.blank:
        controller.task(row.task)[f"{row.module}:{row.name}"] = predefined_value(row.replacement)
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
    controller.motion.is_any_robot = around.is_any_robot
    controller.motion.moved |= around.placed
    if around.is_guess:
        controller.motion.on_missed = lambda place, how: guessed.missed.append((place, how))
    # With the real clock, a user answers through the control port.
    if (
        around.is_guess
        and not controller.operator.present
        and controller.scheduler.clock == "virtual"
    ):
        from rapidgen.controller.inference.answers import DialogResponder

        DialogResponder(controller.operator, controller.scheduler, answered)
    if around.expected_messages is not None and isinstance(controller.network, MemoryNetwork):
        from rapidgen.controller.inference.peers import SocketPeer

        SocketPeer(controller, around.expected_messages, answered)
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
