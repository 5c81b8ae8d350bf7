"""Grants of the user authorization system that operations require.

Names and uses: ABB's OmniCore App SDK 1.2 and intellij-rapid [code]; a remote start and stop
require a grant of their own on RobotWare 7 [real 7.21]. For the others ABB's manuals give only the
names. Reading requires none, except for files.
"""

from collections.abc import Iterable

from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.operations import RwsOperation

_REMOTE_START = "UAS_REMOTE_START_STOP_IN_AUTO"
_READ, _WRITE = "UAS_FILE_ACCESS_READ", "UAS_FILE_ACCESS_READ_WRITE"
_FTP_READ, _FTP_WRITE = "UAS_FTP_READ", "UAS_FTP_WRITE"
"""File access grants on RobotWare 6 [code: App SDK]."""

GRANTS = (
    "UAS_BACKUP", "UAS_CALIBRATE", "UAS_CFG_WRITE", "UAS_CONTROLLER_PROPERTIES_WRITE",
    "UAS_EVENTLOG_CLEAR", _READ, _WRITE, _FTP_READ, _FTP_WRITE, "UAS_IO_WRITE",
    "UAS_RAPID_CURRVALUE", "UAS_RAPID_DEBUG", "UAS_RAPID_EDIT", "UAS_RAPID_EXECUTE",
    "UAS_RAPID_LOADPROGRAM", "UAS_RAPID_MODPOS", "UAS_REMOTE_LOGIN", _REMOTE_START,
    "UAS_REMOTE_WARMSTART", "UAS_RESTORE", "UAS_REVOLUTION_COUNTER_UPDATE", "UAS_SPEED_DECREASE",
    "UAS_SYSTEM_ADMINISTRATION", "UAS_SYSUPDATE",
)  # fmt: skip

_NEEDED: dict[str, tuple[RwsOperation, ...]] = {
    "UAS_RAPID_EXECUTE": (
        ops.START,
        ops.RESET_PP,
        ops.POINTER_TO_ROUTINE,
        ops.POINTER_TO_CURSOR,
        ops.POINTER_TO_MAIN,
        ops.START_ENTRY,
        ops.SET_CYCLE,
        ops.ACTIVATE,
        ops.DEACTIVATE,
        ops.ACTIVATE_ALL,
        ops.DEACTIVATE_ALL,
    ),
    "UAS_RAPID_LOADPROGRAM": (
        ops.LOAD_MODULE,
        ops.UNLOAD_MODULE,
        ops.LOAD_PROGRAM,
        ops.UNLOAD_PROGRAM,
    ),
    "UAS_RAPID_EDIT": (ops.SET_TEXT, ops.SET_TEXT_RANGE),
    "UAS_RAPID_CURRVALUE": (ops.SET_SYMBOL,),
    "UAS_IO_WRITE": (ops.SET_SIGNAL,),
    "UAS_SPEED_DECREASE": (ops.SET_SPEED,),
    "UAS_CFG_WRITE": (ops.CFG_SET, ops.CFG_CREATE, ops.CFG_DELETE, ops.CFG_LOAD),
    "UAS_REMOTE_WARMSTART": (ops.RESTART, ops.RESTART_AT_CTRL),
    "UAS_BACKUP": (ops.BACKUP,),
    "UAS_RESTORE": (ops.RESTORE,),
    "UAS_EVENTLOG_CLEAR": (ops.CLEAR_ELOG, ops.CLEAR_ELOGS),
    "UAS_CONTROLLER_PROPERTIES_WRITE": (ops.SET_CLOCK,),
}
_OF: dict[RwsOperation, str] = {o: grant for grant, them in _NEEDED.items() for o in them}
_REMOTE = (ops.START, ops.START_ENTRY, ops.STOP, ops.SET_CTRL_STATE)
_READING = (ops.VOLUMES, ops.READ_FILE)
_WRITING = (
    ops.WRITE_FILE, ops.DELETE_FILE, ops.FILE_ACTION, ops.CREATE_FOLDER, ops.COPY_FILE,
    ops.RENAME_FILE, ops.SAVE_MODULE, ops.CFG_SAVE, ops.SAVE_PROGRAM, ops.SAVE_ELOG,
)  # fmt: skip


def missing(grants: Iterable[str], granted: frozenset[str]) -> tuple[str, ...]:
    """Return those of the grants that a user lacks."""
    return tuple(g for g in grants if g not in granted and not _more(g, granted))


def needed(operation: RwsOperation, generation: Generation) -> tuple[str, ...]:
    """Return the grants that an operation requires."""
    is_one = generation is Generation.ONE
    if operation in _READING:
        return (_FTP_READ if is_one else _READ,)
    if operation in _WRITING:
        return (_FTP_WRITE if is_one else _WRITE,)
    remote = operation in _REMOTE and not is_one
    own = _OF.get(operation, "")
    return tuple(filter(None, (own, _REMOTE_START if remote else "")))


def _more(grant: str, granted: frozenset[str]) -> bool:
    """True if another grant includes this one: writing files includes reading."""
    return {_READ: _WRITE, _FTP_READ: _FTP_WRITE}.get(grant) in granted
