"""Errors of Robot Web Services: ABB's symbols and their fixes."""

from rapidgen.client.errors import ConnectionFailed, RobotError, fault
from rapidgen.wire.rws.bodies import Fault
from rapidgen.wire.rws.codes import name_of

_HELPS = {
    "E_MASTER_REJECT": "take mastership first: `with controller.mastership():`",
    "E_NO_WRITE_ACCESS": "take write access first: `with controller.mastership():`",
    "E_RESOURCE_HELD": "another client holds it: wait for it, or end its session",
    "E_WRITE_ACCESS_TAKEN": "another control station writes: wait until it lets go",
    "E_UAS_REJECT": "this user lacks the grant: give it in RobotStudio, or log in as another",
    "E_MODE_REJECT": "switch the controller to automatic mode at the pendant, or `ask_rmmp()`",
    "E_SYSFAIL_REJECT": "the controller is in system failure: read its log, fix it, restart it",
    "E_EXEC_STATE": "stop RAPID in all tasks first, background tasks too",
    "E_NO_PP": "set the program pointer to main, and look at the build errors",
    "E_RAPID_SYNTAX_ERROR": "`build_errors(task)` lists the places",
    "E_RAPID_SEMANTIC_ERROR": "`build_errors(task)` lists the places",
    "E_CFG_NAME_EXIST": 'an instance of that name exists: load in mode "replace", or rename it',
    "E_NOT_ENOUGH_SPACE": "the controller's disk is full: delete old files and backups",
    "E_DEVICE_FULL": "the controller's disk is full: delete old files and backups",
}
_NAMELESS = (
    "E_UNRESOLVED_URL",
    "E_INVALIDARG",
    "E_NO_SUCH_SYMBOL",
    "E_UNEXPECTED",
    "E_FAIL",
    "E_DIR_NOT_EXIST",
    "E_FILE_NOT_FOUND",
    "E_NO_DATA",
    "E_INVALIDSLOTID",
)
"""Symbols of missing or mismatching resources, which the path identifies."""
_WHERE = {
    "/rw/iosystem/": "`rapidgen io HOST`, `signals()`: the signals that there are",
    "/rw/rapid/symbol": "`rapidgen symbols HOST`, `symbols(task)`: the data that there are; a "
    "value is one of the datum's type",
    "/rw/rapid/tasks": "`rapidgen status HOST`, `tasks()`, `modules(task)`: what there is",
    "/rw/rapid/modules": "`tasks()`, `modules(task)`: what there is",
    "/rw/rapid/uiinstr": "`dialog()` returns the open dialog and its answers",
    "/rw/dipc": "a queue is made by `make_queue`; those of tasks are RMQ_TASK, and take type;value",
    "/rw/elog": "domain 0 has the entries of all",
    "/rw/motionsystem": "`mechanical_units()`: the units that there are",
    "/fileservice": "`list_files()` shows the files there",
}
_REJECTED = (
    "motors on and start are refused after a stop until it is reset at the robot; a signal's "
    "access level must be All to be set from afar"
)


class RwsError(RobotError):
    """The controller refused: HTTP `status` and ABB's `symbol`.

    `symbol` is empty if there was none. `grants` are those that the request needs, by UAS name.
    """

    def __init__(
        self, status: int, what: str, refused: Fault | None, grants: tuple[str, ...] = ()
    ) -> None:
        symbol = name_of(refused.code) if refused is not None else ""
        words = f"{symbol}: {refused.message}" if refused is not None else f"HTTP status {status}"
        if symbol == "E_UAS_REJECT" and grants:
            words += f" (it needs {' and '.join(grants)})"
        help = _HELPS.get(symbol) or (_REJECTED if symbol == "E_REJECT" else "")
        if symbol in _NAMELESS:
            path = what.partition(" ")[2]
            help = next((help for begin, help in _WHERE.items() if path.startswith(begin)), "")
        super().__init__(fault("RG650", f"{what} was refused ({status}): {words}", help))
        self.status = status
        self.symbol = symbol


class LoginFailed(ConnectionFailed):
    """Missing or wrong password, or no trusted server to send it to."""


class NotConfirmed(RobotError):
    """The controller accepted a command without effect."""


class MastershipHeld(RobotError):
    """Another client has mastership or write access."""


class Busy(RobotError):
    """Too many requests, or too many sessions."""


class NotRws(RobotError):
    """The server does not speak Robot Web Services."""
