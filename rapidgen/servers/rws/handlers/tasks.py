"""Tasks, their modules and program pointers."""

from dataclasses import replace
from typing import TYPE_CHECKING

from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.loading import module_text
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.disks import disk_path
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
# RobotWare 6 answers by other statuses than 7 [VC 6.16, VC 7.21].
_STATUS = {
    "E_EXEC_STATE": (400, 403), "E_NO_SUCH_SYMBOL": (400, 404), "E_FILE_NOT_FOUND": (400, 404),
    "E_MOD_AMBNAME": (400, 400), "E_MOD_WRITE_PROTECTED": (403, 403),
    "E_TOO_BIG_MODULE": (400, 400),
}  # fmt: skip


def find_task(office: "RwsContext", name: str, asked: RwsRequest) -> Task:
    """A task by name. Denied: there is none (400 on RobotWare 6, 404 on 7)."""
    for task in office.controller.rapid_tasks.values():
        if task.name.lower() == name.lower():
            return task
    raise RequestDenied(400 if asked.is_one else 404, "E_INVALIDARG", f"no task {name}")


def execution_state(task: Task, asked: RwsRequest) -> str:
    """A task's execution state; RobotWare 6 cuts the words to four letters [code: librws]."""
    word = _EXECUTION[task.state]
    return word[:4] if asked.is_one else word


def _item(office: "RwsContext", task: Task, kind: str, asked: RwsRequest) -> Item:
    kind_of_task = task.spec.type.lower()
    modules = office.cabinet.programs.modules(task)
    state = "linked" if task.state != "empty" else "loaded" if modules else "empty"
    told = {
        "name": task.name,
        "type": kind_of_task[:4] if asked.is_one else kind_of_task,
        "taskstate": state,
        "excstate": execution_state(task, asked),
    }
    if task.spec.type == "NORMAL":
        told["active"] = "Off" if task.name in office.controller.operation.left_out else "On"
        told["motiontask"] = "TRUE" if task.spec.motion else "FALSE"
    if kind == "rap-task":
        told |= {"trust": task.spec.trust, "prodentrypt": task.spec.entry}
    return Item(kind, task.name, told, {"self": f"tasks/{task.name}"})


@serves(ops.TASKS)
def get_tasks(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """All tasks."""
    tasks = office.controller.rapid_tasks.values()
    return show(*(_item(office, t, "rap-task-li", asked) for t in tasks), collection=True)


@serves(ops.TASK)
def get_task(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """One task."""
    return show(_item(office, find_task(office, asked.names["task"], asked), "rap-task", asked))


@serves(ops.ACTIVATE_ALL, ops.DEACTIVATE_ALL)
def activate_all(office: "RwsContext", asked: RwsRequest) -> None:
    """All NORMAL tasks at once."""
    for task in office.controller.rapid_tasks.values():
        if task.spec.type == "NORMAL":
            activate(office, replace(asked, names={"task": task.name}))


@serves(ops.TASK_SELECTION)
def selection(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """The task selection panel [VC 7.21]."""
    left_out = office.controller.operation.left_out
    found = [
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
        for task in office.controller.rapid_tasks.values()
        if task.spec.type == "NORMAL"
    ]
    return show(*found, collection=True)


@serves(ops.CHANGE_COUNT)
def change_count(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """How often a task's program was changed."""
    task = find_task(office, asked.names["task"], asked)
    count = str(office.cabinet.programs.changes[task.name])
    told = {"struc-change-count": count, "change-count": count}
    return show(Item("rap-task-struc-change-count", task.name, told))


@serves(ops.ACTIVATE, ops.DEACTIVATE)
def activate(office: "RwsContext", asked: RwsRequest) -> None:
    """The task selection panel: which NORMAL tasks are started with the program."""
    # RobotWare 6 takes mastership by itself [RWS manual].
    office.masters.need(asked, "rapid", by_itself=asked.is_one)
    task = find_task(office, asked.names.get("task") or asked.field("task"), asked)
    if task.spec.type != "NORMAL":
        raise RequestDenied(403, "E_REJECT", f"{task.name} is a background task", -2)
    if execution(office.controller) == "running":
        raise RequestDenied(400 if asked.is_one else 403, "E_EXEC_STATE", "the program runs", -508)
    left_out = office.controller.operation.left_out
    if "deactivate" in (asked.query.get("action"), asked.path.rpartition("/")[2]):
        left_out.add(task.name)
    else:
        left_out.discard(task.name)


# -- modules -------------------------------------------------------------------------------------


def task_to_boot(office: "RwsContext", asked: RwsRequest) -> Task:
    """The task that a path, or `?task=` of RWS 1.0, names. Denied."""
    name = asked.names.get("task") or asked.query.get("task", "")
    return find_task(office, name, asked)


@serves(ops.MODULES)
def get_modules(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Modules of a task; they stand in `state` in HAL, though they are many [VC 7.21]."""
    found = office.cabinet.programs.modules(task_to_boot(office, asked))
    return show(
        *(
            Item(
                "rap-module-info-li",
                module.name,
                {"name": module.name, "type": "SysMod" if module.is_system else "ProgMod"},
            )
            for module in found
        )
    )


@serves(ops.MODULE)
def get_module(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """One module: its file."""
    task, name = task_to_boot(office, asked), asked.names["module"]
    found = [m for m in office.cabinet.programs.modules(task) if m.name.lower() == name.lower()]
    if not found:
        raise no_module(asked, name)
    file = found[0].file
    told = {"modname": found[0].name, "filename": file.target or file.path, "attribute": ""}
    return show(Item("rap-module", found[0].name, told))


def no_module(asked: RwsRequest, name: str) -> RequestDenied:
    """The answer for a module that is not there."""
    return RequestDenied(
        400 if asked.is_one else 404, "E_NO_SUCH_SYMBOL", f"no module {name}", -517
    )


@serves(ops.LOAD_MODULE)
def load_module(office: "RwsContext", asked: RwsRequest) -> RwsResponse | None:
    """Load a module; what is wrong in it is told by `builderror`, not here [VC 7.21]."""
    office.masters.need(asked, "rapid")
    task = find_task(office, asked.names["task"], asked)
    words = asked.field("modulepath")
    replaced = asked.form.get("replace", "false").lower() == "true"
    path = disk_path(office, words, asked)
    try:
        name = office.cabinet.programs.load(task, path, words, replaced=replaced)
    except CannotLoad as fault:
        raise load_refused(asked, fault, words) from fault
    if asked.is_one:
        return None
    return show(Item("rap-task-module-li", name, {"name": name}))


@serves(ops.UNLOAD_MODULE)
def unload_module(office: "RwsContext", asked: RwsRequest) -> None:
    """Take a module out of a task."""
    office.masters.need(asked, "rapid")
    task = find_task(office, asked.names["task"], asked)
    name = asked.field("module")
    try:
        office.cabinet.programs.unload(task, name)
    except CannotLoad as fault:
        raise load_refused(asked, fault, name) from fault


def load_refused(asked: RwsRequest, fault: CannotLoad, what: str) -> RequestDenied:
    """The answer to a module that is not taken, or not given away."""
    name = str(fault)
    return RequestDenied(_STATUS[name][0 if asked.is_one else 1], name, what, -507)


@serves(ops.SAVE_MODULE)
def save_module(office: "RwsContext", asked: RwsRequest) -> None:
    """Write a module with the present values of its persistents; an ending is put behind."""
    task, name = task_to_boot(office, asked), asked.names["module"]
    module = task.program.modules.get(name.lower())
    if module is None:
        raise no_module(asked, name)
    folder = asked.field("path")
    if not asked.is_one and not folder.endswith(":"):
        raise RequestDenied(400, "E_INVALID_PATH", folder)  # the root of a volume only [VC 7.21]
    ending = ".mod" if asked.is_one else ".modx"
    path = disk_path(office, f"{folder.rstrip('/')}/{asked.field('name')}{ending}", asked)
    text = module_text(task, module)
    office.write_file(path, text.encode(module.tree.source.encoding, "replace"))
