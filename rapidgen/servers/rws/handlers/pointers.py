"""Program pointers of tasks, read and set, and the call stack."""

from typing import TYPE_CHECKING

from rapidgen.runtime.errors import Location
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.handlers.execution import execution
from rapidgen.servers.rws.handlers.tasks import find_task
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


def place_of(task: Task) -> Location | None:
    """Return the position of a task; None before its start."""
    stack = task.stack()
    return task.pointer.next_statement() or (stack[-1] if stack else None)


@serves(ops.POINTER)
def get_pointer(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return program and motion pointer of a task.

    Both are equal here.
    """
    task = find_task(context, request.names["task"], request)
    place = place_of(task)
    if place is None:
        return show(Item("pcp-info", "progpointer", {"modulemame": "", "routinename": ""}))
    at = f"{place.span.line},{place.span.column}"
    notify = {
        "beginposition": at,
        "endposition": at,
        "modulemame": place.module,
        "routinename": place.routine,
        "changecount": str(context.runner.programs.changes[task.name]),
        "executiontype": "normal",
    }
    return show(Item("pcp-info", "progpointer", notify), Item("pcp-info", "motionpointer", notify))


@serves(ops.COUNTER)
def get_counter(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the program pointer as execution data of a task.

    The manual of RWS 1.0 has it in this form too.
    """
    place = place_of(find_task(context, request.names["task"], request))
    row, column = (place.span.line, place.span.column) if place else (0, 0)
    notify = {"module": place.module if place else "", "routine": place.routine if place else ""}
    notify |= {"startline": str(row), "startcol": str(column)}
    return show(Item("rap-pcp", "pcp", {**notify, "endline": str(row), "endcol": str(column)}))


def _movable(context: "RwsContext", request: RwsRequest) -> Task:
    context.masters.need(request, "rapid")
    task = find_task(context, request.names["task"], request)
    if task.state == "running" or execution(context.controller) == "running":
        raise RequestDenied(
            400 if request.is_one else 403, "E_EXEC_STATE", "the program runs", -508
        )
    return task


@serves(ops.POINTER_TO_ROUTINE)
def pointer_to_routine(context: "RwsContext", request: RwsRequest) -> None:
    """Set one task's program pointer to a routine."""
    task = _movable(context, request)
    try:
        context.controller.tasks[task.name].pp_to_routine(request.field("routine"))
    except CannotStep as error:
        raise RequestDenied(400, "E_ILLEGAL_ENTRYPOINT", str(error)) from error


@serves(ops.POINTER_TO_MAIN)
def pointer_to_main(context: "RwsContext", request: RwsRequest) -> None:
    """Set one task's program pointer to main."""
    context.controller.tasks[_movable(context, request).name].pp_to_main()


@serves(ops.POINTER_TO_CURSOR)
def pointer_to_cursor(context: "RwsContext", request: RwsRequest) -> None:
    """Set one task's program pointer to a statement of its routine."""
    task = _movable(context, request)
    request.field("module")
    field = request.kind("line", "begin-position-row")
    row = whole(field, request.field(field))
    try:
        context.controller.tasks[task.name].pp_to_statement(row)
    except CannotStep as error:
        raise RequestDenied(400, "E_ILLEGAL_ENTRYPOINT", str(error)) from error


@serves(ops.ACTIVATION_RECORD)
def get_frame(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one frame of the stack, from the innermost on.

    400 if there is none [VC 6.16].
    """
    task = find_task(context, request.names["task"], request)
    frames = task.stack()[::-1]
    number = whole("stackframe", request.query.get("stackframe", "1"), 1, len(frames))
    place = frames[number - 1]
    row, column = str(place.span.line), str(place.span.column)
    notify = {
        "execlevel": "Normal",
        "beg-row": row,
        "beg-col": column,
        "end-row": row,
        "end-col": column,
        "stack-url": f"RAPID/{task.name}/%{number}",
        "routine-url": f"RAPID/{task.name}/{place.module}/{place.routine}",
    }
    return show(Item("rap-stackframe", "stackframe", notify))


@serves(ops.ROUTINES)
def get_routines(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return procedures without parameters, callable as service routines."""
    task = find_task(context, request.names["task"], request)
    name, url = (
        request.kind("routine-name", "routine_name"),
        request.kind("url-to-routine", "url_to_routine"),
    )
    result = [
        Item(
            "rap-task-routine",
            node.name,
            {name: node.name, url: f"RAPID/{task.name}/{module.name}/{node.name}"},
        )
        for module in task.program.modules.values()
        for node in module.tree.routines
        if node.kind == "PROC" and not node.parameters and node.scope != "LOCAL"
    ]
    return show(*result, collection=True)
