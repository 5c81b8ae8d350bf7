"""cfg instances: what has to be added, changed or taken away, and merging them into SYSPAR.

Loading parameters on a controller adds instances and replaces those of the same name; it never
removes one. Instances without a name (CAB_TASK_MODULES, SYSSIG_OUT, ...) are told apart by the
attributes that make them what they are.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from rapidgen._json import Json, Members, items, text
from rapidgen.system import Attribute, CfgText, Instance, Section

_KEYS: dict[str, tuple[str, ...]] = {
    "CAB_TASK_MODULES": ("File", "Task"),
    "CAB_EXEC_HOOKS": ("Routine", "Shelf", "Task"),
    # The signal is in -Signal to RobotWare 6 and in -Name from 7 on.
    "SYSSIG_OUT": ("Status", "Signal", "Name", "Arg1", "Arg2"),
    "SYSSIG_IN": ("Signal", "Name", "Action"),
    "EIO_CROSS": ("Res",),
}


@dataclass(frozen=True, slots=True)
class CfgChange:
    """One instance: `key` is `SECTION name` as shown."""

    domain: str
    key: str
    action: Literal["add", "change", "same", "remove"]


Keyed = dict[tuple[str, str, str], Instance]
"""(domain, section, key) to instance."""


def keyed(texts: Iterable[CfgText]) -> Keyed:
    """All instances by what makes them what they are; of duplicates the last, as in loading."""
    return {
        (text.domain, section.name, _key(section.name, instance)): instance
        for text in texts
        for section in text.sections
        for instance in section.instances
    }


def names_of(keys: Iterable[tuple[str, str, str]]) -> frozenset[str]:
    """Keys as one text each, the way a manifest holds them."""
    return frozenset(" ".join(key) for key in keys)


def compare(wanted: Keyed, present: Keyed, ours: frozenset[str]) -> tuple[CfgChange, ...]:
    """Changes from `present` to `wanted`; what is only in `ours` (deployed before) goes."""
    found = []
    for key, instance in wanted.items():
        other = present.get(key)
        if other is None:
            action: Literal["add", "change", "same"] = "add"
        else:
            action = "same" if _equal(instance, other) else "change"
        found.append(CfgChange(key[0], f"{key[1]} {key[2]}", action))
    found += [
        CfgChange(key[0], f"{key[1]} {key[2]}", "remove")
        for key in present
        if key not in wanted and " ".join(key) in ours
    ]
    return tuple(found)


def merged(
    present: CfgText, wanted: Keyed, ours: frozenset[str], before: Mapping[str, Json]
) -> CfgText:
    """`present` with the wanted instances of its domain, and without those only in `ours`.

    An instance of ours that was there before the first deployment gets its old attributes back.
    """
    domain = present.domain
    left = {key: i for key, i in wanted.items() if key[0] == domain}
    sections = []
    for section in present.sections:
        kept = []
        for instance in section.instances:
            key = (domain, section.name, _key(section.name, instance))
            if key in left:
                new = left.pop(key)
                kept.append(instance if _equal(instance, new) else new)
            elif key in wanted:
                continue  # a duplicate of one that is in place already
            elif " ".join(key) in ours:
                old = before.get(" ".join(key))
                if old is not None:
                    kept.append(instance_from(old))
            else:
                kept.append(instance)
        kept += (
            [left.pop(key) for key in tuple(left) if key[1] == section.name]
            if _last(present, section)
            else []
        )
        sections.append(Section(section.name, tuple(kept)))
    names = list(dict.fromkeys(key[1] for key in left))
    for name in names:
        sections.append(Section(name, tuple(i for key, i in left.items() if key[1] == name)))
    return CfgText(domain, present.version, tuple(s for s in sections if s.instances), present.path)


def remember(wanted: Keyed, present: Keyed, before: Mapping[str, Json]) -> Members:
    """`before` with an entry for each wanted instance: what was there first, or None."""
    result = dict(before)
    for key in wanted:
        name = " ".join(key)
        if name not in result:
            old = present.get(key)
            result[name] = _to_json(old) if old is not None else None
    return result


def _last(text: CfgText, section: Section) -> bool:
    """Whether it is the last section of its name: there new instances go."""
    return [s for s in text.sections if s.name == section.name][-1] is section


def _key(section: str, instance: Instance) -> str:
    names = _KEYS.get(section)
    if names is None:
        name = instance.text("Name")
        if name:
            return name
        names = tuple(a.name for a in instance.attributes)
    values = [
        str(value)
        for name in names
        for attribute in instance.attributes
        if attribute.name.casefold() == name.casefold()
        for value in attribute.values
    ]
    return " ".join(values)


def _equal(one: Instance, other: Instance) -> bool:
    def plain(instance: Instance) -> dict[str, tuple[str, ...]]:
        return {a.name.casefold(): tuple(map(str, a.values)) for a in instance.attributes}

    return plain(one) == plain(other)


def _to_json(instance: Instance) -> list[Json]:
    return [[a.name, list(a.values)] for a in instance.attributes]


def instance_from(data: Json) -> Instance:
    """An instance as a manifest holds it. Raises TypeError or ValueError for anything else."""
    attributes = []
    for name, values in map(items, items(data)):
        kept = tuple(v for v in items(values) if isinstance(v, str | int | float))
        attributes.append(Attribute(text(name), kept))
    return Instance(tuple(attributes))
