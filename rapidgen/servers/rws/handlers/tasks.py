"""Tasks, their modules and program pointers."""

from dataclasses import replace
from typing import TYPE_CHECKING

from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.loading import module_text
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.context import disk_path
from rapidgen.servers.rws.handlers.execution import execution
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_EXECUTION = {
    "running": "started", "stopped": "stopped", "error": "stopped", "finished": "stopped",
    "ready": "ready", "empty": "uninitialized",
}  # fmt: skip
# RobotWare 6 answers with other statuses than 7 [VC 6.16, VC 7.21].
_STATUS = {
    "E_EXEC_STATE": (400, 403), "E_NO_SUCH_SYMBOL": (400, 404), "E_FILE_NOT_FOUND": (400, 404),
    "E_MOD_AMBNAME": (400, 400), "E_MOD_WRITE_PROTECTED": (403, 403),
    "E_TOO_BIG_MODULE": (400, 400),
}  # fmt: skip


def find_task(context: "RwsContext", name: str, request: RwsRequest) -> Task:
    """Return a task by name.

    RequestDenied: there is none (400 on RobotWare 6, 404 on 7).
    """
    for task in context.controller.rapid_tasks.values():
        if task.name.lower() == name.lower():
            return task
    raise RequestDenied(400 if request.is_one else 404, "E_INVALIDARG", f"no task {name}")


def execution_state(task: Task, request: RwsRequest) -> str:
    """Return a task's execution state.

    RobotWare 6 cuts the words to four letters [code: librws].
    """
    word = _EXECUTION[task.state]
    return word[:4] if request.is_one else word


def _item(context: "RwsContext", task: Task, kind: str, request: RwsRequest) -> Item:
    kind_of_task = task.spec.type.lower()
    modules = context.runner.programs.modules(task)
    state = "linked" if task.state != "empty" else "loaded" if modules else "empty"
    notify = {
        "name": task.name,
        "type": kind_of_task[:4] if request.is_one else kind_of_task,
        "taskstate": state,
        "excstate": execution_state(task, request),
    }
    if task.spec.type == "NORMAL":
        notify["active"] = "Off" if task.name in context.controller.operation.omitted else "On"
        notify["motiontask"] = "TRUE" if task.spec.motion else "FALSE"
    if kind == "rap-task":
        notify |= {"trust": task.spec.trust, "prodentrypt": task.spec.entry}
    return Item(kind, task.name, notify, {"self": f"tasks/{task.name}"})


@serves(ops.TASKS)
def get_tasks(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return all tasks."""
    tasks = context.controller.rapid_tasks.values()
    return show(*(_item(context, t, "rap-task-li", request) for t in tasks), collection=True)


@serves(ops.TASK)
def get_task(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one task."""
    return show(
        _item(context, find_task(context, request.names["task"], request), "rap-task", request)
    )


@serves(ops.ACTIVATE_ALL, ops.DEACTIVATE_ALL)
def activate_all(context: "RwsContext", request: RwsRequest) -> None:
    """Select all NORMAL tasks at once."""
    for task in context.controller.rapid_tasks.values():
        if task.spec.type == "NORMAL":
            activate(context, replace(request, names={"task": task.name}))


@serves(ops.TASK_SELECTION)
def selection(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the task selection panel [VC 7.21]."""
    left_out = context.controller.operation.omitted
    result = [
        Item(
            "rap-taskselection",
            task.name,
            {
                "name": task.name,
                "state": "OFF" if task.name in left_out else "ON",
                "motiontask": "TRUE" if task.spec.motion else "FALSE",
                "usermodify": "TRUE",
            },
        )
        for task in context.controller.rapid_tasks.values()
        if task.spec.type == "NORMAL"
    ]
    return show(*result, collection=True)


@serves(ops.CHANGE_COUNT)
def change_count(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the number of changes of a task's program."""
    task = find_task(context, request.names["task"], request)
    count = str(context.runner.programs.changes[task.name])
    notify = {"struc-change-count": count, "change-count": count}
    return show(Item("rap-task-struc-change-count", task.name, notify))


@serves(ops.ACTIVATE, ops.DEACTIVATE)
def activate(context: "RwsContext", request: RwsRequest) -> None:
    """Select the NORMAL tasks that start with the program.

    This is the task selection panel.
    """
    # RobotWare 6 takes mastership by itself [RWS manual].
    context.masters.need(request, "rapid", by_itself=request.is_one)
    task = find_task(context, request.names.get("task") or request.field("task"), request)
    if task.spec.type != "NORMAL":
        raise RequestDenied(403, "E_REJECT", f"{task.name} is a background task", -2)
    if execution(context.controller) == "running":
        raise RequestDenied(
            400 if request.is_one else 403, "E_EXEC_STATE", "the program runs", -508
        )
    left_out = context.controller.operation.omitted
    if "deactivate" in (request.query.get("action"), request.path.rpartition("/")[2]):
        left_out.add(task.name)
    else:
        left_out.discard(task.name)


# -- modules -------------------------------------------------------------------------------------


def task_to_boot(context: "RwsContext", request: RwsRequest) -> Task:
    """Return the task of a path, or of `?task=` in RWS 1.0.

    Raises RequestDenied.
    """
    name = request.names.get("task") or request.query.get("task", "")
    return find_task(context, name, request)


@serves(ops.MODULES)
def get_modules(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the modules of a task.

    HAL has them in `state`, though they are many [VC 7.21].
    """
    task = task_to_boot(context, request)
    result = context.runner.programs.modules(task)
    return show(
        *(
            Item(
                "rap-module-info-li",
                f"{task.name}/{module.name}",
                {"name": module.name, "type": "SysMod" if module.is_system else "ProgMod"},
            )
            for module in result
        )
    )


@serves(ops.MODULE)
def get_module(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the file of one module."""
    task, name = task_to_boot(context, request), request.names["module"]
    result = [m for m in context.runner.programs.modules(task) if m.name.lower() == name.lower()]
    if not result:
        raise no_module(request, name)
    file = result[0].file
    notify = {"modname": result[0].name, "filename": file.target or file.path, "attribute": ""}
    return show(Item("rap-module", result[0].name, notify))


def no_module(request: RwsRequest, name: str) -> RequestDenied:
    """Return the answer for a missing module."""
    return RequestDenied(
        400 if request.is_one else 404, "E_NO_SUCH_SYMBOL", f"no module {name}", -517
    )


@serves(ops.LOAD_MODULE)
def load_module(context: "RwsContext", request: RwsRequest) -> RwsResponse | None:
    """Load a module; `builderror` reports its errors, not this answer.

    [VC 7.21]
    """
    context.masters.need(request, "rapid")
    task = find_task(context, request.names["task"], request)
    text = request.field("modulepath")
    replaced = request.form.get("replace", "false").lower() == "true"
    path = disk_path(context, text, request)
    try:
        name = context.runner.programs.load(task, path, text, replaced=replaced)
    except CannotLoad as fault:
        raise load_refused(request, fault, text) from fault
    if request.is_one:
        return None
    return show(Item("rap-task-module-li", name, {"name": name}))


@serves(ops.UNLOAD_MODULE)
def unload_module(context: "RwsContext", request: RwsRequest) -> None:
    """Unload a module of a task."""
    context.masters.need(request, "rapid")
    task = find_task(context, request.names["task"], request)
    name = request.field("module")
    try:
        context.runner.programs.unload(task, name)
    except CannotLoad as fault:
        raise load_refused(request, fault, name) from fault


def load_refused(request: RwsRequest, fault: CannotLoad, what: str) -> RequestDenied:
    """Return the answer to a module that cannot be loaded or saved."""
    name = str(fault)
    return RequestDenied(_STATUS[name][0 if request.is_one else 1], name, what, -507)


@serves(ops.SAVE_MODULE)
def save_module(context: "RwsContext", request: RwsRequest) -> None:
    """Save a module with its current persistents.

    The file name gets an extension.
    """
    task, name = task_to_boot(context, request), request.names["module"]
    module = task.program.modules.get(name.lower())
    if module is None:
        raise no_module(request, name)
    folder = request.field("path")
    if not request.is_one and not folder.endswith(":"):
        raise RequestDenied(400, "E_INVALID_PATH", folder)  # the root of a volume only [VC 7.21]
    ending = ".mod" if request.is_one else ".modx"
    path = disk_path(context, f"{folder.rstrip('/')}/{request.field('name')}{ending}", request)
    text = module_text(task, module)
    context.write_file(path, text.encode(module.tree.source.encoding, "replace"))
