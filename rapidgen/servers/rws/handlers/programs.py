"""Programs of tasks: build errors, and program files (.pgf).

A program file lists modules.
"""

from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree.ElementTree import ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import fromstring

from rapidgen._reading import read_foreign
from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.loading import LARGEST_MODULE, module_text
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.context import disk_path
from rapidgen.servers.rws.handlers.tasks import find_task, load_refused
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.xhtml import text as escaped

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@serves(ops.PROGRAM)
def get_program(context: "RwsContext", request: RwsRequest) -> RwsResponse | None:
    """Return the program of a task; empty if there is none."""
    task = find_task(context, request.names["task"], request)
    if not context.runner.programs.modules(task):
        return None
    name = context.program_names.get(task.name, "")
    return show(Item("rap-program", "program", {"name": name, "entrypoint": task.spec.entry}))


@serves(ops.BUILD_ERRORS)
def get_build_errors(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the build errors of a task's program."""
    task = find_task(context, request.names["task"], request)
    names = {m.file.path: m.name for m in context.runner.programs.modules(task)}
    result = []
    for fault in context.runner.programs.faults(task):
        span = fault.span
        notify = {
            "ModuleName": names.get(span.path, "") if span else "",
            "row": str(span.line if span else 0),
            "column": str(span.column if span else 0),
            "error": fault.message,
        }
        result.append(Item("rap-builderrs", "builderror", notify))
    return show(*result)


def _own(context: "RwsContext", task: Task) -> list[str]:
    """Return modules of the program, without system modules."""
    programs = context.runner.programs
    return [m.name for m in programs.modules(task) if not m.is_system and not m.file.shared]


@serves(ops.LOAD_PROGRAM)
def load(context: "RwsContext", request: RwsRequest) -> None:
    """Load the modules of a program file from its folder.

    `replace` unloads the others.
    """
    context.masters.need(request, "rapid")
    task = find_task(context, request.names["task"], request)
    text = request.field("progpath")
    mode = request.form.get("loadmode", "replace")
    if mode not in ("add", "replace"):
        raise RequestDenied(400, "E_INVALIDARG", f"loadmode {mode}")
    path = disk_path(context, text, request)
    folder = text.rpartition("/")[0]
    files = _listed(path, request, text)
    places = [disk_path(context, f"{folder}/{file}", request) for file in files]
    for file, place in zip(files, places, strict=True):
        if not place.is_file():
            raise RequestDenied(400 if request.is_one else 404, "E_FILE_NOT_FOUND", file)
    try:
        if mode == "replace":
            for name in _own(context, task):
                context.runner.programs.unload(task, name)
        for file, place in zip(files, places, strict=True):
            context.runner.programs.load(task, place, f"{folder}/{file}", replaced=False)
    except CannotLoad as fault:
        raise load_refused(request, fault, text) from fault
    context.program_names[task.name] = path.stem


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
def unload(context: "RwsContext", request: RwsRequest) -> None:
    """Unload the program's modules; system modules stay."""
    context.masters.need(request, "rapid")
    task = find_task(context, request.names["task"], request)
    try:
        for name in _own(context, task):
            context.runner.programs.unload(task, name)
    except CannotLoad as fault:
        raise load_refused(request, fault, task.name) from fault
    context.program_names.pop(task.name, None)


@serves(ops.SAVE_PROGRAM)
def save(context: "RwsContext", request: RwsRequest) -> None:
    """Save the program's modules and program file into a folder.

    The folder is created if it is missing.
    """
    task = find_task(context, request.names["task"], request)
    words = request.field("path")
    folder = disk_path(context, words, request)
    name = request.form.get("name") or context.program_names.get(task.name) or task.name
    if "/" in name or "\\" in name:
        raise RequestDenied(400, "E_INVALID_PATH", name)
    file = disk_path(context, f"{words}/{name}.pgf", request)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise RequestDenied(404, "E_DIR_NOT_EXIST", words) from error
    listed = []
    for own in _own(context, task):
        module = task.program.modules.get(own.lower())
        text = module_text(task, module) if module else context.runner.programs.text(task, own)
        place = disk_path(context, f"{words}/{own}.mod", request)
        context.write_file(place, (text or "").encode("latin-1", "replace"))
        listed.append(f"<Module>{escaped(own)}.mod</Module>")
    head = '<?xml version="1.0" encoding="ISO-8859-1" ?>'
    complete = f"{head}\n<Program>{''.join(listed)}</Program>\n"
    context.write_file(file, complete.encode("latin-1", "replace"))
