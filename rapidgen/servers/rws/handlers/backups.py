"""Backups: made, looked at, restored."""

from typing import TYPE_CHECKING

from rapidgen.controller.backup_writer import back_up
from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers.rws.disks import disk_path
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.system import is_backup, read_backup
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@serves(ops.BACKUP)
def back_up_now(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """A backup into a new folder: done when it is answered."""
    words = asked.field("backup")
    if not words.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{words}: /fileservice/... is wanted")
    path, cabinet = disk_path(office, words, asked), office.cabinet
    if path.exists():
        raise RequestDenied(400, "E_DIR_EXIST", words)
    try:
        back_up(cabinet.controller, cabinet.programs, cabinet.cfg, path)
    except OSError as error:
        raise RequestDenied(400, "E_DIR_NOT_EXIST", words) from error
    office.controller.log.info(10_230, "Backup finished", words)
    return office.started("")


@serves(ops.BACKUP_STATE)
def backup_state(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether a backup is under way: never, here."""
    return show(Item("ctrl-backup", "state", {"state": "0", "backup-state": "idle"}))


@serves(ops.BACKUPS)
def backups(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """What there is about backups: none is under way."""
    return show(Item("ctrl-backup-info-li", "backup", {"state": "0"}, {"self": "state"}))


@serves(ops.CHECK_RESTORE)
def check_restore(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether a folder is a backup that could be restored."""
    path = disk_path(office, asked.field("backup"), asked)
    if not is_backup(path):
        return office.started("E_DIR_NOT_EXIST")
    try:
        read_backup(path, notes=[])
    except DiagnosticError:
        return office.started("E_FAIL")
    return office.started("")


@serves(ops.RESTORE)
def restore(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Restart with what a backup holds: modules, cfg, HOME. Everybody is logged out."""
    office.masters.need(asked, "cfg")
    words = asked.field("backup")
    if not words.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{words}: /fileservice/... is wanted")
    path = disk_path(office, words, asked)
    if not is_backup(path):
        raise RequestDenied(400, "E_DIR_NOT_EXIST", f"{words} is no backup")
    try:
        office.cabinet.ask_restore(path)
    except DiagnosticError as error:
        raise RequestDenied(400, "E_FAIL", str(error)) from error
    return office.started("")
