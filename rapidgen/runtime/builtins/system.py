"""What the controller tells about itself, and its text tables.

Sources: [K §15] for text tables; GetSysInfo's switches by 3HAC16581-1, the form of its texts is
remembered only [mem].
"""

from collections.abc import Callable

from rapidgen._reading import read_foreign
from rapidgen.config.model import GroupConfig
from rapidgen.runtime.disks import file_path
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.loading import LARGEST_MODULE
from rapidgen.runtime.rawbytes import whole
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import limited
from rapidgen.runtime.values import Value

_SERIAL = "00-00000"


@builtin("GetSysInfo", cost="string")
def get_sys_info(
    task: Task,
    serial: bool | None,
    version: bool | None,
    version_name: bool | None,
    robot_type: bool | None,
    controller_id: bool | None,
    lan_ip: bool | None,
    language: bool | None,
    system_name: bool | None,
) -> str:
    """One fact about the controller.

    Forms of versions as backups keep what controllers answered (COMPAS RRC [code]):
    `ROBOTWARE_6.04.1027` and `6.04.01.00`; there is no build number here.
    """
    system = task.controller.system
    major, minor = system.robotware
    if serial:
        return _SERIAL
    if version:
        return f"ROBOTWARE_{major}.{minor:02d}.0000"
    if version_name:
        return f"{major}.{minor:02d}.00.00"
    if robot_type:
        groups = task.controller.motion.groups.values()
        configs: list[GroupConfig] = [group.config for group in groups]
        return limited(configs[0].model if configs else "")
    if controller_id or system_name:
        return limited(system.name)
    if lan_ip:
        return str(task.controller.network.address)
    if language:
        return "en"
    raise FatalError(40_662, "GetSysInfo needs a part", "such as \\LanIp")


# -- text tables ----------------------------------------------------------------------------


@builtin("TextTabInstall", cost="socket")
def text_tab_install(task: Task, file: str) -> None:
    """Install the tables of a file."""
    try:
        data = read_foreign(file_path(task, file), LARGEST_MODULE)
        task.controller.texts.install(data.decode("latin-1"))
    except OSError as error:
        raise RapidError("ERR_FILEOPEN", f"{file}: {error.strerror}") from error
    except ValueError as error:
        raise FatalError(40_663, "Text table not installed", file, str(error)) from error


@builtin("TextTabGet", cost="string")
def text_tab_get(task: Task, name: str) -> int:
    """A table's number; ERR_TXTNOEXIST when there is none."""
    number = task.controller.texts.number(name)
    if number is None:
        raise RapidError("ERR_TXTNOEXIST", f"no text table '{name}'")
    return number


@builtin("TextGet", cost="string")
def text_get(task: Task, table: float, index: float) -> str:
    """A text of a table; ERR_TXTNOEXIST when there is none."""
    expected = whole(index, "ERR_ARGVALERR")
    text = task.controller.texts.text(whole(table, "ERR_ARGVALERR"), expected)
    if text is None:
        raise RapidError("ERR_TXTNOEXIST", f"no text {expected} in table {table:g}")
    return limited(text)


_TOLD: dict[str, Callable[..., Value]] = {
    "IsSysId": lambda _task, identity: identity == _SERIAL,
    "GetServiceInfo": lambda task, _unit, _duty: str(task.scheduler.now // 3_600_000_000_000),  # h
    "TextTabFreeToUse": lambda task, name: task.controller.texts.number(name) is None,
}
builtins(_TOLD, cost="string")
builtin("RobOS")(lambda _task: False)
builtin("IsBrakeCheckActive")(lambda _task: False)  # no brake is checked here
