"""Clocks, system information, text tables and configuration."""

from collections.abc import Callable

from rapidgen._reading import read_foreign
from rapidgen.config.model import GroupConfig
from rapidgen.machine.scheduler import date_time
from rapidgen.rapid.numbers import MAX_STRING, single
from rapidgen.runtime.errors import EndOfRun, FatalError, RapidError
from rapidgen.runtime.loading import LARGEST_MODULE, file_path, spend, words_of
from rapidgen.runtime.rawbytes import whole
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import target_of, value_of
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import limited
from rapidgen.runtime.values import Ref, Value, register_type
from rapidgen.system.cfg import Instance
from rapidgen.system.cfg_database import value_of as value_of_cfg

# -- Clocks ----------------------------------------------------------------------------------------
#
# Stop watches, date and time.
#
# Sources: S4 reference, pages clock, ClkStart to ClkRead, CDate, CTime, GetTime [manual].


_MS = 1_000_000
_US = 1_000
_S = 1_000_000_000
_LONGEST = 4_294_967
"""Seconds that a clock can hold, about 49 days."""


class StopWatch:
    """A `clock`: its measured time, and its start (ns) while it runs."""

    __slots__ = ("measured", "started")

    def __init__(self) -> None:
        self.measured = 0
        self.started: int | None = None

    def read(self, now: int) -> int:
        """Return nanoseconds; ERR_OVERFLOW beyond 49 days."""
        total = self.measured + (0 if self.started is None else now - self.started)
        if total > _LONGEST * _S:
            raise RapidError("ERR_OVERFLOW", "a clock holds 49 days")
        return total


register_type("clock", StopWatch)


@builtin("ClkReset")
def clk_reset(_task: Task, clock: StopWatch) -> None:
    """Stop and reset to 0."""
    clock.measured = 0
    clock.started = None


@builtin("ClkStart")
def clk_start(task: Task, clock: StopWatch) -> None:
    """Continue from the current value."""
    clock.read(task.scheduler.now)
    if clock.started is None:
        clock.started = task.scheduler.now


@builtin("ClkStop")
def clk_stop(task: Task, clock: StopWatch) -> None:
    """Stop and keep the value."""
    clock.measured = clock.read(task.scheduler.now)
    clock.started = None


@builtin("ClkRead")
def clk_read(task: Task, clock: StopWatch, high_resolution: bool | None) -> float:
    """Return seconds in steps of 1 ms (1 µs with \\HighRes)."""
    step = _US if high_resolution else _MS
    return single(clock.read(task.scheduler.now) // step * step / _S)


@builtin("GetTime")
def get_time(
    task: Task, weekday: bool | None, hour: bool | None, minute: bool | None, second: bool | None
) -> int:
    """Return one part of date and time; Monday is 1."""
    now = date_time(task.scheduler)
    if weekday:
        return now.isoweekday()
    if hour:
        return now.hour
    if minute:
        return now.minute
    if second:
        return now.second
    raise FatalError(194_661, "GetTime needs a part", "one of \\WDay, \\Hour, \\Min and \\Sec")


_SHOWN: dict[str, Callable[..., Value]] = {
    "CDate": lambda task: f"{date_time(task.scheduler):%Y-%m-%d}",
    "CTime": lambda task: f"{date_time(task.scheduler):%H:%M:%S}",
}
builtins(_SHOWN, cost="string")


# -- System information and text tables ------------------------------------------------------------
#
# Sources: [K §15] for text tables; GetSysInfo's switches from 3HAC16581-1, the format of its texts
# is remembered only [mem].


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
    """Return one property of the controller.

    Version formats are those of controllers as backups contain them (COMPAS RRC [code]):
    `ROBOTWARE_6.04.1027` and `6.04.01.00`; the virtual controller has no build number.
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
    raise FatalError(194_662, "GetSysInfo needs a part", "such as \\LanIp")


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
        raise FatalError(194_663, "Text table not installed", file, str(error)) from error


@builtin("TextTabGet", cost="string")
def text_tab_get(task: Task, name: str) -> int:
    """Return the number of a table, or raise ERR_TXTNOEXIST."""
    number = task.controller.texts.number(name)
    if number is None:
        raise RapidError("ERR_TXTNOEXIST", f"no text table '{name}'")
    return number


@builtin("TextGet", cost="string")
def text_get(task: Task, table: float, index: float) -> str:
    """Return a text of a table, or raise ERR_TXTNOEXIST."""
    expected = whole(index, "ERR_ARGVALERR")
    text = task.controller.texts.text(whole(table, "ERR_ARGVALERR"), expected)
    if text is None:
        raise RapidError("ERR_TXTNOEXIST", f"no text {expected} in table {table:g}")
    return limited(text)


_INFORMATION: dict[str, Callable[..., Value]] = {
    "IsSysId": lambda _task, identity: identity == _SERIAL,
    "GetServiceInfo": lambda task, _unit, _duty: str(task.scheduler.now // 3_600_000_000_000),  # h
    "TextTabFreeToUse": lambda task, name: task.controller.texts.number(name) is None,
}
builtins(_INFORMATION, cost="string")
builtin("RobOS")(lambda _task: False)
builtin("IsBrakeCheckActive")(lambda _task: False)  # The virtual controller has no brake check.


# -- Configuration ---------------------------------------------------------------------------------
#
# ReadCfgData and related routines, and WarmStart.
#
# Sources: 3HAC16581-1's arguments and error names [manual]. \ListNo selects one of several
# instances of a path without names (`/EIO/EIO_CROSS`) and then receives the number of the next one.
# The switch `list_number` selects the first number.


def _instance(task: Task, path: str, number: Ref | None) -> tuple[str, str, Instance]:
    """Return domain, type and instance of a path; advance `number`.

    ERR_CFG_NOTFND, ERR_CFG_OUTOFBND: the list has no such instance.
    """
    domain, section, result = task.controller.cfg.find(path)
    hidden = path.strip("/").lower().startswith("moc/arm/")
    if not result or (hidden and not task.controller.dialect.axis_limits_readable):
        raise RapidError("ERR_CFG_NOTFND", path)
    if number is None:
        return domain, section, result[0]
    first = 0 if task.controller.dialect.list_number == "zero" else 1
    at = number.get() - first
    if at not in range(len(result)):
        raise RapidError("ERR_CFG_OUTOFBND", f"{number.get():g} of {len(result)}")
    number.set(first + at + 1 if at + 1 < len(result) else first - 1)
    return domain, section, result[int(at)]


@builtin("ReadCfgData", cost="socket")
def read_cfg_data(
    task: Task, path: str, attribute: str, argument: object, number: Ref | None
) -> None:
    """Read a system parameter or its default; an absent flag is FALSE."""
    target = target_of(argument)
    domain, section, instance = _instance(task, path, number)
    value = value_of_cfg(domain, section, instance, attribute)
    kind = target.type.kind
    if kind == "bool" and value is None:
        target.set(False)
    elif value is None:
        raise RapidError(
            "ERR_CFG_NOTFND", f"{path}: {attribute} is not in the file, and its default is unknown"
        )
    elif kind == "bool":
        target.set(value is True or value == 1)
    elif kind == "string" and isinstance(value, str):
        target.set(value[:MAX_STRING])
    elif kind in ("num", "dnum") and isinstance(value, int | float) and value is not True:
        target.set(value)
    else:
        raise RapidError("ERR_CFG_ILLTYPE", f"{path} {attribute}")


@builtin("GetModalPayLoadMode")
def get_modal_payload_mode(task: Task) -> float:
    """Return the system parameter ModalPayLoadMode: 1 if GripLoad decides on the payload.

    Backups of RobotWare 6 have 1. RobotWare 5 does not have the parameter, and GripLoad decides.
    """
    mode = task.controller.cfg.instance("SYS", "SYS_MISC", "ModalPayLoadMode")
    value = 1 if mode is None else value_of_cfg("SYS", "SYS_MISC", mode, "Value")
    text = str(value).strip()
    return float(text) if text.isdigit() else 1.0


@builtin("WriteCfgData", cost="socket")
def write_cfg_data(
    task: Task, path: str, attribute: str, argument: object, number: Ref | None
) -> None:
    """Write a system parameter. It takes effect at the next restart.

    ERR_CFG_INTERNAL: the instance is not saved by the controller, so it cannot be changed.
    """
    domain, section, instance = _instance(task, path, number)
    before = value_of_cfg(domain, section, instance, attribute)
    value, _ = value_of(argument)
    if before is not None and isinstance(before, str) is not isinstance(value, str):
        raise RapidError("ERR_CFG_ILLTYPE", f"{path} {attribute}")
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    try:
        task.controller.cfg.change(domain, section, instance, {attribute: value})
    except ValueError as error:
        raise RapidError("ERR_CFG_INTERNAL", f"{path}: {error}") from error


@builtin("SaveCfgData", cost="socket")
def save_cfg_data(task: Task, path: str, file: str | None, domain: str) -> None:
    """Write a domain to a file."""
    cfg = task.controller.cfg
    if domain.upper() not in cfg.domains:
        raise RapidError("ERR_CFG_ILL_DOMAIN", domain)
    text = cfg.text(domain)
    spend(task, len(text))
    try:
        file_path(task, words_of(path, file)).write_text(text, encoding="latin-1")
    except OSError as error:
        raise RapidError("ERR_CFG_WRITEFILE", str(error.strerror)) from error


@builtin("WarmStart", cost="socket")
def warm_start(task: Task) -> None:
    """Restart the controller as after a power failure."""
    task.scheduler.after(0, task.controller.power_loss)
    raise EndOfRun
