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
    """Return `running` while a NORMAL task runs."""
    normal = (t for t in controller.rapid_tasks.values() if t.spec.type == "NORMAL")
    return "running" if any(t.state == "running" for t in normal) else "stopped"


@serves(ops.EXECUTION)
def get_execution(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether the program runs, and whether it repeats at its end."""
    state = {"ctrlexecstate": execution(context.controller), "cycle": context.controller.cycle}
    return show(Item("rap-execution", "execution", state))


@serves(ops.START)
def start(context: "RwsContext", request: RwsRequest) -> None:
    """Start the program.

    A success of RWS 2.0 means that the request was accepted: the program may not run, for example
    with motors off [real 7.21, VC 7.21]. RWS 1.0 rejects it, as in any wrong state [VC 6.16].
    """
    notify = {name: request.field(name, text) for name, text in _START.items()}
    controller = context.controller
    context.masters.need_start(request)
    context.masters.need_mode(request.session, "exec")
    if notify["execmode"] != "continue":
        _step(context, notify["execmode"])
        return
    _may_start(context, request)
    if notify["cycle"] != "asis":
        controller.cycle = "once" if notify["cycle"] == "once" else "forever"
    _start(context, request)


def _start(context: "RwsContext", request: RwsRequest) -> None:
    if not context.controller.start_program() and request.is_one and context.strict:
        raise RequestDenied(400, "E_EXEC_STATE", "start is not allowed in this state", -508)


def _may_start(context: "RwsContext", request: RwsRequest) -> None:
    if context.masters.is_editing and context.strict:
        # A client with mastership prevents RAPID from taking it [real 7.21].
        raise RequestDenied(
            403, "E_RESOURCE_HELD", "start is blocked while mastership is held", -13
        )
    if any(context.runner.programs.faults(t) for t in context.controller.rapid_tasks.values()):
        raise RequestDenied((request.is_one and 400) or 403, "E_NO_PP", "errors in the program")


def _step(context: "RwsContext", mode: str) -> None:
    """Execute one statement of each selected task.

    In manual mode only [VC 7.21].
    """
    controller = context.controller
    if controller.mode == "auto":
        raise RequestDenied(403, "E_MODE_REJECT", "steps are for manual mode", -2)
    if mode not in ("stepin", "stepover", "stepback"):
        raise RequestDenied(403, "E_REJECT", f"{mode} is not offered here", -2)
    for task in controller.rapid_tasks.values():
        if task.spec.type != "NORMAL" or task.name in controller.operation.omitted:
            continue
        try:
            controller.tasks[task.name].step(back=mode == "stepback", over=mode == "stepover")
        except CannotStep as error:
            raise RequestDenied(403, "E_EXEC_STATE", str(error), -508) from error


@serves(ops.START_ENTRY)
def start_entry(context: "RwsContext", request: RwsRequest) -> None:
    """Start at the entry routine, with the program pointer at main."""
    context.masters.need_start(request)
    context.masters.need_mode(request.session, "exec")
    _may_start(context, request)
    reset_pp(context, request)
    _start(context, request)


@serves(ops.STOP)
def stop(context: "RwsContext", request: RwsRequest) -> None:
    """Stop the program; `alltsk` also stops background tasks [real 7.21]."""
    mode = request.field("stopmode", ("cycle", "instr", "stop", "qstop"))
    tasks = request.form.get("usetsp", "normal")
    if tasks not in ("normal", "alltsk", "alltask"):
        raise RequestDenied(400, "E_INVALIDARG", f"usetsp {tasks}")
    controller = context.controller
    if mode == "cycle":
        controller.cycle = "once"
        return
    controller.operation.stop_program(quick=mode == "qstop")
    if tasks != "normal":
        for task in controller.rapid_tasks.values():
            task.stop()


@serves(ops.RESET_PP)
def reset_pp(context: "RwsContext", request: RwsRequest) -> None:
    """Set program pointers of all tasks to main."""
    # RobotWare 6 takes mastership by itself [code: abb_librws, abb_robot_client].
    context.masters.need(request, "rapid", by_itself=request.is_one)
    controller = context.controller
    if execution(controller) == "running":
        raise RequestDenied(
            400 if request.is_one else 403, "E_EXEC_STATE", "the program runs", -508
        )
    faults = [d for t in controller.rapid_tasks.values() for d in context.runner.programs.faults(t)]
    if faults:
        syntax = any(d.code.startswith("RG2") for d in faults)
        name = "E_RAPID_SYNTAX_ERROR" if syntax else "E_RAPID_SEMANTIC_ERROR"
        raise RequestDenied(400 if request.is_one else 403, name, faults[0].message, -507)
    controller.pp_to_main()


@serves(ops.SET_CYCLE)
def set_cycle(context: "RwsContext", request: RwsRequest) -> None:
    """Set whether the program repeats at its end."""
    cycle = request.field("cycle", ("forever", "asis", "once"))
    if cycle != "asis":
        context.controller.cycle = "once" if cycle == "once" else "forever"
