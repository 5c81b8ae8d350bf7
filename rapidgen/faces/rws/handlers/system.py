"""The controller itself: identity, system, clock, variables, restart, jobs."""

from typing import TYPE_CHECKING

from rapidgen.controller.backing_up import back_up
from rapidgen.faces.rws.asking import Answer, Asked, Refused, show
from rapidgen.faces.rws.disks import disk_path
from rapidgen.faces.rws.routing import serves
from rapidgen.machine.calendar import date_time
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item

if TYPE_CHECKING:
    from rapidgen.faces.rws.desk import Desk

_VARIABLES = {"$HOME": "HOME", "$TEMP": "TEMP", "$RAMDISK": "RAMDISK", "$BACKUP": "BACKUP"}
_MODES = ("restart", "istart", "pstart", "bstart")


def version(desk: "Desk") -> tuple[int, int]:
    """RobotWare's release, of the generation that is spoken."""
    major, minor = desk.controller.system.robotware
    least = {Generation.ONE: 6, Generation.TWO: 7, Generation.EIGHT: 8}[desk.generation]
    return (major, minor) if major == least else (least, 0)


@serves(ops.CONTROLLER, ops.IDENTITY)
def identity(desk: "Desk", asked: Asked) -> Answer:
    """Who this controller is; it says that it is a virtual one."""
    told = {
        "ctrl-name": desk.controller.system.name,
        "ctrl-id": desk.cabinet.id,
        "ctrl-type": "Virtual Controller",
        "ctrl-mac": "",
    }
    return show(Item("ctrl-identity-info", "identity", told))


@serves(ops.SYSTEM)
def get_system(desk: "Desk", asked: Asked) -> Answer:
    """Name and RobotWare."""
    (major, minor), name = version(desk), desk.controller.system.name
    if asked.is_one:
        told = {
            "name": name,
            "rwversion": f"{major}.{minor:02}.0.0",
            "sysid": desk.cabinet.id,
            "starttm": "",
            "rwversionname": f"{major}.{minor:02}.00.00",
        }
        return show(Item("sys-system-li", "system", told), *_options("sys-option-li"))
    told = {
        "major": str(major),
        "minor": str(minor),
        "build": "0",
        "name": name,
        "rwversion": f"{major}.{minor}.0+0",
        "rwversionname": f"{major}.{minor}.0",
        "sysid": desk.cabinet.id,
    }
    return show(Item("sys-system", "system", told))


def _options(kind: str) -> list[Item]:
    return [Item(kind, str(i), {"option": "616-1 PC Interface"}) for i in (1,)]


@serves(ops.OPTIONS)
def get_options(desk: "Desk", asked: Asked) -> Answer:
    """What is installed."""
    return show(*_options("sys-option"), collection=True)


@serves(ops.PRODUCTS)
def get_products(desk: "Desk", asked: Asked) -> Answer:
    """Products: RobotWare alone."""
    major, minor = version(desk)
    told = {"version": f"{major}.{minor}", "version-name": f"{major}.{minor}.0"}
    return show(Item("sys-product-li", "RobotWare", told), collection=True)


@serves(ops.ROBOT_TYPE)
def get_robot_type(desk: "Desk", asked: Asked) -> Answer:
    """The robot's type, where a backup tells it."""
    types = desk.controller.system.robot_types
    return show(Item("sys-robottype", "robottype", {"robot-type": types[0][1] if types else ""}))


@serves(ops.CLOCK)
def get_clock(desk: "Desk", asked: Asked) -> Answer:
    """Date and time."""
    now = date_time(desk.controller.scheduler)
    told = {"datetime": now.strftime("%Y-%m-%d T %H:%M:%S")}
    return show(Item("ctrl-clock-info", "clock", told))


@serves(ops.VARIABLE)
def get_variable(desk: "Desk", asked: Asked) -> Answer:
    """Where a variable points to: here to the volume of that name."""
    name = asked.names["variable"]
    folder = _VARIABLES.get(name.upper())
    if folder is None:
        raise Refused(404, "E_UNRESOLVED_URL", name)
    return show(Item("ctrl-env", name, {"_value": folder, "value": folder}))


@serves(ops.RESTART, ops.RESTART_AT_CTRL)
def restart(desk: "Desk", asked: Asked) -> None:
    """A warm start: everybody is logged out. Other kinds are not offered here."""
    desk.masters.need(asked, "cfg")
    mode = asked.field("restart-mode", (*_MODES, "xstart", "shutdown"))
    if mode != "restart":
        raise Refused(403, "E_REJECT", f"{mode}: only warm starts here", -2)
    desk.cabinet.ask_restart()


@serves(ops.PROGRESS)
def get_progress(desk: "Desk", asked: Asked) -> Answer:
    """How far a job is: all are done at once here."""
    code = desk.progress.get(asked.names["id"])
    if code is None:
        raise Refused(404, "E_UNRESOLVED_URL", asked.path)
    return show(Item("progress", asked.names["id"], {"state": "ready", "code": str(code)}))


@serves(ops.BACKUP)
def back_up_now(desk: "Desk", asked: Asked) -> Answer:
    """A backup into a new folder: done when it is answered."""
    words = asked.field("backup")
    if not words.startswith("/fileservice/"):
        raise Refused(400, "E_INVALID_PATH", f"{words}: /fileservice/... is wanted")
    path, cabinet = disk_path(desk, words, asked), desk.cabinet
    if path.exists():
        raise Refused(400, "E_DIR_EXIST", words)
    try:
        back_up(cabinet.controller, cabinet.programs, cabinet.cfg, path)
    except OSError as error:
        raise Refused(400, "E_DIR_NOT_EXIST", words) from error
    desk.controller.log.info(10_230, "Backup finished", words)
    return desk.started("")


@serves(ops.BACKUP_STATE)
def backup_state(desk: "Desk", asked: Asked) -> Answer:
    """Whether a backup is under way: never, here."""
    return show(Item("ctrl-backup", "state", {"state": "0", "backup-state": "idle"}))
