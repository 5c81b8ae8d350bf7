"""The file service: volumes of the controller, including HOME.

No path leads out of them.
"""

import shutil
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen._reading import read_foreign
from rapidgen.machine.files import CAPACITY
from rapidgen.servers.rws.context import VOLUMES, disk_path
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@serves(ops.VOLUMES)
def volumes(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the volumes: variables with a `$` in RWS 1.0 [VC 6.16]."""
    kind, sign = request.kind("fs-device", "fs-dir"), request.kind("$", "")
    return show(*(Item(kind, f"{sign}{name}") for name in VOLUMES), collection=True)


def _path(context: "RwsContext", request: RwsRequest) -> Path:
    return disk_path(context, request.names["path"], request)


def _missing(request: RwsRequest, what: str) -> RequestDenied:
    if request.is_one:
        return RequestDenied(404, "E_FAIL", f"no file {what}")
    return RequestDenied(404, "E_DIR_NOT_EXIST", f"no file {what}")


@serves(ops.READ_FILE)
def read(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return a file, or the entries of a folder."""
    path = _path(context, request)
    if path.is_dir():
        entries = sorted(path.iterdir(), key=lambda p: p.name.lower())
        return show(*(_entry(p) for p in entries if not p.is_symlink()), collection=True)
    try:
        return RwsResponse(200, data=read_foreign(path, CAPACITY))
    except OSError as error:
        raise _missing(request, request.names["path"]) from error


def _entry(path: Path) -> Item:
    status = path.stat()
    changed = datetime.fromtimestamp(status.st_mtime, timezone.utc).strftime("%Y-%m-%d T %H:%M:%S")
    notify = {"fs-cdate": changed, "fs-mdate": changed}
    if path.is_dir():
        return Item("fs-dir", path.name, notify)
    return Item(
        "fs-file", path.name, {**notify, "fs-size": str(status.st_size), "fs-readonly": "false"}
    )


@serves(ops.WRITE_FILE)
def write(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Write a file: 201 for a new one, 200 for another [VC 6.16, VC 7.21]."""
    path = _path(context, request)
    if path.is_dir():
        raise RequestDenied(400, "E_DIR_EXIST", request.names["path"])
    if not path.parent.is_dir():
        raise _missing(request, request.names["path"])
    return RwsResponse(201 if context.write_file(path, request.body) else 200)


@serves(ops.DELETE_FILE)
def delete(context: "RwsContext", request: RwsRequest) -> None:
    """Delete a file, or a folder with its content."""
    path = _path(context, request)
    if _is_volume(context, path):
        raise RequestDenied(403, "E_REJECT", "a volume cannot be deleted", -2)
    try:
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()
    except OSError as error:
        raise _missing(request, request.names["path"]) from error


def _is_volume(context: "RwsContext", path: Path) -> bool:
    """True for the volume itself, in any spelling: `HOME/.`, `HOME/a/..`."""
    return path.parent == context.controller.files.folder


@serves(ops.FILE_ACTION)
def act(context: "RwsContext", request: RwsRequest) -> RwsResponse | None:
    """RWS 1.0: execute `fs-action`, which must be in the body."""
    action = request.field("fs-action", ("create", "copy", "rename"))
    return {"create": create, "copy": copy, "rename": rename}[action](context, request)


@serves(ops.CREATE_FOLDER)
def create(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Create a folder."""
    path = _new(context, request, _path(context, request), request.names["path"])
    try:
        path.mkdir()
    except FileExistsError as error:
        raise RequestDenied(400, "E_DIR_EXIST", path.name) from error
    except OSError as error:
        raise _missing(request, request.names["path"]) from error
    return RwsResponse(201)


@serves(ops.COPY_FILE)
def copy(context: "RwsContext", request: RwsRequest) -> None:
    """Copy a file; a bare name stays in the folder [VC 7.21]."""
    path, target = _two(context, request)
    if target.exists() and request.form.get("fs-overwrite", "false").lower() != "true":
        raise RequestDenied(403, "E_ALREADY_EXISTS", target.name)
    if not path.is_file():
        raise _missing(request, request.names["path"])
    context.write_file(target, read_foreign(path, CAPACITY))


@serves(ops.RENAME_FILE)
def rename(context: "RwsContext", request: RwsRequest) -> None:
    """Rename a file or a folder."""
    path, target = _two(context, request)
    if target.exists():
        raise RequestDenied(403, "E_ALREADY_EXISTS", target.name)
    try:
        path.rename(target)
    except OSError as error:
        raise _missing(request, request.names["path"]) from error


def _two(context: "RwsContext", request: RwsRequest) -> tuple[Path, Path]:
    current, path = request.names["path"], _path(context, request)
    if _is_volume(context, path):
        raise RequestDenied(403, "E_REJECT", "a volume stays what it is", -2)
    return path, _new(context, request, None, current.rpartition("/")[0])


def _new(context: "RwsContext", request: RwsRequest, folder: Path | None, text: str) -> Path:
    """Return the path of `fs-newname`.

    It is a name in the folder, or a whole `/fileservice/...`.
    """
    name = request.field("fs-newname")
    if name.startswith("/fileservice/"):
        return disk_path(context, name, request)
    if not name or "/" in name or "\\" in name or name in (".", ".."):
        raise RequestDenied(400, "E_INVALID_PATH", name)
    if folder is not None and not folder.is_dir():
        raise _missing(request, text)
    return disk_path(context, f"{text}/{name}", request)
