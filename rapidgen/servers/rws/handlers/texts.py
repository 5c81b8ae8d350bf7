"""Texts of modules: read, write, search.

Rows and columns count from 1.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.handlers.tasks import load_refused, no_module, task_to_boot
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.system.model import ModuleFile
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@dataclass(frozen=True, slots=True)
class _Module:
    """A module of a task, and its source."""

    task: Task
    file: ModuleFile
    text: str


def _module(context: "RwsContext", request: RwsRequest) -> _Module:
    task, name = task_to_boot(context, request), request.names["module"]
    programs = context.runner.programs
    text = programs.text(task, name)
    for module in programs.modules(task):
        if module.name.lower() == name.lower() and text is not None:
            return _Module(task, module.file, text)
    raise no_module(request, name)


def _count(context: "RwsContext", task: Task) -> str:
    return str(context.runner.programs.changes[task.name])


@serves(ops.MODULE_TEXT)
def get_text(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the source of a module."""
    module = _module(context, request)
    notify = {"change-count": _count(context, module.task), "module-text": module.text}
    return show(Item("rap-module-text", request.names["module"], notify))


@serves(ops.MODULE_COUNT)
def get_count(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the number of changes of the program of a module."""
    count = _count(context, _module(context, request).task)
    return show(Item("rap-module-changecount", request.names["module"], {"count": count}))


@dataclass(frozen=True, slots=True)
class _Range:
    """Two positions of a text, as offsets."""

    begin: int
    end: int


def _range(text: str, fields: dict[str, str]) -> _Range:
    rows = text.splitlines(keepends=True) or [""]

    def offset(row: str, column: str, last: bool) -> int:
        try:
            at, over = int(fields.get(row, "-1" if last else "1")), int(fields.get(column, "-1"))
        except ValueError as error:
            raise RequestDenied(400, "E_INVALIDARG", f"{row}, {column}") from error
        at = len(rows) if at == -1 and last else at
        if not 1 <= at <= len(rows):
            raise RequestDenied(400, "E_INVALIDARG", f"{row} {at}")
        length = len(rows[at - 1].rstrip("\r\n"))
        over = (length if last else 1) if over == -1 else over
        if not 0 <= over <= length + 1:
            raise RequestDenied(400, "E_INVALIDARG", f"{column} {over}")
        return sum(map(len, rows[: at - 1])) + (over if last else max(over, 1) - 1)

    result = _Range(offset("startrow", "startcol", False), offset("endrow", "endcol", True))
    if result.end < result.begin:
        raise RequestDenied(400, "E_INVALIDARG", "it ends before it begins")
    return result


@serves(ops.TEXT_RANGE)
def get_range(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return a range of the source; -1 is the end."""
    text = _module(context, request).text
    piece = _range(text, dict(request.query))
    notify = {"text": text[piece.begin : piece.end]}
    return show(Item("rap-mod-text", request.names["module"], notify))


@serves(ops.TEXT_SEARCH)
def search(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the positions of a text, in any case."""
    requested = request.query.get("text", "").lower()
    result: list[Item] = []
    if not requested:
        raise RequestDenied(400, "E_INVALIDARG", "text")
    for number, row in enumerate(_module(context, request).text.splitlines(), 1):
        column = row.lower().find(requested)
        if column >= 0:
            place = {"row": str(number), "column": str(column + 1)}
            result.append(Item("rap-text-position", str(len(result) + 1), place))
    return show(*result, collection=True)


@serves(ops.SET_TEXT)
def set_text(context: "RwsContext", request: RwsRequest) -> None:
    """Replace the source of a module; `builderror` reports its errors."""
    context.masters.need(request, "rapid")
    _put(context, request, _module(context, request), request.field("text"))


@serves(ops.SET_TEXT_RANGE)
def set_range(context: "RwsContext", request: RwsRequest) -> None:
    """Replace a range of the source, or insert before or after it."""
    context.masters.need(request, "rapid")
    module, more = _module(context, request), request.field("text")
    piece = _range(module.text, request.form)
    mode = request.form.get("replace-mode", "Replace").lower()
    begin, end = {
        "replace": (piece.begin, piece.end),
        "before": (piece.begin, piece.begin),
        "after": (piece.end, piece.end),
    }.get(mode, (-1, -1))
    if begin < 0:
        raise RequestDenied(400, "E_INVALIDARG", f"replace-mode {mode}")
    _put(context, request, module, module.text[:begin] + more + module.text[end:])


def _put(context: "RwsContext", request: RwsRequest, module: _Module, text: str) -> None:
    name, programs = request.names["module"], context.runner.programs
    file = ModuleFile(module.file.name, module.file.path, text.encode())
    new = context.controller.parse_module(file).name or name
    try:
        if new.lower() != name.lower():
            if any(m.name.lower() == new.lower() for m in programs.modules(module.task)):
                raise CannotLoad("E_MOD_AMBNAME")
            programs.unload(module.task, name)
        programs.put(module.task, file, replaced=True)
    except CannotLoad as fault:
        raise load_refused(request, fault, name) from fault
