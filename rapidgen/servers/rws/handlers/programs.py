"""Programs of tasks: what is wrong with them, and program files (.pgf), which list modules."""

from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree.ElementTree import ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import fromstring

from rapidgen._reading import read_foreign
from rapidgen.controller.programs import CannotLoad
from rapidgen.runtime.loading import LARGEST_MODULE, module_text
from rapidgen.runtime.task.task import Task
from rapidgen.servers.rws.disks import disk_path
from rapidgen.servers.rws.handlers.tasks import find_task, load_refused
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.xhtml import text as escaped

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@serves(ops.PROGRAM)
def get_program(office: "RwsContext", asked: RwsRequest) -> RwsResponse | None:
    """The program of a task; nothing where there is none."""
    task = find_task(office, asked.names["task"], asked)
    if not office.cabinet.programs.modules(task):
        return None
    name = office.program_names.get(task.name, "")
    return show(Item("rap-program", "program", {"name": name, "entrypoint": task.spec.entry}))


@serves(ops.BUILD_ERRORS)
def get_build_errors(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """What is wrong with the program of a task."""
    task = find_task(office, asked.names["task"], asked)
    names = {m.file.path: m.name for m in office.cabinet.programs.modules(task)}
    found = []
    for fault in office.cabinet.programs.faults(task):
        span = fault.span
        told = {
            "ModuleName": names.get(span.path, "") if span else "",
            "row": str(span.line if span else 0),
            "column": str(span.column if span else 0),
            "error": fault.message,
        }
        found.append(Item("rap-builderrs", "builderror", told))
    return show(*found)


def _own(office: "RwsContext", task: Task) -> list[str]:
    """Modules of the program: system modules are not of it."""
    programs = office.cabinet.programs
    return [m.name for m in programs.modules(task) if not m.is_system and not m.file.shared]


@serves(ops.LOAD_PROGRAM)
def load(office: "RwsContext", asked: RwsRequest) -> None:
    """Load the modules that a program file lists, from its folder; `replace` takes out the rest."""
    office.masters.need(asked, "rapid")
    task = find_task(office, asked.names["task"], asked)
    words = asked.field("progpath")
    mode = asked.form.get("loadmode", "replace")
    if mode not in ("add", "replace"):
        raise RequestDenied(400, "E_INVALIDARG", f"loadmode {mode}")
    path = disk_path(office, words, asked)
    folder = words.rpartition("/")[0]
    files = _listed(path, asked, words)
    places = [disk_path(office, f"{folder}/{file}", asked) for file in files]
    for file, place in zip(files, places, strict=True):
        if not place.is_file():
            raise RequestDenied(400 if asked.is_one else 404, "E_FILE_NOT_FOUND", file)
    try:
        if mode == "replace":
            for name in _own(office, task):
                office.cabinet.programs.unload(task, name)
        for file, place in zip(files, places, strict=True):
            office.cabinet.programs.load(task, place, f"{folder}/{file}", replaced=False)
    except CannotLoad as fault:
        raise load_refused(asked, fault, words) from fault
    office.program_names[task.name] = path.stem


def _listed(path: Path, asked: RwsRequest, words: str) -> list[str]:
    """Files of a program, which lie in its folder. Denied: it is none."""
    try:
        root = fromstring(read_foreign(path, LARGEST_MODULE))
    except OSError as error:
        raise RequestDenied(400 if asked.is_one else 404, "E_FILE_NOT_FOUND", words) from error
    except (ParseError, DefusedXmlException, ValueError) as error:
        raise RequestDenied(400, "E_INVALID_PROGRAMFILE", words) from error
    files = [(e.text or "").strip() for e in root.iter() if e.tag == "Module"]
    if root.tag != "Program" or not files or any("/" in f or "\\" in f or not f for f in files):
        raise RequestDenied(400, "E_INVALID_PROGRAMFILE", words)
    return files


@serves(ops.UNLOAD_PROGRAM)
def unload(office: "RwsContext", asked: RwsRequest) -> None:
    """Take the program's modules out; system modules stay."""
    office.masters.need(asked, "rapid")
    task = find_task(office, asked.names["task"], asked)
    try:
        for name in _own(office, task):
            office.cabinet.programs.unload(task, name)
    except CannotLoad as fault:
        raise load_refused(asked, fault, task.name) from fault
    office.program_names.pop(task.name, None)


@serves(ops.SAVE_PROGRAM)
def save(office: "RwsContext", asked: RwsRequest) -> None:
    """Write the program's modules and its program file into a folder, made where it is none."""
    task = find_task(office, asked.names["task"], asked)
    words = asked.field("path")
    folder = disk_path(office, words, asked)
    name = asked.form.get("name") or office.program_names.get(task.name) or task.name
    if "/" in name or "\\" in name:
        raise RequestDenied(400, "E_INVALID_PATH", name)
    file = disk_path(office, f"{words}/{name}.pgf", asked)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise RequestDenied(404, "E_DIR_NOT_EXIST", words) from error
    listed = []
    for own in _own(office, task):
        module = task.program.modules.get(own.lower())
        text = module_text(task, module) if module else office.cabinet.programs.text(task, own)
        place = disk_path(office, f"{words}/{own}.mod", asked)
        office.write_file(place, (text or "").encode("latin-1", "replace"))
        listed.append(f"<Module>{escaped(own)}.mod</Module>")
    head = '<?xml version="1.0" encoding="ISO-8859-1" ?>'
    whole = f"{head}\n<Program>{''.join(listed)}</Program>\n"
    office.write_file(file, whole.encode("latin-1", "replace"))
