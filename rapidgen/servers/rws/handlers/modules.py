"""Modules and programs: load, save, read and write their texts.

Rows and columns count from 1.
"""

from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import fromstring

from rapidgen._reading import read_foreign
from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.loading import LARGEST_MODULE, module_text
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.handlers.files import disk_path, write_file
from rapidgen.servers.rws.handlers.tasks import load_refused, no_module, task_of
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.system.model import ModuleFile
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.xhtml import text as escaped


@serves(ops.PROGRAM)
def get_program(app: RwsApplication, request: RwsRequest) -> RwsResponse | None:
    """Return the program of a task; empty if there is none."""
    task = task_of(app, request)
    if not app.runner.programs.modules(task):
        return None
    name = app.program_names.get(task.name, "")
    return show(Item("rap-program", "program", {"name": name, "entrypoint": task.spec.entry}))


@serves(ops.BUILD_ERRORS)
def get_build_errors(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the build errors of a task's program."""
    task = task_of(app, request)
    names = {m.file.path: m.name for m in app.runner.programs.modules(task)}
    result = []
    for fault in app.runner.programs.faults(task):
        span = fault.span
        notify = {
            "ModuleName": names.get(span.path, "") if span else "",
            "row": str(span.line if span else 0),
            "column": str(span.column if span else 0),
            "error": fault.message,
        }
        result.append(Item("rap-builderrs", "builderror", notify))
    return show(*result)


def _own(app: RwsApplication, task: Task) -> list[str]:
    """Return modules of the program, without system modules."""
    programs = app.runner.programs
    return [m.name for m in programs.modules(task) if not m.is_system and not m.file.shared]


@serves(ops.LOAD_PROGRAM)
def load(app: RwsApplication, request: RwsRequest) -> None:
    """Load the modules of a program file from its folder.

    `replace` unloads the others.
    """
    app.masterships.need(request, "rapid")
    task = task_of(app, request)
    text = request.field("progpath")
    mode = request.form.get("loadmode", "replace")
    if mode not in ("add", "replace"):
        raise RequestDenied(400, "E_INVALIDARG", f"loadmode {mode}")
    path = disk_path(app, text, request)
    folder = text.rpartition("/")[0]
    files = _listed(path, request, text)
    places = [disk_path(app, f"{folder}/{file}", request) for file in files]
    for file, place in zip(files, places, strict=True):
        if not place.is_file():
            raise RequestDenied(400 if request.is_one else 404, "E_FILE_NOT_FOUND", file)
    try:
        if mode == "replace":
            for name in _own(app, task):
                app.runner.programs.unload(task, name)
        for file, place in zip(files, places, strict=True):
            app.runner.programs.load(task, place, f"{folder}/{file}", replaced=False)
    except CannotLoad as fault:
        raise load_refused(request, fault, text) from fault
    app.program_names[task.name] = path.stem


def _listed(path: Path, request: RwsRequest, words: str) -> list[str]:
    """Return the module files of a program file.

    They lie in its folder. RequestDenied: it is not a program file.
    """
    try:
        root = fromstring(read_foreign(path, LARGEST_MODULE))
    except OSError as error:
        raise RequestDenied(400 if request.is_one else 404, "E_FILE_NOT_FOUND", words) from error
    except (ParseError, DefusedXmlException, ValueError) as error:
        raise RequestDenied(400, "E_INVALID_PROGRAMFILE", words) from error
    files = [(e.text or "").strip() for e in root.iter() if e.tag == "Module"]
    if root.tag != "Program" or not files or any("/" in f or "\\" in f or not f for f in files):
        raise RequestDenied(400, "E_INVALID_PROGRAMFILE", words)
    return files


@serves(ops.UNLOAD_PROGRAM)
def unload(app: RwsApplication, request: RwsRequest) -> None:
    """Unload the program's modules; system modules stay."""
    app.masterships.need(request, "rapid")
    task = task_of(app, request)
    try:
        for name in _own(app, task):
            app.runner.programs.unload(task, name)
    except CannotLoad as fault:
        raise load_refused(request, fault, task.name) from fault
    app.program_names.pop(task.name, None)


@serves(ops.SAVE_PROGRAM)
def save(app: RwsApplication, request: RwsRequest) -> None:
    """Save the program's modules and program file into a folder.

    The folder is created if it is missing.
    """
    task = task_of(app, request)
    words = request.field("path")
    folder = disk_path(app, words, request)
    name = request.form.get("name") or app.program_names.get(task.name) or task.name
    if "/" in name or "\\" in name:
        raise RequestDenied(400, "E_INVALID_PATH", name)
    file = disk_path(app, f"{words}/{name}.pgf", request)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise RequestDenied(404, "E_DIR_NOT_EXIST", words) from error
    listed = []
    for own in _own(app, task):
        module = task.program.modules.get(own.lower())
        text = module_text(task, module) if module else app.runner.programs.text(task, own)
        place = disk_path(app, f"{words}/{own}.mod", request)
        write_file(app, place, (text or "").encode("latin-1", "replace"))
        listed.append(f"<Module>{escaped(own)}.mod</Module>")
    head = '<?xml version="1.0" encoding="ISO-8859-1" ?>'
    complete = f"{head}\n<Program>{''.join(listed)}</Program>\n"
    write_file(app, file, complete.encode("latin-1", "replace"))


# -- texts of modules ------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Module:
    """A module of a task, and its source."""

    task: Task
    file: ModuleFile
    text: str


def _module(app: RwsApplication, request: RwsRequest) -> _Module:
    task, name = task_of(app, request), request.names["module"]
    programs = app.runner.programs
    text = programs.text(task, name)
    for module in programs.modules(task):
        if module.name.lower() == name.lower() and text is not None:
            return _Module(task, module.file, text)
    raise no_module(request, name)


def _count(app: RwsApplication, task: Task) -> str:
    return str(app.runner.programs.changes[task.name])


@serves(ops.MODULE_TEXT)
def get_text(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the source of a module."""
    module = _module(app, request)
    notify = {"change-count": _count(app, module.task), "module-text": module.text}
    return show(Item("rap-module-text", request.names["module"], notify))


@serves(ops.MODULE_COUNT)
def get_count(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the number of changes of the program of a module."""
    count = _count(app, _module(app, request).task)
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
def get_range(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return a range of the source; -1 is the end."""
    text = _module(app, request).text
    piece = _range(text, dict(request.query))
    notify = {"text": text[piece.begin : piece.end]}
    return show(Item("rap-mod-text", request.names["module"], notify))


@serves(ops.TEXT_SEARCH)
def search(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the positions of a text, in any case."""
    requested = request.query.get("text", "").lower()
    result: list[Item] = []
    if not requested:
        raise RequestDenied(400, "E_INVALIDARG", "text")
    for number, row in enumerate(_module(app, request).text.splitlines(), 1):
        column = row.lower().find(requested)
        if column >= 0:
            place = {"row": str(number), "column": str(column + 1)}
            result.append(Item("rap-text-position", str(len(result) + 1), place))
    return show(*result, collection=True)


@serves(ops.SET_TEXT)
def set_text(app: RwsApplication, request: RwsRequest) -> None:
    """Replace the source of a module; `builderror` reports its errors."""
    app.masterships.need(request, "rapid")
    _put(app, request, _module(app, request), request.field("text"))


@serves(ops.SET_TEXT_RANGE)
def set_range(app: RwsApplication, request: RwsRequest) -> None:
    """Replace a range of the source, or insert before or after it."""
    app.masterships.need(request, "rapid")
    module, more = _module(app, request), request.field("text")
    piece = _range(module.text, request.form)
    mode = request.form.get("replace-mode", "Replace").lower()
    begin, end = {
        "replace": (piece.begin, piece.end),
        "before": (piece.begin, piece.begin),
        "after": (piece.end, piece.end),
    }.get(mode, (-1, -1))
    if begin < 0:
        raise RequestDenied(400, "E_INVALIDARG", f"replace-mode {mode}")
    _put(app, request, module, module.text[:begin] + more + module.text[end:])


def _put(app: RwsApplication, request: RwsRequest, module: _Module, text: str) -> None:
    name, programs = request.names["module"], app.runner.programs
    file = ModuleFile(module.file.name, module.file.path, text.encode())
    new = app.controller.parse_module(file).name or name
    try:
        if new.lower() != name.lower():
            if any(m.name.lower() == new.lower() for m in programs.modules(module.task)):
                raise CannotLoad("E_MOD_AMBNAME")
            programs.unload(module.task, name)
        programs.put(module.task, file, replaced=True)
    except CannotLoad as fault:
        raise load_refused(request, fault, name) from fault
