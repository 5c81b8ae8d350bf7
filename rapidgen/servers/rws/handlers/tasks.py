"""Execution, tasks and their program pointers."""

from dataclasses import replace
from typing import TYPE_CHECKING

from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.errors import Location
from rapidgen.runtime.loading import module_text
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.handlers.files import disk_path, write_file
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.servers.rws.subscriptions import EventSource, Topic, new_values, subscribable
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController


# -- execution -------------------------------------------------------------------------------------

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


def _must_stand(app: RwsApplication, request: RwsRequest, task: Task | None = None) -> None:
    """RequestDenied: the program runs, or this task does."""
    if execution(app.controller) == "running" or (task is not None and task.state == "running"):
        status = 400 if request.is_one else 403
        raise RequestDenied(status, "E_EXEC_STATE", "the program runs", -508)


@serves(ops.EXECUTION)
def get_execution(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether the program runs, and whether it repeats at its end."""
    state = {"ctrlexecstate": execution(app.controller), "cycle": app.controller.cycle}
    return show(Item("rap-execution", "execution", state))


@serves(ops.START)
def start(app: RwsApplication, request: RwsRequest) -> None:
    """Start the program.

    A success of RWS 2.0 means that the request was accepted: the program may not run, for example
    with motors off [real 7.21, VC 7.21]. RWS 1.0 rejects it, as in any wrong state [VC 6.16].
    """
    notify = {name: request.field(name, text) for name, text in _START.items()}
    controller = app.controller
    app.masterships.need_start(request)
    app.masterships.need_mode(request.session, "exec")
    if notify["execmode"] != "continue":
        _step(app, notify["execmode"])
        return
    _may_start(app, request)
    if notify["cycle"] != "asis":
        controller.cycle = "once" if notify["cycle"] == "once" else "forever"
    _start(app, request)


def _start(app: RwsApplication, request: RwsRequest) -> None:
    if not app.controller.start_program() and request.is_one and app.strict:
        raise RequestDenied(400, "E_EXEC_STATE", "start is not allowed in this state", -508)


def _may_start(app: RwsApplication, request: RwsRequest) -> None:
    if app.masterships.is_editing and app.strict:
        # A client with mastership prevents RAPID from taking it [real 7.21].
        raise RequestDenied(
            403, "E_RESOURCE_HELD", "start is blocked while mastership is held", -13
        )
    if any(app.runner.programs.faults(t) for t in app.controller.rapid_tasks.values()):
        raise RequestDenied((request.is_one and 400) or 403, "E_NO_PP", "errors in the program")


def _step(app: RwsApplication, mode: str) -> None:
    """Execute one statement of each selected task.

    In manual mode only [VC 7.21].
    """
    controller = app.controller
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
def start_entry(app: RwsApplication, request: RwsRequest) -> None:
    """Start at the entry routine, with the program pointer at main."""
    app.masterships.need_start(request)
    app.masterships.need_mode(request.session, "exec")
    _may_start(app, request)
    reset_pp(app, request)
    _start(app, request)


@serves(ops.STOP)
def stop(app: RwsApplication, request: RwsRequest) -> None:
    """Stop the program; `alltsk` also stops background tasks [real 7.21]."""
    mode = request.field("stopmode", ("cycle", "instr", "stop", "qstop"))
    tasks = request.form.get("usetsp", "normal")
    if tasks not in ("normal", "alltsk", "alltask"):
        raise RequestDenied(400, "E_INVALIDARG", f"usetsp {tasks}")
    controller = app.controller
    if mode == "cycle":
        controller.cycle = "once"
        return
    controller.operation.stop_program(quick=mode == "qstop")
    if tasks != "normal":
        for task in controller.rapid_tasks.values():
            task.stop()


@serves(ops.RESET_PP)
def reset_pp(app: RwsApplication, request: RwsRequest) -> None:
    """Set program pointers of all tasks to main."""
    # RobotWare 6 takes mastership by itself [code: abb_librws, abb_robot_client].
    app.masterships.need(request, "rapid", by_itself=request.is_one)
    controller = app.controller
    _must_stand(app, request)
    faults = [d for t in controller.rapid_tasks.values() for d in app.runner.programs.faults(t)]
    if faults:
        syntax = any(d.code.startswith("RG2") for d in faults)
        name = "E_RAPID_SYNTAX_ERROR" if syntax else "E_RAPID_SEMANTIC_ERROR"
        raise RequestDenied(400 if request.is_one else 403, name, faults[0].message, -507)
    controller.pp_to_main()


@serves(ops.SET_CYCLE)
def set_cycle(app: RwsApplication, request: RwsRequest) -> None:
    """Set whether the program repeats at its end."""
    cycle = request.field("cycle", ("forever", "asis", "once"))
    if cycle != "asis":
        app.controller.cycle = "once" if cycle == "once" else "forever"


# -- tasks -----------------------------------------------------------------------------------------

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


def find_task(app: RwsApplication, name: str, request: RwsRequest) -> Task:
    """Return a task by name.

    RequestDenied: there is none (400 on RobotWare 6, 404 on 7).
    """
    for task in app.controller.rapid_tasks.values():
        if task.name.lower() == name.lower():
            return task
    raise RequestDenied(400 if request.is_one else 404, "E_INVALIDARG", f"no task {name}")


def task_of(app: RwsApplication, request: RwsRequest) -> Task:
    """Return the task of a path, or of `?task=` in RWS 1.0. Raises RequestDenied."""
    name = request.names.get("task") or request.query.get("task", "")
    return find_task(app, name, request)


def execution_state(task: Task, request: RwsRequest) -> str:
    """Return a task's execution state.

    RobotWare 6 cuts the words to four letters [code: librws].
    """
    word = _EXECUTION[task.state]
    return word[:4] if request.is_one else word


def _item(app: RwsApplication, task: Task, kind: str, request: RwsRequest) -> Item:
    kind_of_task = task.spec.type.lower()
    modules = app.runner.programs.modules(task)
    state = "linked" if task.state != "empty" else "loaded" if modules else "empty"
    notify = {
        "name": task.name,
        "type": kind_of_task[:4] if request.is_one else kind_of_task,
        "taskstate": state,
        "excstate": execution_state(task, request),
    }
    if task.spec.type == "NORMAL":
        notify["active"] = "Off" if task.name in app.controller.operation.omitted else "On"
        notify["motiontask"] = "TRUE" if task.spec.motion else "FALSE"
    if kind == "rap-task":
        notify |= {"trust": task.spec.trust, "prodentrypt": task.spec.entry}
    return Item(kind, task.name, notify, {"self": f"tasks/{task.name}"})


@serves(ops.TASKS)
def get_tasks(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return all tasks."""
    tasks = app.controller.rapid_tasks.values()
    return show(*(_item(app, t, "rap-task-li", request) for t in tasks), collection=True)


@serves(ops.TASK)
def get_task(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one task."""
    return show(_item(app, task_of(app, request), "rap-task", request))


@serves(ops.ACTIVATE_ALL, ops.DEACTIVATE_ALL)
def activate_all(app: RwsApplication, request: RwsRequest) -> None:
    """Select all NORMAL tasks at once."""
    for task in app.controller.rapid_tasks.values():
        if task.spec.type == "NORMAL":
            activate(app, replace(request, names={"task": task.name}))


@serves(ops.TASK_SELECTION)
def selection(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the task selection panel [VC 7.21]."""
    left_out = app.controller.operation.omitted
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
        for task in app.controller.rapid_tasks.values()
        if task.spec.type == "NORMAL"
    ]
    return show(*result, collection=True)


@serves(ops.CHANGE_COUNT)
def change_count(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the number of changes of a task's program."""
    task = task_of(app, request)
    count = str(app.runner.programs.changes[task.name])
    notify = {"struc-change-count": count, "change-count": count}
    return show(Item("rap-task-struc-change-count", task.name, notify))


@serves(ops.ACTIVATE, ops.DEACTIVATE)
def activate(app: RwsApplication, request: RwsRequest) -> None:
    """Select the NORMAL tasks that start with the program.

    This is the task selection panel.
    """
    # RobotWare 6 takes mastership by itself [RWS manual].
    app.masterships.need(request, "rapid", by_itself=request.is_one)
    task = find_task(app, request.names.get("task") or request.field("task"), request)
    if task.spec.type != "NORMAL":
        raise RequestDenied(403, "E_REJECT", f"{task.name} is a background task", -2)
    _must_stand(app, request)
    left_out = app.controller.operation.omitted
    if "deactivate" in (request.query.get("action"), request.path.rpartition("/")[2]):
        left_out.add(task.name)
    else:
        left_out.discard(task.name)


# -- modules -------------------------------------------------------------------------------------


@serves(ops.MODULES)
def get_modules(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the modules of a task.

    HAL has them in `state`, though they are many [VC 7.21].
    """
    task = task_of(app, request)
    result = app.runner.programs.modules(task)
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
def get_module(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the file of one module."""
    task, name = task_of(app, request), request.names["module"]
    result = [m for m in app.runner.programs.modules(task) if m.name.lower() == name.lower()]
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
def load_module(app: RwsApplication, request: RwsRequest) -> RwsResponse | None:
    """Load a module; `builderror` reports its errors, not this answer.

    [VC 7.21]
    """
    app.masterships.need(request, "rapid")
    task = task_of(app, request)
    text = request.field("modulepath")
    replaced = request.form.get("replace", "false").lower() == "true"
    path = disk_path(app, text, request)
    try:
        name = app.runner.programs.load(task, path, text, replaced=replaced)
    except CannotLoad as fault:
        raise load_refused(request, fault, text) from fault
    if request.is_one:
        return None
    return show(Item("rap-task-module-li", name, {"name": name}))


@serves(ops.UNLOAD_MODULE)
def unload_module(app: RwsApplication, request: RwsRequest) -> None:
    """Unload a module of a task."""
    app.masterships.need(request, "rapid")
    task = task_of(app, request)
    name = request.field("module")
    try:
        app.runner.programs.unload(task, name)
    except CannotLoad as fault:
        raise load_refused(request, fault, name) from fault


def load_refused(request: RwsRequest, fault: CannotLoad, what: str) -> RequestDenied:
    """Return the answer to a module that cannot be loaded or saved."""
    name = str(fault)
    return RequestDenied(_STATUS[name][0 if request.is_one else 1], name, what, -507)


@serves(ops.SAVE_MODULE)
def save_module(app: RwsApplication, request: RwsRequest) -> None:
    """Save a module with its current persistents.

    The file name gets an extension.
    """
    task, name = task_of(app, request), request.names["module"]
    module = task.program.modules.get(name.lower())
    if module is None:
        raise no_module(request, name)
    folder = request.field("path")
    if not request.is_one and not folder.endswith(":"):
        raise RequestDenied(400, "E_INVALID_PATH", folder)  # the root of a volume only [VC 7.21]
    ending = ".mod" if request.is_one else ".modx"
    path = disk_path(app, f"{folder.rstrip('/')}/{request.field('name')}{ending}", request)
    text = module_text(task, module)
    write_file(app, path, text.encode(module.tree.source.encoding, "replace"))


# -- pointers --------------------------------------------------------------------------------------


def place_of(task: Task) -> Location | None:
    """Return the position of a task; None before its start."""
    stack = task.stack()
    return task.pointer.next_statement() or (stack[-1] if stack else None)


@serves(ops.POINTER)
def get_pointer(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return program and motion pointer of a task.

    Both are equal here.
    """
    task = task_of(app, request)
    place = place_of(task)
    if place is None:
        return show(Item("pcp-info", "progpointer", {"modulemame": "", "routinename": ""}))
    at = f"{place.span.line},{place.span.column}"
    notify = {
        "beginposition": at,
        "endposition": at,
        "modulemame": place.module,
        "routinename": place.routine,
        "changecount": str(app.runner.programs.changes[task.name]),
        "executiontype": "normal",
    }
    return show(Item("pcp-info", "progpointer", notify), Item("pcp-info", "motionpointer", notify))


@serves(ops.COUNTER)
def get_counter(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the program pointer as execution data of a task.

    The manual of RWS 1.0 has it in this form too.
    """
    place = place_of(task_of(app, request))
    row, column = (place.span.line, place.span.column) if place else (0, 0)
    notify = {"module": place.module if place else "", "routine": place.routine if place else ""}
    notify |= {"startline": str(row), "startcol": str(column)}
    return show(Item("rap-pcp", "pcp", {**notify, "endline": str(row), "endcol": str(column)}))


def _movable(app: RwsApplication, request: RwsRequest) -> Task:
    app.masterships.need(request, "rapid")
    task = task_of(app, request)
    _must_stand(app, request, task)
    return task


@serves(ops.POINTER_TO_ROUTINE)
def pointer_to_routine(app: RwsApplication, request: RwsRequest) -> None:
    """Set one task's program pointer to a routine."""
    task = _movable(app, request)
    try:
        app.controller.tasks[task.name].pp_to_routine(request.field("routine"))
    except CannotStep as error:
        raise RequestDenied(400, "E_ILLEGAL_ENTRYPOINT", str(error)) from error


@serves(ops.POINTER_TO_MAIN)
def pointer_to_main(app: RwsApplication, request: RwsRequest) -> None:
    """Set one task's program pointer to main."""
    app.controller.tasks[_movable(app, request).name].pp_to_main()


@serves(ops.POINTER_TO_CURSOR)
def pointer_to_cursor(app: RwsApplication, request: RwsRequest) -> None:
    """Set one task's program pointer to a statement of its routine."""
    task = _movable(app, request)
    request.field("module")
    field = request.kind("line", "begin-position-row")
    row = whole(field, request.field(field))
    try:
        app.controller.tasks[task.name].pp_to_statement(row)
    except CannotStep as error:
        raise RequestDenied(400, "E_ILLEGAL_ENTRYPOINT", str(error)) from error


@serves(ops.ACTIVATION_RECORD)
def get_frame(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one frame of the stack, from the innermost on.

    400 if there is none [VC 6.16].
    """
    task = task_of(app, request)
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
def get_routines(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return procedures without parameters, callable as service routines."""
    task = task_of(app, request)
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


# -- events --------------------------------------------------------------------------------------


@subscribable("/rw/rapid/execution", "ctrlexecstate", "rapidexeccycle")
def execution_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Execution state, or cycle."""
    controller, name = app.controller, topic.suffix
    kind = {"ctrlexecstate": "rap-ctrlexecstate-ev", "rapidexeccycle": "rap-execcycle-ev"}[name]

    def read() -> str:
        return execution(controller) if name == "ctrlexecstate" else controller.cycle

    def item() -> Item:
        return Item(kind, name, {name: read()}, {"self": topic.text})

    return new_values(controller.operation.changed, read, item)


@subscribable("/rw/rapid/tasks", "buildlogchange")
def build_log_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Changes of any task's program."""
    programs = app.runner.programs

    def read() -> int:
        return sum(programs.changes.values())

    def item() -> Item:
        count = {"change-count": str(read())}
        return Item("rap-buildlog-ev", "buildlogchange", count, {"self": topic.text})

    return new_values(programs.changed, read, item)


@subscribable("/rw/rapid/tasks/(?P<task>[^/]+)", "taskchange")
def program_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Changes of a task's program."""
    task, programs = find_task(app, topic.names["task"], topic.request), app.runner.programs

    def item() -> Item:
        count = str(programs.changes[task.name])
        fields = {"change-count": count, "task-name": task.name, "changetype": "module"}
        return Item("rap-task-ev", "taskchange", fields, {"self": topic.text})

    return new_values(programs.changed, lambda: programs.changes[task.name], item)


@subscribable("/rw/rapid/tasks/(?P<task>[^/]+)", "excstate")
def task_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Execution states of a task."""
    task = find_task(app, topic.names["task"], topic.request)

    def item() -> Item:
        state = execution_state(task, topic.request)
        fields = {"task-name": task.name, "pgmtaskexec-state": state}
        return Item("rap-execstate-ev", "execstatechange", fields, {"self": topic.text})

    return new_values(app.controller.operation.changed, lambda: task.state, item)


_POINTERS = {
    "programpointerchange": ("rap-pp-ev", "pp"), "motionpointerchange": ("rap-mp-ev", "mp"),
}  # fmt: skip


@subscribable("/rw/rapid/tasks/(?P<task>[^/]+)/pcp", *_POINTERS)
def pointer_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Program or motion pointers of a task."""
    task = find_task(app, topic.names["task"], topic.request)
    kind, title = _POINTERS[topic.suffix]

    def item() -> Item:
        place = place_of(task)
        row, column = (place.span.line, place.span.column) if place else (0, 0)
        fields = {
            "module-name": place.module if place else "",
            "routine-name": place.routine if place else "",
            "BegPosLine": str(row),
            "BegPosCol": str(column),
            "EndPosLine": str(row),
            "EndPosCol": str(column),
        }
        return Item(kind, title, fields, {"self": topic.text})

    return new_values(app.controller.operation.changed, lambda: place_of(task), item)
