"""Tasks, modules, symbols, program pointers."""

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.client.rws.flows.mastership import held
from rapidgen.client.rws.flows.panel import one
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import BuildError, ProgramPointer, SymbolInfo, TaskModule, TaskState
from rapidgen.client.rws.values import RapidValue, read, same, write
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item, whole

_KINDS = {"norm": "normal", "semi": "semistatic", "stat": "static"}
_STATES = {"read": "ready", "star": "started", "stop": "stopped", "unin": "uninitialized"}


def tasks(core: RwsCore) -> Flow[tuple[TaskState, ...]]:
    """All tasks: one request."""
    body, _ = yield from ask(core, ops.TASKS)
    return tuple(_task(item) for item in body.all("rap-task-li"))


def _task(item: Item) -> TaskState:
    # RobotWare 6 cuts these words to four letters [code: librws].
    kind, state = item.text("type").lower(), item.text("excstate").lower()
    return TaskState(
        item.text("name"),
        _KINDS.get(kind[:4], kind),
        item.text("taskstate"),
        _STATES.get(state[:4], state),
        item.text("active", "On").lower() in ("on", "true"),
        item.text("motiontask").upper() == "TRUE",
    )


def select_task(core: RwsCore, task: str, selected: bool) -> Flow[None]:
    """Select whether a NORMAL task starts with the program; read it back."""
    operation = ops.ACTIVATE if selected else ops.DEACTIVATE
    yield from held(core, "rapid", ask(core, operation, {"task": task}, {"task": task}))
    now = yield from tasks(core)
    if not any(t.name.lower() == task.lower() and t.active == selected for t in now):
        word = "selected" if selected else "left out"
        raise NotConfirmed.because("RG655", f"{core.where} agreed, and {task} is not {word}")


def modules(core: RwsCore, task: str) -> Flow[tuple[TaskModule, ...]]:
    """Modules of a task."""
    names, query = _of_task(core, task)
    body, _ = yield from ask(core, ops.MODULES, names, query=query)
    result = body.all("rap-module-info-li")
    return tuple(
        TaskModule(i.text("name"), i.text("type").lower().startswith("sys")) for i in result
    )


def module_text(core: RwsCore, task: str, module: str) -> Flow[str]:
    """Source of a module, with initial values as they were written."""
    names, query = _of_task(core, task)
    names["module"] = module
    body, _ = yield from ask(core, ops.MODULE_TEXT, names, query=query)
    for item in body.items:
        if "module-text" in item.fields:
            return item.text("module-text")
    raise NotConfirmed.because("RG655", f"{core.where} returns no text of {module} in {task}")


def _of_task(core: RwsCore, task: str) -> tuple[dict[str, str], str]:
    """Put the task's name into the query of RWS 1.0 or the path of 2.0."""
    if core.generation is Generation.ONE:
        return {}, f"task={task}"
    return {"task": task}, ""


def load_module(core: RwsCore, task: str, path: str, *, replace: bool = False) -> Flow[None]:
    """Load a module file (`HOME/folder/a.mod`) into a task."""
    form = {"modulepath": _volume(core, path), "replace": "true" if replace else "false"}
    yield from held(core, "rapid", ask(core, ops.LOAD_MODULE, {"task": task}, form))


def unload_module(core: RwsCore, task: str, module: str) -> Flow[None]:
    """Unload a module of a task. RAPID must be stopped in all tasks."""
    yield from held(core, "rapid", ask(core, ops.UNLOAD_MODULE, {"task": task}, {"module": module}))


def save_module(
    core: RwsCore, task: str, module: str, name: str, volume: str = "TEMP"
) -> Flow[str]:
    """Save a module with its current persistents; return its path."""
    names, query = _of_task(core, task)
    names["module"] = module
    is_one = core.generation is Generation.ONE
    form = {"name": name, "path": f"${volume}" if is_one else f"{volume}:"}
    yield from ask(core, ops.SAVE_MODULE, names, form, query=query)
    return f"{volume}/{name}{'.mod' if is_one else '.modx'}"


def _volume(core: RwsCore, path: str) -> str:
    """Return a path below a volume in the controller's spelling.

    `$HOME/a` or `HOME/a`.
    """
    bare = path.removeprefix("$")
    return f"${bare}" if core.generation is Generation.ONE else bare


def build_errors(core: RwsCore, task: str) -> Flow[tuple[BuildError, ...]]:
    """Return the build errors of a task's program."""
    body, _ = yield from ask(core, ops.BUILD_ERRORS, {"task": task}, accepted=(404,))
    return tuple(
        BuildError(i.text("ModuleName"), i.whole("row"), i.whole("column"), i.text("error"))
        for i in body.all("rap-builderrs")
    )


def pointer(core: RwsCore, task: str) -> Flow[ProgramPointer]:
    """Return the program pointer of a task."""
    item = yield from one(core, ops.POINTER, "pcp-info", task=task)
    row, _, column = item.text("beginposition").partition(",")
    module = item.text("modulemame") or item.text("modulename")
    return ProgramPointer(module, item.text("routinename"), whole(row), whole(column))


def set_pointer(core: RwsCore, task: str, module: str, routine: str) -> Flow[None]:
    """Set one task's program pointer to a routine."""
    form = {"module": module, "routine": routine}
    if core.generation is not Generation.ONE:
        form["userlevel"] = "FALSE"
    yield from held(core, "rapid", ask(core, ops.POINTER_TO_ROUTINE, {"task": task}, form))


# -- symbols -------------------------------------------------------------------------------------


def symbol_text(core: RwsCore, path: str) -> Flow[str]:
    """Return a datum as a RAPID literal; one request."""
    body, _ = yield from ask(core, ops.SYMBOL, {"symbol": path})
    item = body.first("rap-data")
    if item is None or "value" not in item.fields:
        why = "it is too large for one response" if item and item.links else "there is no value"
        help = "read it by element: NAME{1}"
        raise NotConfirmed.because("RG655", f"{path} at {core.where}: {why}", help)
    return item.text("value")


def symbol(core: RwsCore, path: str) -> Flow[RapidValue]:
    """Return a datum as a Python value: bool, str or number."""
    text = yield from symbol_text(core, path)
    try:
        return read(text)
    except ValueError as error:
        raise NotConfirmed.because(
            "RG655", f"{path} at {core.where} is not a literal: {text!r}"
        ) from error


def set_symbol(core: RwsCore, path: str, value: RapidValue) -> Flow[None]:
    """Set a datum and read it back."""
    steps = ask(core, ops.SET_SYMBOL, {"symbol": path}, {"value": write(value)})
    if core.generation is Generation.ONE:
        yield from steps  # RobotWare 6 takes mastership by itself
    else:
        yield from held(core, "rapid", steps)
    now = yield from symbol(core, path)
    if not same(value, now):
        raise NotConfirmed.because(
            "RG655", f"{core.where} agreed to set {path} to {write(value)}, and it is {now!r}"
        )


def symbols(
    core: RwsCore, task: str, *, module: str = "", kind: str = "any", pattern: str = ""
) -> Flow[tuple[SymbolInfo, ...]]:
    """Return data of a task."""
    form = {
        "view": "block",
        "vartyp": "any",
        "blockurl": "/".join(filter(None, ("RAPID", task, module))),
        "symtyp": kind,
        "recursive": "true",
        "skipshared": "FALSE",
        "onlyused": "FALSE",
        "stack": "0",
        "posl": "0",
        "posc": "0",
    }
    if pattern:
        form["regexp"] = pattern
    body, _ = yield from ask(core, ops.SEARCH_SYMBOLS, form=form)
    return tuple(_info(item) for item in body.items if item.kind.startswith("rap-symprop"))


def _info(item: Item) -> SymbolInfo:
    return SymbolInfo(
        item.text("symburl").removeprefix("RAPID/"),
        item.text("name"),
        item.text("symtyp"),
        item.text("dattyp"),
        tuple(whole(n) for n in item.text("dim").split()),
        item.text("local").lower() == "true",
        item.text("rdonly").lower() == "true",
    )
