"""Fast conversion of simple option values.

typer builds a pydantic model for each option of a command, used or not: 40 % of the time of a
short `rapidgen run`. This module converts simple values itself. All others (a number outside its
range, an unknown choice, a special type) are left to typer, which reports the error.
"""

import os
import re
from collections.abc import Callable
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any, Final, Literal, TypeAlias, TypeVar, get_args, get_origin

from typer import Context
from typer.core import TyperArgument, TyperCommand, TyperGroup, TyperOption
from typer.models import ParameterInfo

_NUMBERS: Final[dict[object, tuple[type[int | float], re.Pattern[str]]]] = {
    int: (int, re.compile(r"-?[0-9]{1,15}", re.ASCII)),
    float: (float, re.compile(r"-?[0-9]{1,15}(\.[0-9]{1,15})?", re.ASCII)),
}
_NOT_PLAIN: Final = object()
T = TypeVar("T")
Parameter: TypeAlias = TyperOption | TyperArgument


class PlainCommand(TyperCommand):
    """A command whose options convert simple values fast."""

    def get_params(self, ctx: Context) -> list[Any]:  # type: ignore[override]  # not public
        return [_plainly(one) for one in super().get_params(ctx)]


class PlainGroup(TyperGroup):
    """A group whose options convert simple values fast."""

    def get_params(self, ctx: Context) -> list[Any]:  # type: ignore[override]  # not public
        return [_plainly(one) for one in super().get_params(ctx)]


def _plainly(parameter: T) -> T:
    """Make the parameter convert simple values before typer does."""
    typed = getattr(parameter, "type_descriptor", None)
    own = vars(parameter)
    if (
        isinstance(parameter, TyperOption | TyperArgument)
        and typed is not None
        and "process_value" not in own
    ):
        read = partial(_read, parameter, typed.annotation, typed.parameter_info)
        own["process_value"] = partial(_processed, parameter, parameter.process_value, read)
    return parameter


def _processed(
    parameter: Parameter,
    complete: Callable[..., object],
    read: Callable[[object], object],
    ctx: Context,
    value: object,
) -> object:
    result = read(value)
    if result is _NOT_PLAIN:
        return complete(ctx, value)
    return result if parameter.callback is None else parameter.callback(ctx, parameter, result)


def _read(parameter: Parameter, annotation: object, info: ParameterInfo, value: object) -> object:
    several = parameter.multiple or parameter.nargs == -1
    if parameter.required and parameter.value_is_missing(value):
        return _NOT_PLAIN
    if value is None:
        return () if several else None
    if not several:
        return plain(annotation, info, value)
    if get_origin(annotation) is not list or not isinstance(value, (list, tuple)):
        return _NOT_PLAIN
    (kind,) = get_args(annotation)
    result = [plain(kind, info, one) for one in value]
    return _NOT_PLAIN if _NOT_PLAIN in result else result


def plain(kind: object, info: ParameterInfo, value: object) -> object:
    """Return a value of the type `kind`, or `_NOT_PLAIN` if typer has to convert it."""
    if info.parser is not None:
        return _NOT_PLAIN
    if kind in _NUMBERS:
        return _number(kind, info, value)
    if kind is Path and isinstance(value, (str, Path)):
        return _path(Path(value), info)
    if get_origin(kind) is Literal:
        return value if value in get_args(kind) else _NOT_PLAIN
    if isinstance(kind, type) and issubclass(kind, Enum):
        return next((one for one in kind if value in (one, one.value)), _NOT_PLAIN)
    return value if type(value) is kind and kind in (str, bool) else _NOT_PLAIN


def _number(kind: object, info: ParameterInfo, value: object) -> object:
    made, pattern = _NUMBERS[kind]
    if isinstance(value, str) and pattern.fullmatch(value):
        value = made(value)
    if not isinstance(value, int | float) or type(value) is not kind:
        return _NOT_PLAIN
    within = (info.min is None or value >= info.min) and (info.max is None or value <= info.max)
    return value if within else _NOT_PLAIN


def _path(path: Path, info: ParameterInfo) -> object:
    requested = info.exists or info.writable or info.resolve_path or info.path_type is not None
    some = info.file_okay and info.dir_okay
    unread = info.readable and not os.access(path, os.R_OK) and path.exists()
    return _NOT_PLAIN if requested or unread or not some else path
