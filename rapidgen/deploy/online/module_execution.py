"""Execution of one module on a controller over Robot Web Services, undone afterwards.

`make_execution_plan` reads only and rejects what is in doubt: a running program, a driver (unless
it is to be replaced), manual mode at full speed, a name that the controller has already.
`execute_module` then

1. stops the driver, if it is to be replaced,
2. copies the module to its own folder below HOME and saves modules that declare the same routine,
3. loads it, and asks the controller for build errors,
4. selects this task only, sets the speed and the program pointer,
5. starts one cycle and reports log events and program pointers until it ends.

Whatever happens, the steps are undone in reverse order: the module is unloaded, saved modules are
loaded again, and tasks, speed and program pointer get their earlier values. A program pointer can
only be set to the beginning of a routine over Robot Web Services.
"""

import time
from collections.abc import Callable
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rapidgen.client.rws.errors import NotConfirmed, RwsError
from rapidgen.client.rws.model import LogEvent, ProgramPointer
from rapidgen.diagnostics import DiagnosticError, Span, error, refusal, suggest
from rapidgen.rapid import parse
from rapidgen.rapid.syntax.nodes import Module, PlaceholderDeclaration

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

FOLDER = "HOME/rapidgen_execute"
_SCRATCH = "rapidgen_saved"
_LOOK = 0.2
"""s between two looks at program pointer and log."""
_ENABLING = 60.0
"""s for which the command waits for the enabling device in manual mode."""
_STARTED = 10151
"""Event: program started."""
_HALTED = 10125
"""Event: program stopped from outside, by a person, an input or the enabling device."""
_EVENTS = 50
"""Events of one look."""


@dataclass(frozen=True, slots=True)
class ExecutionPlan:
    """What an execution will do to a controller, found without changing it."""

    task: str
    module: str
    routine: str
    mode: str
    state: str
    speed: int
    pointer: ProgramPointer
    displaced: tuple[str, ...]
    """Modules that declare the routine, too: they are unloaded meanwhile."""
    others: tuple[str, ...]
    """Other selected tasks: they are left out meanwhile."""
    running: tuple[str, ...]
    """Tasks that run now: those of the driver, to be stopped."""


def make_execution_plan(
    services: "Controller",
    text: str,
    path: str,
    *,
    task: str = "",
    routine: str = "",
    replace_driver: bool = False,
) -> ExecutionPlan:
    """Return what an execution would do. Raises DiagnosticError RG756, RobotError."""
    tree = parse(text, path=path)
    faults = [d for d in tree.diagnostics if d.severity.value == "error"]
    if faults:
        raise DiagnosticError(faults)
    chosen = _routine(tree, path, routine)
    tasks = services.tasks()
    motion = [one.name for one in tasks if one.motion]
    names = [task] if task else motion
    if len(names) != 1 or names[0].lower() not in (one.lower() for one in motion):
        what = f"no motion task '{task}'" if task else f"{len(motion)} motion tasks"
        help = suggest(task, motion) or f"--task {' or '.join(motion)}"
        raise refusal("RG756", None, f"{services.where} has {what}", help, exit_code=1)
    name = next(one.name for one in tasks if one.name.lower() == names[0].lower())
    panel, pointer = services.panel(), services.pointer(name)
    running = tuple(one.name for one in tasks if one.execution == "started")
    _require_free(services, running, replace_driver=replace_driver)
    if panel.mode == "MANF":
        message = f"{services.where} is in manual mode at full speed"
        raise refusal("RG756", None, message, "select automatic or reduced speed", exit_code=1)
    displaced = _displaced(services, name, tree, chosen)
    others = tuple(
        one.name for one in tasks if one.kind == "normal" and one.active and one.name != name
    )
    return ExecutionPlan(
        name,
        tree.name,
        chosen,
        panel.mode,
        panel.state,
        panel.speed,
        pointer,
        displaced,
        others,
        running,
    )


def _routine(tree: Module, path: str, requested: str) -> str:
    """Return the routine to execute: the requested one, `main`, or the only procedure."""
    own = {
        r.name.lower(): r.name
        for r in tree.routines
        if r.kind == "PROC" and not r.parameters and r.scope != "LOCAL"
    }
    if requested.lower() in own:
        return own[requested.lower()]
    if not requested and ("main" in own or len(own) == 1):
        return own.get("main", next(iter(own.values())))
    what = (
        f"no global procedure '{requested}' without parameters"
        if requested
        else (f"{len(own)} procedures and no main")
    )
    help = suggest(requested, list(own.values())) or f"--routine {' or '.join(own.values())}"
    raise refusal("RG756", Span(path, 1, 1), f"{tree.name} has {what}", help)


def _require_free(
    services: "Controller", running: tuple[str, ...], *, replace_driver: bool
) -> None:
    """Raise RG756 if a program runs that must not be stopped."""
    driver = [name for name in running if name.upper().startswith("T_ROS")]
    if running and not driver:
        raise refusal(
            "RG756",
            None,
            f"a program runs at {services.where}: {', '.join(running)}",
            "stop it first: `rapidgen stop-program HOST --all`",
            exit_code=1,
        )
    if driver and not replace_driver:
        raise refusal(
            "RG756",
            None,
            f"the driver is active at {services.where}: {', '.join(running)}",
            "its clients lose the robot with --replace-driver",
            exit_code=1,
        )


def _displaced(services: "Controller", task: str, tree: Module, routine: str) -> tuple[str, ...]:
    """Return loaded modules with a routine of the same name.

    Raises RG756 if anything else of the module is declared there.
    """
    own = set(_global_names(tree))
    result = []
    for module in services.modules(task):
        if module.name.lower() == tree.name.lower():
            raise refusal(
                "RG756",
                None,
                f"{task} at {services.where} has a module '{module.name}'",
                "export under another name, or unload it",
                exit_code=1,
            )
        try:
            text = services.module_text(task, module.name)
        except RwsError:
            # Encrypted and installed modules have no text; the controller checks their names.
            continue
        names = _global_names(parse(text))
        common = own & set(names)
        if common - {routine.lower()}:
            listed = ", ".join(sorted(names[name] for name in common - {routine.lower()}))
            raise refusal(
                "RG756",
                None,
                f"module '{module.name}' in {task} declares {listed}, too",
                "use other names in the exported module",
                exit_code=1,
            )
        if common:
            result.append(module.name)
    return tuple(result)


def _global_names(tree: Module) -> dict[str, str]:
    """Return the names that a module declares in its task, by their lower-case form."""
    return {
        d.name.lower(): d.name
        for d in tree.declarations
        if not isinstance(d, PlaceholderDeclaration) and d.scope != "LOCAL"
    }


def execute_module(
    services: "Controller",
    plan: ExecutionPlan,
    data: bytes,
    *,
    percent: int,
    say: Callable[[str], None],
) -> tuple[LogEvent, ...]:
    """Execute a module once; return the events of the log.

    Raises DiagnosticError RG757 for build errors and RG758 if the program ends with an error,
    RobotError. KeyboardInterrupt stops the program first.
    """
    last = max((event.number for event in services.log(count=1)), default=0)
    with ExitStack() as undo:
        if plan.running:
            say(f"stopping {', '.join(plan.running)}")
            services.stop(everything=True)
        undo.callback(_restore_pointer, services, plan, say)
        with suppress(RwsError):
            services.make_folder(FOLDER)
        path = f"{FOLDER}/{plan.module}.mod"
        services.write_file(path, data)
        undo.callback(services.delete_file, path)
        for module in plan.displaced:
            _unload(services, plan, module, undo, say)
        say(f"loading {plan.module} into {plan.task}")
        services.load_module(plan.task, path)
        undo.callback(_unload_own, services, plan)
        faults = services.build_errors(plan.task)
        if faults:
            raise DiagnosticError(
                [
                    error("RG757", Span(f.module, f.row, f.column), f.text or "build error")
                    for f in faults
                ],
                exit_code=1,
            )
        for other in plan.others:
            services.select_task(other, False)
            undo.callback(services.select_task, other, True)
        if plan.mode == "AUTO":
            services.set_speed(percent)
            undo.callback(_restore_speed, services, plan, say)
        services.set_pointer(plan.task, plan.module, plan.routine)
        _motors_on(services, plan, say)
        undo.callback(_stop, services)
        _start(services, last)
        # In manual mode the speed ratio is the operator's.
        ratio = percent if plan.mode == "AUTO" else plan.speed
        say(f"started {plan.module}/{plan.routine} at {ratio} %")
        return _follow(services, plan, last, say)


def _unload(
    services: "Controller",
    plan: ExecutionPlan,
    module: str,
    undo: ExitStack,
    say: Callable[[str], None],
) -> None:
    """Save a module with its persistents, and unload it until the end."""
    saved = services.save_module(plan.task, module, _SCRATCH)
    text = services.read_file(saved)
    services.delete_file(saved)
    copy = f"{FOLDER}/{module}{'.modx' if saved.endswith('x') else '.mod'}"
    services.write_file(copy, text)
    if services.read_file(copy) != text:
        raise refusal("RG756", None, f"the copy of {module} differs", "try again", exit_code=1)
    say(f"unloading {module}, saved as {copy}")
    # A module with the pointer of a stopped program cannot be unloaded [code: an RWS 1 client].
    with suppress(RwsError):
        services.set_pointer(plan.task, module, plan.routine)
    services.unload_module(plan.task, module)

    def reload() -> None:
        say(f"loading {module} again")
        services.load_module(plan.task, copy)
        services.delete_file(copy)

    undo.callback(reload)


def _unload_own(services: "Controller", plan: ExecutionPlan) -> None:
    with suppress(RwsError):
        services.set_pointer(plan.task, plan.module, plan.routine)
    services.unload_module(plan.task, plan.module)


def _restore_pointer(
    services: "Controller", plan: ExecutionPlan, say: Callable[[str], None]
) -> None:
    at = plan.pointer
    if at.module and at.routine:
        services.set_pointer(plan.task, at.module, at.routine)
        say(f"program pointer of {plan.task} at the beginning of {at.module}/{at.routine}")


def _restore_speed(services: "Controller", plan: ExecutionPlan, say: Callable[[str], None]) -> None:
    # A robot that could not be stopped must not become faster.
    if services.execution().running:
        say("the program still runs: the speed stays as it is")
    else:
        services.set_speed(plan.speed)


def _stop(services: "Controller") -> None:
    # The start has started background tasks too; none ran before, and modules load only into a
    # controller where all stand.
    if any(task.execution == "started" for task in services.tasks()):
        services.stop(everything=True)


def _motors_on(services: "Controller", plan: ExecutionPlan, say: Callable[[str], None]) -> None:
    """Switch the motors on; in manual mode only the enabling device does that."""
    if plan.mode == "AUTO":
        if services.panel().state != "motoron":
            services.motors(True)
        return
    until = time.monotonic() + _ENABLING
    if services.panel().state != "motoron":
        say("press the enabling device")
    while services.panel().state != "motoron":
        if time.monotonic() > until:
            message = f"the motors of {services.where} are off"
            help = "hold the enabling device in its middle position"
            raise refusal("RG756", None, message, help, exit_code=1)
        time.sleep(_LOOK)


def _start(services: "Controller", last: int) -> None:
    """Start one cycle. A short program may have ended before the client sees it run."""
    try:
        services.start(cycle="once")
    except NotConfirmed:
        if not any(event.code == _STARTED for event in services.log(after=last, count=_EVENTS)):
            raise


def _follow(
    services: "Controller", plan: ExecutionPlan, last: int, say: Callable[[str], None]
) -> tuple[LogEvent, ...]:
    """Report until the program ends. Raises DiagnosticError RG758 for an error."""
    events: list[LogEvent] = []
    shown: tuple[str, int] | None = None
    running = True
    while running:
        # The last look comes after the end, so that no event is missed.
        running = services.execution().running
        for event in sorted(services.log(after=last, count=_EVENTS), key=lambda e: e.number):
            last = max(last, event.number)
            events.append(event)
            say(f"{event.type} {event.code}: {event.title}")
        at = services.pointer(plan.task)
        if (at.routine, at.row) != shown and at.module:
            shown = at.routine, at.row
            say(f"{at.module}/{at.routine}:{at.row}")
        if running:
            time.sleep(_LOOK)
    wrong = [event for event in events if event.type == "error"]
    if wrong:
        raise DiagnosticError(
            [
                error(
                    "RG758",
                    None,
                    f"event {event.code}: {event.title}",
                    f"`rapidgen explain {event.code}` names causes and remedies",
                    notes=tuple(filter(None, (event.description,))),
                )
                for event in wrong
            ],
            exit_code=1,
        )
    begun = max((event.number for event in events if event.code == _STARTED), default=0)
    if any(event.code == _HALTED and event.number > begun for event in events):
        message = f"{plan.module}/{plan.routine} was stopped before its end"
        help = "it was a person, an input or the enabling device: look at the robot, then try again"
        raise refusal("RG758", None, message, help, exit_code=1)
    return tuple(events)
