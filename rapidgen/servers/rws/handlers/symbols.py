"""RAPID data: read, write, describe, search."""

import re
import warnings
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass

from rapidgen.controller.views import TaskView
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.link import find_type
from rapidgen.runtime.compiler.symbols import LoadedModule
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.text import NotALiteral, literal_text, parse_value
from rapidgen.runtime.values import PersistentCell, Type, Value
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.handlers.tasks import find_task
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.subscriptions import EventSource, Topic, every_change, subscribable
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

_ELEMENT = re.compile(r"(\w+)\{\s*(\d{1,9}(?:\s*,\s*\d{1,9})*)\s*\}")
_KINDS = {"PERS": ("per", "pers"), "VAR": ("var", "var"), "CONST": ("con", "constant")}
_SLOW = re.compile(r"\)[*+{]|(?:[*+{].*){4}", re.DOTALL)
"""Patterns that could run for ever: nested or many repetitions.

Repeated groups, and more than three repetitions, are rejected.
"""
LARGEST = 16_000
"""Longest value returned whole [mem: the limit itself is not known]."""


@dataclass(frozen=True, slots=True)
class Datum:
    """A datum of a task, or an element of one."""

    task: TaskView
    name: str
    type: Type
    dims: tuple[int, ...]
    element: tuple[int, ...] = ()

    @property
    def value(self) -> Value:
        """The current value."""
        value = self.task[self.name]
        for i in self.element:
            value = value[i]
        return value


def find(app: RwsApplication, path: str, request: RwsRequest) -> Datum:
    """Return the datum of `TASK/MODULE/NAME` or `TASK/NAME`.

    RequestDenied: there is none.
    """
    parts = path.split("/")
    if len(parts) not in (2, 3):
        raise _unknown(request, path)
    task = app.controller.tasks[find_task(app, parts[0], request).name]
    match = _ELEMENT.fullmatch(parts[-1])
    own = match[1] if match else parts[-1]
    name = ":".join((*parts[1:-1], own))
    try:
        type_, dims = task.type_of(name)
    except KeyError as error:
        raise _unknown(request, path) from error
    if not type_.is_value:
        raise RequestDenied(400, "E_INVALIDARG", f"{type_.name} is no value type")
    if match is None:
        return Datum(task, name, type_, dims)
    element = tuple(int(i) for i in match[2].split(","))
    if len(element) > len(dims) or any(
        not 1 <= i <= most for i, most in zip(element, dims, strict=False)
    ):
        raise _unknown(request, path)
    return Datum(task, name, type_, dims[len(element) :], element)


def _unknown(request: RwsRequest, path: str) -> RequestDenied:
    if request.is_one:
        return RequestDenied(400, "E_UNEXPECTED", f"no symbol {path}", -517)
    return RequestDenied(404, "E_NO_SUCH_SYMBOL", f"no symbol {path}", -517)


@serves(ops.SYMBOL)
def get_symbol(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the value as a RAPID literal."""
    result = find(app, request.names["symbol"], request)
    text = literal_text(result.value, result.type)
    name = request.names["symbol"].rpartition("/")[2]
    if len(text) > LARGEST:
        link = "/rw/retcode?code=-1073445865"
        return show(Item("rap-data", name, {}, {"error": link}))
    return show(Item("rap-data", name, {"value": text}))


@serves(ops.SET_SYMBOL)
def set_symbol(app: RwsApplication, request: RwsRequest) -> None:
    """Set a datum, effective at once for every reader."""
    if request.is_one:
        app.masterships.need_mode(request.session)  # RobotWare 6 takes mastership by itself
    else:
        app.masterships.need(request, "rapid")
    result = find(app, request.names["symbol"], request)
    text = request.field("value")
    try:
        value = parse_value(text, result.type, result.dims, escaped=True)
        if result.element:
            complete = deepcopy(result.task[result.name])
            inner = complete
            for i in result.element[:-1]:
                inner = inner[i]
            inner[result.element[-1]] = value
            value = complete
        result.task[result.name] = value
    except KeyError as error:
        raise RequestDenied(403, "E_REJECT", f"{result.name} is read only", -2) from error
    except NotALiteral as error:
        raise RequestDenied(
            400, "E_INVALIDARG", f"no value of {result.type.name}: {text}"
        ) from error
    except RapidError as error:
        raise RequestDenied(400, "E_INVALIDARG", error.name) from error


@serves(ops.VALIDATE_VALUE)
def validate(app: RwsApplication, request: RwsRequest) -> None:
    """Check whether a text is a value of a type: 204, or 400."""
    find_task(app, request.names.get("task") or request.field("task"), request)
    name, text = request.field(request.kind("datatype", "dattyp")), request.field("value")
    result = find_type(name.lower())
    try:
        if result is None or not result.is_value:
            raise RequestDenied(400, "E_INVALIDARG", f"no type {name}")
        parse_value(text, result, escaped=True)
    except NotALiteral as error:
        raise RequestDenied(400, "E_INVALIDARG", f"no value of {name}: {text}") from error


@serves(ops.SYMBOL_PROPERTIES)
def get_properties(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the properties of a datum."""
    path = request.names["symbol"]
    result = find(app, path, request)
    _, *module, _ = path.split("/")
    for item, _ in _data(result.task, "".join(module)):
        if item.fields["name"].lower() == path.rpartition("/")[2].lower():
            return show(Item(item.kind, item.title, item.fields))
    raise _unknown(request, path)


@serves(ops.SEARCH_SYMBOLS)
def search(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return data of a task or a module by kind, type and name pattern."""
    form = request.form
    if not request.is_one and "task" in form:
        raise RequestDenied(400, "E_INVALIDARG", "task")  # [VC 7.21]
    parts = form.get("blockurl", "RAPID").split("/")
    if parts[0].upper() != "RAPID" or len(parts) > 3:
        raise RequestDenied(400, "E_INVALIDARG", "blockurl")
    tasks = list(app.controller.tasks.values())
    if len(parts) > 1:
        tasks = [app.controller.tasks[find_task(app, parts[1], request).name]]
    module = parts[2] if len(parts) > 2 else ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore"
            )  # of `[[`, which Python warns may become a set operation
            pattern = re.compile(form.get("regexp") or ".*", re.IGNORECASE)
    except (re.error, OverflowError, RecursionError) as error:
        raise RequestDenied(400, "E_INVALIDARG", "regexp") from error
    if _SLOW.search(pattern.pattern):
        raise RequestDenied(
            400, "E_INVALIDARG", "regexp: groups that repeat, or too many repetitions"
        )
    kind, type_name = form.get("symtyp", "any").lower(), form.get("dattyp", "").lower()
    result = [
        Item(f"{item.kind}-li", item.title, item.fields)
        for task in tasks
        for item, own in _data(task, module)
        if kind in ("any", "", own)
        and type_name in ("", item.fields["dattyp"].lower())
        and pattern.fullmatch(item.fields["name"])
    ]
    return show(*result, collection=True)


def _data(task: TaskView, only: str) -> Iterator[tuple[Item, str]]:
    """Yield data of the modules of a task, each with its kind."""
    for module in task.rapid.program.modules.values():
        if only and module.name.lower() != only.lower():
            continue
        for key, node in module.declarations.items():
            try:
                type_, dims = task.type_of(f"{module.name}:{key}")
            except KeyError:
                continue
            short, long = _KINDS[node.kind]
            url = f"RAPID/{task.name}/{module.name}/{node.name}"
            yield (
                Item(
                    f"rap-symprop{long}",
                    url,
                    _property_fields(url, node, _declared_type(task, module, type_), dims, short),
                ),
                short,
            )


def _declared_type(task: TaskView, module: LoadedModule, type_: Type) -> str:
    """Return the path of a type below RAPID, in the letters of its declaration.

    Clients compare names of types with case [code: abb_librws].
    """
    others = (other for other in task.rapid.program.modules.values() if other is not module)
    for owner in (module, *others):
        types: list[n.RecordDeclaration | n.AliasDeclaration]
        types = [*owner.tree.records, *owner.tree.aliases]
        for declared in types:
            own = owner is module or declared.scope != "LOCAL"
            if own and declared.name.lower() == type_.name.lower():
                return f"{task.name}/{owner.name}/{declared.name}"
    return type_.name


def _property_fields(
    url: str, node: n.DataDeclaration, type_: str, dims: tuple[int, ...], kind: str
) -> dict[str, str]:
    return {
        "symburl": url,
        "name": node.name,
        "symtyp": kind,
        "named": "true",
        "dattyp": type_.rpartition("/")[2],
        "ndim": str(len(dims)),
        "dim": " ".join(map(str, dims)),
        "local": "true" if node.scope == "LOCAL" else "false",
        "rdonly": "true" if node.kind == "CONST" else "false",
        "taskvar": "false",
        "typurl": f"RAPID/{type_}",
    }


@subscribable("/rw/rapid/symbol/data/RAPID/(?P<symbol>.+)", "value")
@subscribable("/rw/rapid/symbol/RAPID/(?P<symbol>.+)/data", "value")
def value_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Values of a persistent."""
    result = find(app, topic.names["symbol"], topic.request)
    cell = result.task.cell(result.name)
    if not isinstance(cell, PersistentCell) or cell.cell is None:
        raise RequestDenied(400, "E_INVALIDARG", f"no persistent: {topic.text}")
    # RWS 2.0 gives the address without the part after the semicolon [code: App SDK].
    href = topic.text if topic.request.is_one else topic.text.partition(";")[0]

    def item() -> Item:
        value = literal_text(result.value, result.type)
        return Item("rap-value-ev", result.name, {"value": value}, {"self": href})

    return every_change(cell, item)
