"""Merge a shipped model, the user's file and overrides into one tree.

Group keys at the top of a file belong to its only group; here they move under `groups`. A key with
the value `null` counts as absent.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rapidgen.config.schema import GROUP_KEYS
from rapidgen.config.yaml_tree import (
    MappingNode,
    Node,
    ScalarNode,
    SequenceNode,
    from_python,
    parse,
)
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error

Entries = dict[str, tuple[Span, Node]]
Overrides = Mapping[str, object] | Sequence[str]

DEFAULT_GROUP = "rob1"
_SHARED_KEYS = ("model",)  # a key of a file and of a group: at the top it is the file's
_KEY = re.compile(r'"([^"]*)"|([^."]+)')


@dataclass(slots=True)
class Layer:
    """A tree in canonical form (`groups` only), with findings."""

    root: MappingNode
    found: list[Diagnostic] = field(default_factory=list)


def prune(node: Node) -> Node:
    """Return the tree without keys that have no value."""
    if isinstance(node, MappingNode):
        return MappingNode(
            {
                key: (place, prune(value))
                for key, (place, value) in node.entries.items()
                if not (isinstance(value, ScalarNode) and value.value is None)
            },
            node.span,
        )
    if isinstance(node, SequenceNode):
        return SequenceNode(tuple(prune(item) for item in node.items), node.span)
    return node


def group_names(root: MappingNode) -> tuple[str, ...]:
    """Return the names of the groups of a canonical tree."""
    entry = root.entries.get("groups")
    return tuple(entry[1].entries) if entry and isinstance(entry[1], MappingNode) else ()


def canonical(root: MappingNode, known: tuple[str, ...]) -> Layer:
    """Return `root` with its group keys moved under `groups`.

    `known` are the groups below it.
    """
    pruned = prune(root)
    assert isinstance(pruned, MappingNode)
    top = {k: v for k, v in pruned.entries.items() if k not in GROUP_KEYS or k in _SHARED_KEYS}
    own = {k: v for k, v in pruned.entries.items() if k in GROUP_KEYS and k not in _SHARED_KEYS}
    if not own:
        return Layer(MappingNode(top, pruned.span))
    value = top.get("groups")
    names = tuple(dict.fromkeys((*known, *group_names(MappingNode(top, pruned.span)))))
    if len(names) > 1 or (value and not known):
        displayed = names[0] if names else DEFAULT_GROUP
        result = [
            error(
                "RG010",
                place,
                f"'{key}' belongs to a group",
                f"write it as groups.{displayed}.{key}",
                label=f"which of {', '.join(names)}?" if len(names) > 1 else "next to 'groups'",
            )
            for key, (place, _) in own.items()
        ]
        return Layer(MappingNode(top, pruned.span), result)
    name = names[0] if names else DEFAULT_GROUP
    first = next(iter(own.values()))[0]
    group = MappingNode({name: (first, MappingNode(own, pruned.span))}, pruned.span)
    moved = MappingNode({"groups": (first, group)}, pruned.span)
    return Layer(merge(MappingNode(top, pruned.span), moved))


def merge(base: MappingNode, over: MappingNode, path: tuple[str, ...] = ()) -> MappingNode:
    """Merge `over` into `base`: mappings key by key, the rest is replaced."""
    entries = dict(base.entries)
    if len(path) == 2 and path[0] == "groups":
        entries = _adopt(entries, over)
    for key, (place, value) in over.entries.items():
        below = entries.get(key)
        if below and isinstance(below[1], MappingNode) and isinstance(value, MappingNode):
            value = merge(below[1], value, (*path, key))
        entries[key] = (place, value)
    group, joint = len(path) == 2, len(path) == 4 and path[2] == "joints"
    if path[:1] == ("groups",) and (group or joint):
        entries = _settle(entries, over)
    return MappingNode(entries, over.span)


def _adopt(entries: Entries, over: MappingNode) -> Entries:
    """Rename a joint of the model whose axis the upper layer names anew."""
    known, given = entries.get("joints"), over.entries.get("joints")
    if not known or not given:
        return entries
    known_joints, given_joints = known[1], given[1]
    if not isinstance(known_joints, MappingNode) or not isinstance(given_joints, MappingNode):
        return entries
    by_axis = {axis: key for key, (_, j) in known_joints.entries.items() if (axis := _axis(j))}
    names = {
        by_axis[axis]: key
        for key, (_, joint) in given_joints.entries.items()
        if key not in known_joints.entries and (axis := _axis(joint)) in by_axis
    }
    if not names:
        return entries
    joints = {names.get(key, key): value for key, value in known_joints.entries.items()}
    made = {**entries, "joints": (known[0], MappingNode(joints, known_joints.span))}
    for key in ("chain", "positioners"):
        if key in entries:
            place, chain = entries[key]
            made[key] = (place, _renamed(chain, names))
    return made


def _renamed(node: Node, names: dict[str, str]) -> Node:
    """Return a chain with other joint names."""
    if isinstance(node, SequenceNode):
        return SequenceNode(tuple(_renamed(item, names) for item in node.items), node.span)
    if isinstance(node, MappingNode):
        return MappingNode(
            {
                names.get(key, key): (place, _renamed(value, names))
                for key, (place, value) in node.entries.items()
            },
            node.span,
        )
    if isinstance(node.value, str):
        return ScalarNode(names.get(node.value, node.value), node.span)
    return node


def _axis(joint: Node) -> str:
    if isinstance(joint, MappingNode) and "axis" in joint.entries:
        value = joint.entries["axis"][1]
        if isinstance(value, ScalarNode) and isinstance(value.value, str):
            return value.value
    return ""


def _settle(entries: Entries, over: MappingNode) -> Entries:
    """Mark figures that the upper layer gives as certain."""
    if "unsure" not in entries or "unsure" in over.entries:
        return entries
    place, unsure = entries["unsure"]
    if isinstance(unsure, SequenceNode):
        left = tuple(
            item
            for item in unsure.items
            if not (isinstance(item, ScalarNode) and item.value in over.entries)
        )
        entries["unsure"] = (place, SequenceNode(left, unsure.span))
    return entries


def override_tree(overrides: Overrides) -> tuple[MappingNode, tuple[tuple[str, bytes], ...]]:
    """Return `--set` texts or a mapping of key paths as one raw tree.

    The inputs come with it.
    """
    root = MappingNode({}, Span("--set", 1, 1))
    inputs: list[tuple[str, bytes]] = []
    findings: list[Diagnostic] = []
    pairs: Sequence[tuple[str, object, bool]]
    if isinstance(overrides, str):
        raise TypeError(f"overrides are a list, or a mapping of keys to values: [{overrides!r}]")
    if isinstance(overrides, Mapping):
        pairs = [(key, value, False) for key, value in overrides.items()]
    else:
        pairs = []
        for text in overrides:
            name, equals, given = text.partition("=")
            if equals and given.strip():
                pairs.append((name, given, True))
            else:
                findings.append(_bad_override(text))
    for key, value, is_text in pairs:
        span = Span(f"--set {key}={value}", 1, 1)
        keys = _split(key)
        if not keys:
            findings.append(_bad_override(f"{key}={value}"))
            continue
        try:
            if is_text:
                node, faults = parse(str(value), span.path, at=span)
                findings += faults
            else:
                node = from_python(value, span)
        except DiagnosticError as fault:
            findings += fault.diagnostics
            continue
        for part in reversed(keys):
            node = MappingNode({part: (span, node)}, span)
        assert isinstance(node, MappingNode)
        root = merge(root, node)
        inputs.append(("--set", f"{key}={value}".encode()))
    if findings:
        raise DiagnosticError(findings)
    return root, tuple(inputs)


def _split(key: str) -> list[str]:
    """Split `a.b."c.d"` into its parts; return nothing for another text."""
    parts, at = [], 0
    while at < len(key):
        hit = _KEY.match(key, at)
        if not hit:
            return []
        parts.append((hit[1] if hit[1] is not None else hit[2]).strip())
        at = hit.end()
        if at < len(key):
            if key[at] != "." or at + 1 == len(key):
                return []
            at += 1
    return parts


def _bad_override(text: str) -> Diagnostic:
    return error(
        "RG008",
        None,
        f"'{text}' is not an override",
        "write key.path=value, such as --set ports.motion=12000",
    )
