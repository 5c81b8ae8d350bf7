"""ReadCfgData and its family, and WarmStart.

Sources: 3HAC16581-1's arguments and error names [manual]. \\ListNo: the number of one of several
instances that a path stands for (`/EIO/EIO_CROSS`: they have no names); behind it stands the number
of the next one. How they are counted: switch `list_number`.
"""

from rapidgen.rapid.numbers import MAX_STRING
from rapidgen.runtime.anytype import target_of, value_of
from rapidgen.runtime.disks import file_path, spend
from rapidgen.runtime.errors import EndOfRun, RapidError
from rapidgen.runtime.loading import words_of
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref


def _attributes(task: Task, path: str, number: Ref | None) -> dict[str, str | int | float | bool]:
    """Attributes of the instance; `number` goes on to the next one.

    ERR_CFG_NOTFND, ERR_CFG_OUTOFBND: the list has no such instance.
    """
    configuration = task.controller.configuration
    result = configuration.find(path)
    hidden = path.strip("/").lower().startswith("moc/arm/")
    if not result or (hidden and not task.controller.dialect.axis_limits_told):
        raise RapidError("ERR_CFG_NOTFND", path)
    if number is None:
        return result[0]
    first = 0 if task.controller.dialect.list_number == "zero" else 1
    at = number.get() - first
    if at not in range(len(result)):
        raise RapidError("ERR_CFG_OUTOFBND", f"{number.get():g} of {len(result)}")
    number.set(first + at + 1 if at + 1 < len(result) else first - 1)
    return result[int(at)]


@builtin("ReadCfgData", cost="socket")
def read_cfg_data(
    task: Task, path: str, attribute: str, argument: object, number: Ref | None
) -> None:
    """A system parameter; an absent flag is FALSE."""
    target = target_of(argument)
    value = _attributes(task, path, number).get(attribute.lower())
    kind = target.type.kind
    if kind == "bool" and value is None:
        target.set(False)
    elif value is None:
        raise RapidError("ERR_CFG_NOTFND", f"{path} {attribute}")
    elif kind == "bool":
        target.set(value is True or value == 1)
    elif kind == "string" and isinstance(value, str):
        target.set(value[:MAX_STRING])
    elif kind in ("num", "dnum") and isinstance(value, int | float):
        target.set(value)
    else:
        raise RapidError("ERR_CFG_ILLTYPE", f"{path} {attribute}")


@builtin("WriteCfgData", cost="socket")
def write_cfg_data(
    task: Task, path: str, attribute: str, argument: object, number: Ref | None
) -> None:
    """Change a system parameter; only ReadCfgData sees it."""
    attributes = _attributes(task, path, number)
    before = attributes.get(attribute.lower())
    value, _ = value_of(argument)
    if before is not None and isinstance(before, str) is not isinstance(value, str):
        raise RapidError("ERR_CFG_ILLTYPE", f"{path} {attribute}")
    attributes[attribute.lower()] = value


@builtin("SaveCfgData", cost="socket")
def save_cfg_data(task: Task, path: str, file: str | None, domain: str) -> None:
    """Write a domain to a file."""
    configuration = task.controller.configuration
    if domain.upper() not in configuration.domains:
        raise RapidError("ERR_CFG_ILL_DOMAIN", domain)
    text = configuration.text(domain.upper())
    spend(task, len(text))
    try:
        file_path(task, words_of(path, file)).write_text(text, encoding="latin-1")
    except OSError as error:
        raise RapidError("ERR_CFG_WRITEFILE", str(error.strerror)) from error


@builtin("WarmStart", cost="socket")
def warm_start(task: Task) -> None:
    """Restart the controller, as after a power failure."""
    task.scheduler.after(0, task.controller.power_loss)
    raise EndOfRun
