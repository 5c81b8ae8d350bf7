"""cfg instances to add, change or delete, and their merge into SYSPAR.

Loading parameters on a controller adds instances, and replaces those of the same name or refuses
them (120006 [real 6.03]); it never deletes one. Instances without a name (CAB_TASK_MODULES,
SYSSIG_OUT, ...) are identified by their key attributes; names compare without case [backup 6.06].
Motion tasks, unit groups and the firewall's rules are the controller's own: they get back their
earlier values, and are never deleted.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
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
_OWN = ("MECHANICAL_UNIT_GROUP", "FIREWALL_MANAGEMENT")
"""Sections of the firewall, delivered closed [backup 7.5, 7.6]."""
_THEIRS = ("name", "type", "motiontask")
"""Attributes of a motion task without any driver.

[eight backups, RW 5.15 to 6.13]
"""


CfgAction = Literal["add", "change", "same", "use", "clash", "restore", "leave", "remove"]
"""Kind of the change.

`use`: a foreign signal of the same kind, or an output that drives it, exists and stays; `clash`:
one of another kind; `restore`: gets back its values from before the first deployment; `leave`: the
controller's own, no longer in our files.
"""


@dataclass(frozen=True, slots=True)
class CfgChange:
    """Change of one instance: `key` is `SECTION name` as shown."""

    domain: str
    key: str
    action: CfgAction
    note: str = ""
    """Difference that a person has to resolve."""
    named: bool = True
    """True if loading can identify the instance that it replaces."""


Key = tuple[str, str, str]
Keyed = dict[Key, Instance]
"""(domain, section, what it is, without case) to instance."""


def keyed(texts: Iterable[CfgText]) -> Keyed:
    """Return all instances by their keys.

    Of duplicates it is the last, as in loading.
    """
    return {
        (text.domain, section.name, shown_key(section.name, instance).casefold()): instance
        for text in texts
        for section in text.sections
        for instance in section.instances
    }


def is_unconfirmed(text: CfgText) -> bool:
    """True if a file has instances that no controller has confirmed.

    All of them are optional.
    """
    return text.path.casefold().endswith("_open.cfg")


def name_of(key: Key) -> str:
    """Return a key as one text, as in a manifest, without case."""
    return " ".join(key).casefold()


def compare(
    desired: Keyed, present: Keyed, own_files: frozenset[str], before: Mapping[str, Json]
) -> tuple[CfgChange, ...]:
    """Return changes from `present` to `desired`.

    Instances only in `own_files` (deployed before) are deleted. `before` has the instances from
    before the first deployment, as far as known.
    """
    result = []
    for key, instance in desired.items():
        action, note = _toward(key, instance, present, own_files, before)
        result.append(_change(key, instance, action, note))
    for key, instance in present.items():
        name = name_of(key)
        if key in desired or name not in own_files:
            continue
        old = before.get(name)
        if old is not None:
            same = _equal(instance_from(old), instance)
            result.append(_change(key, instance, "same" if same else "restore"))
        elif is_controllers_own(key, instance, before, uninstall=not desired):
            text = [a for a in instance.attributes if a.name.casefold() not in _THEIRS]
            result.append(_change(key, instance, "leave", attributes_text(text)))
        else:
            result.append(_change(key, instance, "remove"))
    return tuple(result)


def without_used(
    desired: Keyed, present: Keyed, own_files: frozenset[str], before: Mapping[str, Json]
) -> Keyed:
    """Return `desired` with foreign definitions of equal effect unchanged."""
    result = {}
    for key, instance in desired.items():
        if _toward(key, instance, present, own_files, before)[0] != "use":
            result[key] = instance
        elif key in present:
            result[key] = present[key]
    return result


def merged(
    present: CfgText, desired: Keyed, own_files: frozenset[str], before: Mapping[str, Json]
) -> CfgText:
    """Return `present` with the wanted instances of its domain.

    Those only in `own_files` are deleted. An instance of ours that existed before the first
    deployment gets its old attributes back.
    """
    domain = present.domain
    left = {key: i for key, i in desired.items() if key[0] == domain}
    sections = []
    for section in present.sections:
        retained = []
        for instance in section.instances:
            key = (domain, section.name, shown_key(section.name, instance).casefold())
            if key in left:
                new = left.pop(key)
                retained.append(instance if _equal(instance, new) else new)
            elif key in desired:
                continue  # a duplicate of one that is in place already
            elif name_of(key) in own_files:
                old = before.get(name_of(key))
                if old is not None:
                    retained.append(instance_from(old))
                elif is_controllers_own(key, instance, before, uninstall=not desired):
                    retained.append(instance)
            else:
                retained.append(instance)
        retained += (
            [left.pop(key) for key in tuple(left) if key[1] == section.name]
            if _last(present, section)
            else []
        )
        sections.append(Section(section.name, tuple(retained)))
    names = list(dict.fromkeys(key[1] for key in left))
    for name in names:
        sections.append(Section(name, tuple(i for key, i in left.items() if key[1] == name)))
    return replace(present, sections=tuple(s for s in sections if s.instances))


def is_controllers_own(
    key: Key, instance: Instance, before: Mapping[str, Json], *, uninstall: bool
) -> bool:
    """True if an instance is the controller's own.

    No record says that a deployment added it.
    """
    return is_delivered(key[1], instance) and not (uninstall and name_of(key) in before)


def is_delivered(section: str, instance: Instance) -> bool:
    """True if controllers are delivered with such an instance."""
    return section in _OWN or (section == "CAB_TASKS" and instance.flag("MotionTask"))


def attributes_text(attributes: Iterable[Attribute]) -> str:
    """Return attributes as in a cfg file, on one line."""
    return " ".join(
        " ".join([f"-{a.name}", *(f'"{v}"' if isinstance(v, str) else str(v) for v in a.values)])
        for a in attributes
    )


def remember(
    desired: Keyed, present: Keyed, before: Mapping[str, Json], own_files: frozenset[str]
) -> Members:
    """Return `before` with an entry for each wanted instance.

    The entry is the original instance, or None. For an instance of ours without an entry the
    original is unknown.
    """
    result = dict(before)
    for key in desired:
        name = name_of(key)
        if name not in result and name not in own_files:
            old = present.get(key)
            result[name] = _to_json(old) if old is not None else None
    return result


def _last(text: CfgText, section: Section) -> bool:
    """True for the last section of its name: new instances go there."""
    return [s for s in text.sections if s.name == section.name][-1] is section


def _toward(
    key: Key,
    instance: Instance,
    present: Keyed,
    own_files: frozenset[str],
    before: Mapping[str, Json],
) -> tuple[CfgAction, str]:
    """Return the change of a wanted instance, and a reason for the user."""
    other = present.get(key)
    if other is None:
        return _driven(key, instance, present, own_files)
    old = before.get(name_of(key))
    foreign = name_of(key) not in own_files or (
        old is not None and _equal(instance_from(old), other)
    )
    if key[1] == "EIO_SIGNAL" and foreign:
        kind, needed = other.text("SignalType"), instance.text("SignalType")
        if kind.casefold() != needed.casefold():
            return "clash", f"{kind or 'of no type'} there, the driver needs {needed}"
        return ("same" if _equal(instance, other) else "use"), "a foreign one of the same kind"
    return ("same" if _equal(instance, other) else "change"), ""


def _driven(
    key: Key, instance: Instance, present: Keyed, own_files: frozenset[str]
) -> tuple[CfgAction, str]:
    """Return a new system output; a foreign one may drive the same signal."""
    if key[1] != "SYSSIG_OUT":
        return "add", ""
    signal = _signal(instance)
    for name, other in present.items():
        if name[1] == key[1] and _signal(other) == signal and name_of(name) not in own_files:
            if other.text("Status").casefold() == instance.text("Status").casefold():
                return "use", f"a foreign one: {shown_key(key[1], other)}"
            return "clash", f"driven by {other.text('Status')} there"
    return "add", ""


def _signal(output: Instance) -> str:
    return (output.text("Signal") or output.text("Name")).casefold()


def _change(key: Key, instance: Instance, action: CfgAction, note: str = "") -> CfgChange:
    displayed = f"{key[1]} {shown_key(key[1], instance)}"
    return CfgChange(key[0], displayed, action, note, bool(instance.text("Name")))


def shown_key(section: str, instance: Instance) -> str:
    """Return the identifying part of an instance within its section."""
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
    """Parse an instance of a manifest.

    Raises TypeError or ValueError for other data.
    """
    attributes = []
    for name, values in map(items, items(data)):
        retained = tuple(v for v in items(values) if isinstance(v, str | int | float))
        attributes.append(Attribute(text(name), retained))
    return Instance(tuple(attributes))
