"""Differences of two configurations, in the keys and units of users."""

from collections.abc import Iterator
from math import degrees

from rapidgen._json import Json

_SHOWN = 8
"""Limit of changed keys; more of them mean another configuration."""
_OF_A_JOINT = ("lower", "upper", "speed", "acceleration", "offset")
_IN_DEG = ("start_tolerance",)
_IN_MM = (
    "start_tolerance_linear",
    "pose_tolerance",
    "approach_speed",
    "tcp_speed_limit",
    "position",
    "centre",
)
_NOT_SET = ("source", "unsure")


def changed_keys(old: Json, new: Json) -> list[str]:
    """Return `state.rate: 10 → 20` for each changed key of two models.

    The models are as in manifests; a last line gives the number of further ones.
    """
    before, after = dict(_leaves(old)), dict(_leaves(new))
    keys = [key for key in {**before, **after} if before.get(key) != after.get(key)]
    text = [f"{k}: {before.get(k, 'none')} → {after.get(k, 'none')}" for k in keys[:_SHOWN]]
    return text + ([f"and {len(keys) - _SHOWN} more keys"] if len(keys) > _SHOWN else [])


def _leaves(value: Json, path: tuple[str, ...] = (), kind: str = "") -> Iterator[tuple[str, str]]:
    """Yield each value by its path; `kind` is that of its joint."""
    if isinstance(value, dict):
        kind = str(value.get("kind", "")) if path[-2:-1] == ("joints",) else kind
        for key, part in value.items():
            if key not in _NOT_SET:
                yield from _leaves(part, (*path, key), kind)
    elif isinstance(value, list):
        for index, part in enumerate(value):
            name = part.get("name") if isinstance(part, dict) else None
            # A file with one group writes its keys at the top.
            alone = path == ("groups",) and len(value) == 1
            yield from _leaves(part, () if alone else (*path, str(name or index)), kind)
    elif value is not None:
        yield _written(path, value, kind)


def _written(path: tuple[str, ...], value: Json, kind: str) -> tuple[str, str]:
    key = ".".join(path)
    if not isinstance(value, int | float) or isinstance(value, bool):
        return key, str(value)
    if key == "state_period":
        return "state.rate", f"{1 / value:.6g}"
    of_joint = path[-1] in _OF_A_JOINT and kind
    if (of_joint and kind == "revolute") or path[-1] in _IN_DEG:
        return key, f"{degrees(value):.6g}"
    if of_joint or path[-1] in _IN_MM or path[-2:-1] in (("position",), ("centre",)):
        return key, f"{value * 1000:.6g}"
    return key, f"{value:.6g}"
