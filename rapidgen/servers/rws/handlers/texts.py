"""Texts of modules: read, written, looked through. Rows and columns count from 1 on."""

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


def _module(office: "RwsContext", asked: RwsRequest) -> _Module:
    task, name = task_to_boot(office, asked), asked.names["module"]
    programs = office.cabinet.programs
    text = programs.text(task, name)
    for module in programs.modules(task):
        if module.name.lower() == name.lower() and text is not None:
            return _Module(task, module.file, text)
    raise no_module(asked, name)


def _count(office: "RwsContext", task: Task) -> str:
    return str(office.cabinet.programs.changes[task.name])


@serves(ops.MODULE_TEXT)
def get_text(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """The source of a module."""
    module = _module(office, asked)
    told = {"change-count": _count(office, module.task), "module-text": module.text}
    return show(Item("rap-module-text", asked.names["module"], told))


@serves(ops.MODULE_COUNT)
def get_count(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """How often the program that a module is in was changed."""
    count = _count(office, _module(office, asked).task)
    return show(Item("rap-module-changecount", asked.names["module"], {"count": count}))


@dataclass(frozen=True, slots=True)
class _Range:
    """Two places of a text, as offsets."""

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

    found = _Range(offset("startrow", "startcol", False), offset("endrow", "endcol", True))
    if found.end < found.begin:
        raise RequestDenied(400, "E_INVALIDARG", "it ends before it begins")
    return found


@serves(ops.TEXT_RANGE)
def get_range(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """A piece of the source; -1 is the end."""
    text = _module(office, asked).text
    piece = _range(text, dict(asked.query))
    told = {"text": text[piece.begin : piece.end]}
    return show(Item("rap-mod-text", asked.names["module"], told))


@serves(ops.TEXT_SEARCH)
def search(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Where a text stands, whatever its case."""
    wanted = asked.query.get("text", "").lower()
    found: list[Item] = []
    if not wanted:
        raise RequestDenied(400, "E_INVALIDARG", "text")
    for number, row in enumerate(_module(office, asked).text.splitlines(), 1):
        column = row.lower().find(wanted)
        if column >= 0:
            place = {"row": str(number), "column": str(column + 1)}
            found.append(Item("rap-text-position", str(len(found) + 1), place))
    return show(*found, collection=True)


@serves(ops.SET_TEXT)
def set_text(office: "RwsContext", asked: RwsRequest) -> None:
    """Another source for a module; what is wrong in it is told by `builderror`."""
    office.masters.need(asked, "rapid")
    _put(office, asked, _module(office, asked), asked.field("text"))


@serves(ops.SET_TEXT_RANGE)
def set_range(office: "RwsContext", asked: RwsRequest) -> None:
    """Another text for a piece of the source, or one more before or behind it."""
    office.masters.need(asked, "rapid")
    module, more = _module(office, asked), asked.field("text")
    piece = _range(module.text, asked.form)
    mode = asked.form.get("replace-mode", "Replace").lower()
    begin, end = {
        "replace": (piece.begin, piece.end),
        "before": (piece.begin, piece.begin),
        "after": (piece.end, piece.end),
    }.get(mode, (-1, -1))
    if begin < 0:
        raise RequestDenied(400, "E_INVALIDARG", f"replace-mode {mode}")
    _put(office, asked, module, module.text[:begin] + more + module.text[end:])


def _put(office: "RwsContext", asked: RwsRequest, module: _Module, text: str) -> None:
    name, programs = asked.names["module"], office.cabinet.programs
    file = ModuleFile(module.file.name, module.file.path, text.encode())
    new = office.controller.parse_module(file).name or name
    try:
        if new.lower() != name.lower():
            if any(m.name.lower() == new.lower() for m in programs.modules(module.task)):
                raise CannotLoad("E_MOD_AMBNAME")
            programs.unload(module.task, name)
        programs.put(module.task, file, replaced=True)
    except CannotLoad as fault:
        raise load_refused(asked, fault, name) from fault
