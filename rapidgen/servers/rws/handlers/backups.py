"""Backups: make, check, restore."""

from typing import TYPE_CHECKING

from rapidgen.controller.programs import back_up
from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers.rws.context import disk_path
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.system import is_backup, read_backup
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@serves(ops.BACKUP)
def back_up_now(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Make a backup in a new folder, before the answer."""
    text = request.field("backup")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    path, controller_runner = disk_path(context, text, request), context.runner
    if path.exists():
        raise RequestDenied(400, "E_DIR_EXIST", text)
    try:
        back_up(
            controller_runner.controller, controller_runner.programs, controller_runner.cfg, path
        )
    except OSError as error:
        raise RequestDenied(400, "E_DIR_NOT_EXIST", text) from error
    context.controller.log.info(10_230, "Backup finished", text)
    return context.started("")


@serves(ops.BACKUP_STATE)
def backup_state(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the state of the backup; none ever runs here."""
    return show(Item("ctrl-backup", "state", {"state": "0", "backup-state": "idle"}))


@serves(ops.BACKUPS)
def backups(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the backup resources; none runs."""
    return show(Item("ctrl-backup-info-li", "backup", {"state": "0"}, {"self": "state"}))


@serves(ops.CHECK_RESTORE)
def check_restore(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Check whether a folder is a backup that could be restored."""
    path = disk_path(context, request.field("backup"), request)
    if not is_backup(path):
        return context.started("E_DIR_NOT_EXIST")
    try:
        read_backup(path, notes=[])
    except DiagnosticError:
        return context.started("E_FAIL")
    return context.started("")


@serves(ops.RESTORE)
def restore(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Restart with a backup's modules, cfg and HOME.

    All sessions end.
    """
    context.masters.need(request, "cfg")
    text = request.field("backup")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    path = disk_path(context, text, request)
    if not is_backup(path):
        raise RequestDenied(400, "E_DIR_NOT_EXIST", f"{text} is no backup")
    try:
        context.runner.ask_restore(path)
    except DiagnosticError as error:
        raise RequestDenied(400, "E_FAIL", str(error)) from error
    return context.started("")
