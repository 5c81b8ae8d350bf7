"""The file service: volumes of the controller, including HOME; backups.

No path leads out of them.
"""

import shutil
from datetime import datetime, timezone
from pathlib import Path

from rapidgen._reading import read_foreign
from rapidgen.controller.programs import back_up
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.files import CAPACITY, DiskFault
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.system import is_backup, read_backup
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

VOLUMES = ("HOME", "TEMP", "BACKUP", "RAMDISK")


def disk_path(app: RwsApplication, words: str, request: RwsRequest) -> Path:
    """Return the file of a path on a volume.

    The path is `$HOME/a`, `HOME/a`, `HOME:/a` or `/fileservice/...`. RequestDenied: it names no
    volume, or leads out of one.
    """
    text = words.removeprefix("/fileservice/").strip("/")
    first, _, remaining = text.partition("/")
    name = first.strip("$:").upper()
    if ":" in first.rstrip(":"):
        name, _, more = first.partition(":")
        name, remaining = name.strip("$").upper(), f"{more}/{remaining}".strip("/")
    if name not in VOLUMES:
        # RobotWare 6 and 7 differ here [VC 6.16, VC 7.21].
        if request.is_one:
            raise RequestDenied(404, "E_FAIL", f"no volume {first}")
        raise RequestDenied(400, "E_INVALID_PATH", f"no volume {first}")
    try:
        return app.controller.files.path(f"{name}:{remaining}")
    except DiskFault as fault:
        raise RequestDenied(400, "E_INVALID_PATH", str(fault)) from fault


def write_file(app: RwsApplication, path: Path, data: bytes) -> bool:
    """Write a file of the controller's disks; return True if it is new.

    Raises RequestDenied.
    """
    new = not path.exists()
    try:
        app.controller.files.spend(len(data))
        path.write_bytes(data)
    except DiskFault as fault:
        raise RequestDenied(507, "E_NOT_ENOUGH_SPACE", str(fault)) from fault
    except OSError as fault:
        raise RequestDenied(404, "E_DIR_NOT_EXIST", fault.strerror or "") from fault
    return new


@serves(ops.VOLUMES)
def volumes(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the volumes: variables with a `$` in RWS 1.0 [VC 6.16]."""
    kind, sign = request.kind("fs-device", "fs-dir"), request.kind("$", "")
    return show(*(Item(kind, f"{sign}{name}") for name in VOLUMES), collection=True)


def _path(app: RwsApplication, request: RwsRequest) -> Path:
    return disk_path(app, request.names["path"], request)


def _missing(request: RwsRequest, what: str) -> RequestDenied:
    if request.is_one:
        return RequestDenied(404, "E_FAIL", f"no file {what}")
    return RequestDenied(404, "E_DIR_NOT_EXIST", f"no file {what}")


@serves(ops.READ_FILE)
def read(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return a file, or the entries of a folder."""
    path = _path(app, request)
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
def write(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Write a file: 201 for a new one, 200 for another [VC 6.16, VC 7.21]."""
    path = _path(app, request)
    if path.is_dir():
        raise RequestDenied(400, "E_DIR_EXIST", request.names["path"])
    if not path.parent.is_dir():
        raise _missing(request, request.names["path"])
    return RwsResponse(201 if write_file(app, path, request.body) else 200)


@serves(ops.DELETE_FILE)
def delete(app: RwsApplication, request: RwsRequest) -> None:
    """Delete a file, or a folder with its content."""
    path = _path(app, request)
    if _is_volume(app, path):
        raise RequestDenied(403, "E_REJECT", "a volume cannot be deleted", -2)
    try:
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()
    except OSError as error:
        raise _missing(request, request.names["path"]) from error


def _is_volume(app: RwsApplication, path: Path) -> bool:
    """True for the volume itself, in any spelling: `HOME/.`, `HOME/a/..`."""
    return path.parent == app.controller.files.folder


@serves(ops.FILE_ACTION)
def act(app: RwsApplication, request: RwsRequest) -> RwsResponse | None:
    """RWS 1.0: execute `fs-action`, which must be in the body."""
    action = request.field("fs-action", ("create", "copy", "rename"))
    return {"create": create, "copy": copy, "rename": rename}[action](app, request)


@serves(ops.CREATE_FOLDER)
def create(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Create a folder."""
    path = _new(app, request, _path(app, request), request.names["path"])
    try:
        path.mkdir()
    except FileExistsError as error:
        raise RequestDenied(400, "E_DIR_EXIST", path.name) from error
    except OSError as error:
        raise _missing(request, request.names["path"]) from error
    return RwsResponse(201)


@serves(ops.COPY_FILE)
def copy(app: RwsApplication, request: RwsRequest) -> None:
    """Copy a file; a bare name stays in the folder [VC 7.21]."""
    path, target = _two(app, request)
    if target.exists() and request.form.get("fs-overwrite", "false").lower() != "true":
        raise RequestDenied(403, "E_ALREADY_EXISTS", target.name)
    if not path.is_file():
        raise _missing(request, request.names["path"])
    write_file(app, target, read_foreign(path, CAPACITY))


@serves(ops.RENAME_FILE)
def rename(app: RwsApplication, request: RwsRequest) -> None:
    """Rename a file or a folder."""
    path, target = _two(app, request)
    if target.exists():
        raise RequestDenied(403, "E_ALREADY_EXISTS", target.name)
    try:
        path.rename(target)
    except OSError as error:
        raise _missing(request, request.names["path"]) from error


def _two(app: RwsApplication, request: RwsRequest) -> tuple[Path, Path]:
    current, path = request.names["path"], _path(app, request)
    if _is_volume(app, path):
        raise RequestDenied(403, "E_REJECT", "a volume stays what it is", -2)
    return path, _new(app, request, None, current.rpartition("/")[0])


def _new(app: RwsApplication, request: RwsRequest, folder: Path | None, text: str) -> Path:
    """Return the path of `fs-newname`.

    It is a name in the folder, or a whole `/fileservice/...`.
    """
    name = request.field("fs-newname")
    if name.startswith("/fileservice/"):
        return disk_path(app, name, request)
    if not name or "/" in name or "\\" in name or name in (".", ".."):
        raise RequestDenied(400, "E_INVALID_PATH", name)
    if folder is not None and not folder.is_dir():
        raise _missing(request, text)
    return disk_path(app, f"{text}/{name}", request)


# -- backups ---------------------------------------------------------------------------------------


@serves(ops.BACKUP)
def back_up_now(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Make a backup in a new folder, before the answer."""
    text = request.field("backup")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    path, controller_runner = disk_path(app, text, request), app.runner
    if path.exists():
        raise RequestDenied(400, "E_DIR_EXIST", text)
    try:
        back_up(
            controller_runner.controller, controller_runner.programs, controller_runner.cfg, path
        )
    except OSError as error:
        raise RequestDenied(400, "E_DIR_NOT_EXIST", text) from error
    app.controller.log.info(10_230, "Backup finished", text)
    return app.started("")


@serves(ops.BACKUP_STATE)
def backup_state(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the state of the backup; none ever runs here."""
    return show(Item("ctrl-backup", "state", {"state": "0", "backup-state": "idle"}))


@serves(ops.BACKUPS)
def backups(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the backup resources; none runs."""
    return show(Item("ctrl-backup-info-li", "backup", {"state": "0"}, {"self": "state"}))


@serves(ops.CHECK_RESTORE)
def check_restore(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Check whether a folder is a backup that could be restored."""
    path = disk_path(app, request.field("backup"), request)
    if not is_backup(path):
        return app.started("E_DIR_NOT_EXIST")
    try:
        read_backup(path, notes=[])
    except DiagnosticError:
        return app.started("E_FAIL")
    return app.started("")


@serves(ops.RESTORE)
def restore(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Restart with a backup's modules, cfg and HOME.

    All sessions end.
    """
    app.masterships.need(request, "cfg")
    text = request.field("backup")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    path = disk_path(app, text, request)
    if not is_backup(path):
        raise RequestDenied(400, "E_DIR_NOT_EXIST", f"{text} is no backup")
    try:
        app.runner.ask_restore(path)
    except DiagnosticError as error:
        raise RequestDenied(400, "E_FAIL", str(error)) from error
    return app.started("")
