"""The model as plain JSON data and back; floats keep every bit."""

import dataclasses
import types
import typing
from pathlib import Path

from rapidgen._json import Json, Members, members
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.config.rules import Hint
from rapidgen.diagnostics import refusal


def to_manifest(config: RobotConfig) -> Members:
    """Return the configuration as JSON data, without path and inputs."""
    return members(_out(config))


def group_to_manifest(group: GroupConfig) -> Members:
    """Return one group as JSON data."""
    return members(_out(group))


def group_from_manifest(data: Json, path: Path) -> GroupConfig:
    """Return the group from `group_to_manifest`.

    TypeError, ValueError: invalid data.
    """
    made = _in(GroupConfig, data, "group", path)
    assert isinstance(made, GroupConfig)
    return made


def _out(value: object) -> Json:
    if dataclasses.is_dataclass(value):
        return {
            f.name: _out(getattr(value, f.name))
            for f in dataclasses.fields(value)
            if f.compare and (getattr(value, f.name) or not f.metadata.get("sparse"))
        }
    if isinstance(value, tuple):
        return [_out(item) for item in value]
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"a {type(value).__name__} has no place in the model")


def from_manifest(data: Json, path: Path = Path("manifest.json")) -> RobotConfig:
    """Return the configuration from `to_manifest`.

    Other data raise DiagnosticError (RG019).
    """
    try:
        made = _in(RobotConfig, data, "configuration", path)
    except (TypeError, ValueError) as fault:
        raise refusal(
            "RG019",
            None,
            f"{path}: not a configuration of this version: {fault}",
            "build the folder again with `rapidgen build`",
        ) from None
    assert isinstance(made, RobotConfig)
    return made


def _in(hint: Hint, value: Json, where: str, path: Path) -> object:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        return _dataclass(hint, value, where, path)
    if origin is tuple:
        if not isinstance(value, list):
            raise TypeError(f"{where} is not a list")
        if len(arguments) == 2 and arguments[1] is Ellipsis:
            arguments = (arguments[0],) * len(value)
        if len(arguments) != len(value):
            raise TypeError(f"{where} has {len(value)} entries, not {len(arguments)}")
        return tuple(
            _in(a, v, f"{where}[{i}]", path)
            for i, (a, v) in enumerate(zip(arguments, value, strict=True))
        )
    if origin is typing.Literal:
        if value not in arguments:
            raise ValueError(f"{where} is {value!r}")
        return value
    if origin is types.UnionType and len(arguments) == 2 and arguments[1] is types.NoneType:
        return None if value is None else _in(arguments[0], value, where, path)
    if origin in (typing.Union, types.UnionType):
        raise TypeError(f"{where}: unions have no place in the model")
    if hint is float and isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    if hint is Path:
        return path
    if type(value) is not hint:
        raise TypeError(f"{where} is a {type(value).__name__}")
    return value


def _dataclass(hint: type, value: Json, where: str, path: Path) -> object:
    if not isinstance(value, dict):
        raise TypeError(f"{where} is not an object")
    hints = typing.get_type_hints(hint)
    fields = [f for f in dataclasses.fields(hint) if f.compare]
    unknown = set(value) - {f.name for f in fields}
    if unknown:
        raise ValueError(f"{where} has the unknown key '{min(unknown)}'")
    missing = [
        f.name
        for f in fields
        if f.name not in value
        and f.default is dataclasses.MISSING
        and f.default_factory is dataclasses.MISSING
    ]
    if missing:
        raise ValueError(f"{where} lacks '{missing[0]}'")
    made = {
        f.name: _in(hints[f.name], value[f.name], f"{where}.{f.name}", path)
        for f in fields
        if f.name in value
    }
    if hint is RobotConfig:
        made["path"] = path
    return hint(**made)
