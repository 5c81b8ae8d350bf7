"""Execution: start, stop, program pointer to main, cycle."""

from typing import TYPE_CHECKING

from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController
    from rapidgen.servers.rws.context import RwsContext

_START = {
    "regain": ("continue", "regain", "clear", "enterconsume"),
    "execmode": (
        "continue", "stepin", "stepover", "stepout", "stepback", "steplast", "stepmotion",
    ),
    "cycle": ("forever", "asis", "once"),
    "condition": ("none", "callchain"),
    "stopatbp": ("enabled", "disabled"),
    "alltaskbytsp": ("true", "false"),
}  # fmt: skip


def execution(controller: "VirtualController") -> str:
    """`running` while a NORMAL task is."""
    normal = (t for t in controller.rapid_tasks.values() if t.spec.type == "NORMAL")
    return "running" if any(t.state == "running" for t in normal) else "stopped"


@serves(ops.EXECUTION)
def get_execution(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether the program runs, and whether it begins again at its end."""
    state = {"ctrlexecstate": execution(office.controller), "cycle": office.controller.cycle}
    return show(Item("rap-execution", "execution", state))


@serves(ops.START)
def start(office: "RwsContext", asked: RwsRequest) -> None:
    """Start the program. The success says that it was asked for: it may not run [real 7.21]."""
    told = {name: asked.field(name, words) for name, words in _START.items()}
    controller = office.controller
    office.masters.need_start(asked)
    office.masters.need_mode(asked.session, "exec")
    if told["execmode"] != "continue":
        _step(office, told["execmode"])
        return
    _may_start(office, asked)
    if told["cycle"] != "asis":
        controller.cycle = "once" if told["cycle"] == "once" else "forever"
    controller.start_program()


def _may_start(office: "RwsContext", asked: RwsRequest) -> None:
    if office.masters.is_editing and office.strict:
        # Whoever holds mastership keeps RAPID from taking it [real 7.21].
        raise RequestDenied(
            403, "E_RESOURCE_HELD", "start is blocked while mastership is held", -13
        )
    if any(office.cabinet.programs.faults(t) for t in office.controller.rapid_tasks.values()):
        raise RequestDenied((asked.is_one and 400) or 403, "E_NO_PP", "errors in the program")


def _step(office: "RwsContext", mode: str) -> None:
    """One statement of each selected task: in manual mode only [VC 7.21]."""
    controller = office.controller
    if controller.mode == "auto":
        raise RequestDenied(403, "E_MODE_REJECT", "steps are for manual mode", -2)
    if mode not in ("stepin", "stepover", "stepback"):
        raise RequestDenied(403, "E_REJECT", f"{mode} is not offered here", -2)
    for task in controller.rapid_tasks.values():
        if task.spec.type != "NORMAL" or task.name in controller.operation.left_out:
            continue
        try:
            controller.tasks[task.name].step(back=mode == "stepback", over=mode == "stepover")
        except CannotStep as error:
            raise RequestDenied(403, "E_EXEC_STATE", str(error), -508) from error


@serves(ops.START_ENTRY)
def start_entry(office: "RwsContext", asked: RwsRequest) -> None:
    """Start at the entry routine: the program pointer goes to main first."""
    office.masters.need_start(asked)
    office.masters.need_mode(asked.session, "exec")
    _may_start(office, asked)
    reset_pp(office, asked)
    office.controller.start_program()


@serves(ops.STOP)
def stop(office: "RwsContext", asked: RwsRequest) -> None:
    """Stop the program; `alltsk` stops background tasks, too [real 7.21]."""
    mode = asked.field("stopmode", ("cycle", "instr", "stop", "qstop"))
    tasks = asked.form.get("usetsp", "normal")
    if tasks not in ("normal", "alltsk", "alltask"):
        raise RequestDenied(400, "E_INVALIDARG", f"usetsp {tasks}")
    controller = office.controller
    if mode == "cycle":
        controller.cycle = "once"
        return
    controller.operation.stop_program(quick=mode == "qstop")
    if tasks != "normal":
        for task in controller.rapid_tasks.values():
            task.stop()


@serves(ops.RESET_PP)
def reset_pp(office: "RwsContext", asked: RwsRequest) -> None:
    """Program pointers of all tasks to main."""
    # RobotWare 6 takes mastership by itself [code: abb_librws, abb_robot_client].
    office.masters.need(asked, "rapid", by_itself=asked.is_one)
    controller = office.controller
    if execution(controller) == "running":
        raise RequestDenied(400 if asked.is_one else 403, "E_EXEC_STATE", "the program runs", -508)
    faults = [d for t in controller.rapid_tasks.values() for d in office.cabinet.programs.faults(t)]
    if faults:
        syntax = any(d.code.startswith("RG2") for d in faults)
        name = "E_RAPID_SYNTAX_ERROR" if syntax else "E_RAPID_SEMANTIC_ERROR"
        raise RequestDenied(400 if asked.is_one else 403, name, faults[0].message, -507)
    controller.pp_to_main()


@serves(ops.SET_CYCLE)
def set_cycle(office: "RwsContext", asked: RwsRequest) -> None:
    """Whether the program begins again at its end."""
    cycle = asked.field("cycle", ("forever", "asis", "once"))
    if cycle != "asis":
        office.controller.cycle = "once" if cycle == "once" else "forever"
